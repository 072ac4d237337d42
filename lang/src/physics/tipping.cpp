// W640: what could tip the base over, by statics.
//
// A base whose mass m lies d inside an edge of its supports and h above the floor tips over that edge
//
//   when it speeds up away from it with    a > g d / h,
//   when it pushes away from it with       F > m g d / z    at the height z of its bumper.
//
// It is asked of the largest demand of each driver of the base: m v / tau of a velocity, the motors' force
// of a position. The acceleration and force ranges bound the demand. It is asked of the protective stop's
// deceleration, too.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_statics.hpp"
#include "physics/statics.hpp"
#include "zwang/lang/footing.hpp"

namespace zwang::lang {

namespace {

using solver::Vector3;

/// A base on the ground, along an axis of its own plane.
bool is_of_the_base(const PlannedAxis& axis) {
  return axis.move.body == 0 && !axis.turns() && !axis.is_feature() && axis.driver.has_value();
}

/// The largest acceleration that the driver can ask for along its axis, towards `sign`. [m/s^2]
double most_acceleration(const PlannedTask& plan, const PlannedAxis& axis, double sign,
                         const AxisFigures& figures) {
  double most = std::min(figures.force / figures.mass, acceleration_limit(plan, axis, sign, true).most);
  if (const auto& range = axis[solver::Quantity::force])
    most = std::min(most, (sign > 0.0 ? range->high : -range->low) / figures.mass);
  if (axis.driver == solver::Quantity::force && axis.target)
    most = std::min(most, std::max(0.0, sign * *axis.target) / figures.mass);
  if (axis.driver == solver::Quantity::velocity && axis.target)
    most = std::min(most, std::abs(*axis.target) / axis.time_constant);
  if (axis.driver == solver::Quantity::acceleration && axis.target)
    most = std::min(most, std::max(0.0, sign * *axis.target));
  return most;
}

/// The largest force with which it may press, towards `sign`: what the driver makes when it is blocked. [N]
double most_push(const PlannedTask& plan, const PlannedAxis& axis, double sign, const AxisFigures& figures) {
  return std::max(0.0, most_acceleration(plan, axis, sign, figures) * figures.mass);
}

const Span& span_of(const PlannedAxis& axis, solver::Quantity quantity) {
  return axis.span(quantity).exists() ? axis.span(quantity) : axis.driver_span();
}

void ask_acceleration(const PlannedTask& plan, const PlannedAxis& axis, const Vector3& along,
                      const Footing& footing, Probe& probe, Remarks& remarks) {
  const AxisFigures* figures = probe.figures(axis);
  if (figures == nullptr || !figures->is_reachable || !std::isfinite(figures->mass)) return;
  for (const double sign : {1.0, -1.0}) {
    const double asked = most_acceleration(plan, axis, sign, *figures);
    const double tips = footing.tipping_acceleration(sign * along);
    if (asked <= tips) continue;
    remarks.add(wording::tips_by_acceleration(span_of(axis, solver::Quantity::acceleration), axis.path, asked,
                                              tips, footing.inside, footing.height));
    return;
  }
}

void ask_push(const PlannedTask& plan, const PlannedAxis& axis, const Vector3& along, const Footing& footing,
              Probe& probe, Remarks& remarks) {
  const Robot& robot = probe.robot();
  const AxisFigures* figures = probe.figures(axis);
  if (figures == nullptr || !figures->is_reachable || !std::isfinite(figures->mass)) return;
  for (const double sign : {1.0, -1.0}) {
    const double asked = most_push(plan, axis, sign, *figures);
    if (!(asked > 0.0)) continue;
    const double moment = footing.tipping_push(sign * along, 1.0);  // m g d [N m]
    const double tips = moment / robot.bumper_height;
    if (robot.bumper_height_said && asked > tips) {
      remarks.add(wording::tips_by_push(span_of(axis, solver::Quantity::force), axis.path, asked, tips,
                                        robot.bumper_height));
      return;
    }
    // An even body is twice as high as its centre of mass: nothing touches it above that.
    if (!robot.bumper_height_said && moment / asked < 2.0 * footing.height) {
      remarks.add(wording::unknown_bumper_height(span_of(axis, solver::Quantity::force), axis.path, asked,
                                                 moment / asked));
      return;
    }
  }
}

}  // namespace

void ask_tipping(const PlannedTask& plan, const std::optional<Scene>& scene, Probe& probe, Remarks& remarks) {
  const std::optional<Footing> footing = footing_of(probe.robot());
  if (!footing || footing->is_on_edge()) return;  // the robot file is told so
  for (const PlannedAxis& axis : plan.axes) {
    if (!is_of_the_base(axis) || probe.is_out_of_plane(axis)) continue;
    const Vector3 along = direction_in_base(axis, probe, scene);
    ask_acceleration(plan, axis, along, *footing, probe, remarks);
    if (!probe.robot().footprint.empty()) ask_push(plan, axis, along, *footing, probe, remarks);
  }
}

void ask_stop(const Span& span, Probe& probe, Remarks& remarks) {
  const std::optional<Footing> footing = footing_of(probe.robot());
  if (!footing || footing->is_on_edge()) return;  // the robot file is told so
  const double tips = footing->tipping_deceleration(probe.base_mobility() >= 3);
  const double asked = probe.robot().stop.deceleration;
  if (asked > tips) remarks.add(wording::tips_by_stop(span, asked, tips));
}

}  // namespace zwang::lang
