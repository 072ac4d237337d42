// How fast the base arrives, over the way s to the object, from rest, with the acceleration a:
//
//     v^2 = 2 a s,   a = min(demand, the acceleration limits, F / m),   v <= the velocity ranges
//
// F is what the motors make along the axis, or the force range. The demand is F / m of a force driver, c of
// an acceleration, and with d from the start to the target
//
//     velocity v0     (v0 - v) / T
//     position        (d - x) / T^2 - 2 v / T
//     spring          (k (d - x) - D v) / m
//
// After it touches, m times the demand is what presses on.
//
// The way is known in the task that begins where the scene says, if nothing but the axis moves the base.
// Elsewhere a velocity's target and the velocity ranges tell the speed, and the robot's limits a bound.
#include "physics/arrival.hpp"

#include <algorithm>
#include <cmath>

#include "physics/statics.hpp"

namespace zwang::lang {

namespace {

using solver::Quantity;
using solver::Vector3;

/// The speed [m/s] that the file itself gives the axis. Infinite: the file gives none.
double said_speed(const PlannedTask& plan, const PlannedAxis& axis) {
  const std::optional<solver::Range>& range = axis[Quantity::velocity];
  double most = plan.speed_limit(axis);
  if (axis.driver == Quantity::velocity && axis.target) return std::min(most, std::abs(*axis.target));
  if (axis.driver == Quantity::force && axis.target && range)
    most = std::min(most, *axis.target < 0.0 ? -range->low : range->high);
  return most;
}

/// By velocity ranges on other axes of the base, the robot file's among them: what they leave along
/// `forward`, in the base. [m/s]
double limit_along(const PlannedTask& plan, const Vector3& forward, const PlannedAxis& axis, Probe& probe) {
  double most = most_speed(plan, {0, {}, {}}, probe).most;
  for (const PlannedAxis& other : plan.axes) {
    const auto& range = other[Quantity::velocity];
    if (!range || other.move.body != 0 || other.turns() || other.is_feature()) continue;
    const bool is_on_base = other.in.body == 0;
    if (!is_on_base && probe.alignment(axis, other) == 0) continue;
    const double share =
        is_on_base ? forward.dot(other.in.pose.rotation.col(static_cast<int>(other.axis))) : 1.0;
    if (std::abs(share) > 1e-3) most = std::min(most, std::max(range->high, -range->low) / std::abs(share));
  }
  return most;
}

/// The acceleration that the driver asks for at the speed v, `left` before its target. Infinite: as much as
/// it can. [m/s^2]
double asked_acceleration(const PlannedAxis& axis, double mass, double v, double left) {
  const double T = axis.time_constant;
  if (axis.driver == Quantity::velocity) return (std::abs(*axis.target) - v) / T;
  if (axis.driver != Quantity::position) return solver::infinity;
  if (!axis.is_spring) return left / (T * T) - 2.0 * v / T;
  return (axis.stiffness.value_or(0.0) * left - axis.damping.value_or(0.0) * v) / mass;
}

/// From rest to the way s; 0: it never comes there. [m/s]
double speed_after(double way, const PlannedAxis& axis, double mass, double acceleration, double to_target,
                   double most) {
  if (axis.driver != Quantity::position && axis.driver != Quantity::velocity)
    return std::min(most, std::sqrt(2.0 * acceleration * way));
  constexpr double step = 1e-3, longest = 300.0;  // [s]
  double x = 0.0, v = 0.0;
  for (double t = 0.0; t < longest; t += step) {
    v = std::min(most, v + step * std::clamp(asked_acceleration(axis, mass, v, to_target - x), -acceleration,
                                             acceleration));
    x += step * v;
    if (x >= way) return v;
  }
  return 0.0;
}

/// The largest force [N] of the driver in any state: m a, with a of its target or of the acceleration limit.
/// The motors and the force range bound it.
double most_pressed(const PlannedTask& plan, const PlannedAxis& axis, const AxisFigures& figures) {
  const double sign = axis.target && *axis.target < 0.0 ? -1.0 : 1.0;
  double a = std::min(acceleration_limit(plan, axis, sign, true).most, figures.force / figures.mass);
  if (axis.driver == Quantity::acceleration && axis.target) a = std::min(a, std::abs(*axis.target));
  if (axis.driver == Quantity::force && axis.target) a = std::min(a, std::abs(*axis.target) / figures.mass);
  if (const auto& range = axis[Quantity::force])
    a = std::min(a, std::max(range->high, -range->low) / figures.mass);
  return figures.mass * a;
}

/// Whether a driver of the base may move it from where it starts.
bool may_move(const PlannedAxis& other, const Probe& probe) {
  constexpr double there = 1e-3;  // [m] or [rad]
  if (!other.driver || other.move.body != 0 || other.is_yield || other.stands_still()) return false;
  if (other.is_feature() || !other.is_placed || other.is_set || other.is_on_path || !other.target)
    return true;
  if (other.driver != Quantity::position) return *other.target != 0.0;
  return std::abs(*other.target - probe.position_at_start(other)) > there;
}

/// The way ahead of a task that begins where the scene says.
void look_ahead(const PlannedTask& plan, const PlannedAxis& axis, const std::optional<Scene>& scene,
                double sign, Probe& probe, Arrival& arrival) {
  bool drifts = axis.in.body > 0;
  for (const PlannedAxis& other : plan.axes) {
    if (&other == &axis || !may_move(other, probe)) continue;
    (other.turns() ? arrival.turns : drifts) = true;
  }
  arrival.forward = sign * probe.direction(axis);
  arrival.is_straight = !drifts && !arrival.turns;
  if (arrival.is_straight) arrival.ahead = first_ahead(*scene, probe.robot(), *arrival.forward);
}

}  // namespace

Arrival arrival_of(const PlannedTask& plan, const PlannedAxis& axis, const AxisFigures& figures,
                   const std::optional<Scene>& scene, bool is_first, Probe& probe) {
  const double said = said_speed(plan, axis);
  Arrival arrival;
  arrival.is_bound = !std::isfinite(said);
  if (!axis.target) {  // of a signal, or `here`
    arrival.speed = std::isfinite(said) && axis.driver != solver::Quantity::velocity ? said : 0.0;
    return arrival;
  }
  if (axis.driver != solver::Quantity::position && *axis.target == 0.0) return {};
  const bool starts_here = is_first && axis.is_placed && !axis.is_set && !axis.is_on_path;
  double to_target = *axis.target;
  if (axis.driver == solver::Quantity::position && starts_here) to_target -= probe.position_at_start(axis);
  if (axis.driver == solver::Quantity::position && starts_here && std::abs(to_target) < 1e-3)
    return {};  // it is there
  const double most = limit_along(plan, direction_in_base(axis, probe, scene), axis, probe);
  arrival.speed = std::isfinite(said) ? said : std::isfinite(most) ? most : 0.0;
  if (!starts_here || !scene || probe.robot().footprint.empty()) return arrival;
  look_ahead(plan, axis, scene, to_target < 0.0 ? -1.0 : 1.0, probe, arrival);
  if (!arrival.ahead.is_any()) return arrival;
  const double way = arrival.ahead.meeting.way;
  if (axis.driver == solver::Quantity::position) arrival.left = std::abs(to_target) - way;
  arrival.is_bound = false;
  arrival.speed = speed_after(way, axis, figures.mass, most_pressed(plan, axis, figures) / figures.mass,
                              std::abs(to_target), std::min(said, most));
  return arrival;
}

DriverPush driver_push_of(const PlannedTask& plan, const PlannedAxis& axis, const AxisFigures& figures,
                          const Arrival& arrival, double bound, const Drive& drive) {
  double most = std::min(figures.force, drive.mass_factor * most_pressed(plan, axis, figures));
  if (bound > 0.0) most = std::min(most, bound);
  if (axis.driver == solver::Quantity::velocity && !axis.build_up)
    most = std::min(most, drive.mass_factor * figures.mass * std::abs(*axis.target) / axis.time_constant);
  const double m = figures.mass, T = axis.time_constant;
  const bool is_known = axis.driver == solver::Quantity::velocity || arrival.left;
  if (!is_known || axis.build_up || drive.feels_contact()) return DriverPush::constant(most);
  const double asked = m * asked_acceleration(axis, m, arrival.speed, arrival.left.value_or(0.0));
  if (axis.driver == solver::Quantity::velocity) return {most, asked, m / T, 0.0};
  if (!axis.is_spring) return {most, asked, 2.0 * m / T, m / (T * T)};
  return {most, asked, axis.damping.value_or(0.0), axis.stiffness.value_or(0.0)};
}

}  // namespace zwang::lang
