// W642: a driver that asks for more than the floor holds. Each driven wheel passes on the force along the
// direction e that it holds on the ground, mu N at most, N its load:
//
//   F <= mu sum N |e . n|      along the axis n
//
// Asked of drivers of the base, and of the protective stop, which brakes with m a.
//
// On three points the loads N are known by statics. On more they depend on how the wheels give way. The
// largest sum that statics allow is taken, so that a warning is true however the weight is shared.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_statics.hpp"
#include "physics/statics.hpp"
#include "zwang/lang/footing.hpp"
#include "zwang/lang/wheel_level.hpp"

namespace zwang::lang {

namespace {

using solver::Vector3;

/// Whether a motor turns the wheel.
bool is_driven(const solver::Model& model, const solver::Wheel& wheel) {
  return model.joint(wheel.body - 1).actuated;
}

/// The largest share of a driven wheel's ground force mu N that can act along the axis, at the start. A wheel
/// that also holds sideways passes on force in any direction: of its motor, or of the one that swivels it.
double share_along(const Robot& robot, const solver::Wheel& wheel, const Vector3& axis) {
  if (wheel.held_directions() > 1) return 1.0;
  const solver::State state = start_state(robot);
  const solver::Pose pose = solver::motion_of({wheel.body, {}}, robot.model, state).pose;
  const Vector3 shaft = pose.rotation * robot.model.joint(wheel.body - 1).axis;
  const Vector3 flat = Vector3(shaft.x(), shaft.y(), 0.0).normalized();
  Vector3 held = flat.cross(Vector3::UnitZ());
  if (wheel.roller_angle) held = Eigen::AngleAxisd(*wheel.roller_angle, Vector3::UnitZ()) * flat;
  return std::abs(held.dot(axis));
}

/// The largest force [N] of the floor on the driven wheels along the axis, with mu = 1. 0: no motor pushes
/// along it.
double grip(const Robot& robot, const Footing& footing, const Vector3& axis) {
  std::vector<double> shares(footing.points.size(), 0.0);
  for (std::size_t w = 0; w < footing.wheels; ++w) {
    const solver::Wheel& wheel = robot.model.wheels()[w];
    if (is_driven(robot.model, wheel)) shares[w] = share_along(robot, wheel, axis);
  }
  const double held = footing.most_carried(shares);
  constexpr double rounding =
      1e-6;  // of the weight: what is left of an axis that a wheel holds nothing along
  return held > rounding * footing.weight ? held : 0.0;
}

/// The force [N] that a position driver asks for while it is far off. The ranges in force bound it. 0: only
/// the motors bound it.
double asked_from_afar(const PlannedTask& plan, const PlannedAxis& axis, const AxisFigures& figures) {
  double most = 0.0;
  for (const double sign : {1.0, -1.0}) {
    double force = acceleration_limit(plan, axis, sign, true).most * figures.mass;
    if (const auto& range = axis[solver::Quantity::force])
      force = std::min(force, sign > 0.0 ? range->high : -range->low);
    if (std::isfinite(force)) most = std::max(most, std::min(force, figures.force));
  }
  return most;
}

double asked_of_floor(const PlannedTask& plan, const PlannedAxis& axis, const AxisFigures& figures) {
  if (axis.driver == solver::Quantity::position) return asked_from_afar(plan, axis, figures);
  if (!axis.target || *axis.target == 0.0) return 0.0;
  return asked_force(plan, axis, figures.mass);
}

}  // namespace

Vector3 direction_in_base(const PlannedAxis& axis, const Probe& probe, const std::optional<Scene>& scene) {
  return start_state(probe.robot(), scene).base_pose.rotation.transpose() * probe.direction(axis);
}

void ask_traction(const PlannedTask& plan, const std::optional<Scene>& scene, Probe& probe,
                  Remarks& remarks) {
  const std::optional<Footing> footing = footing_of(probe.robot());
  if (!scene || !footing || !(footing->inside > 0.0)) return;
  for (const PlannedAxis& axis : plan.axes) {
    const bool asks = axis.driver && !axis.is_spring && axis.move.body == 0 && !axis.turns() &&
                      !axis.is_feature() && !probe.is_out_of_plane(axis) &&
                      !remarks.any_at(axis.driver_span());
    const AxisFigures* figures = asks ? probe.figures(axis) : nullptr;
    if (figures == nullptr || !figures->is_reachable || !std::isfinite(figures->mass)) continue;
    const double asked = asked_of_floor(plan, axis, *figures);
    const double held =
        scene->floor_friction * grip(probe.robot(), *footing, direction_in_base(axis, probe, scene));
    if (asked <= held || !(held > 0.0)) continue;
    remarks.add(wording::beyond_the_floor(axis.driver_span(), axis.path, asked, held, scene->floor_friction,
                                          held / scene->floor_friction));
  }
}

void ask_grip_of_stop(const Span& span, const std::optional<Scene>& scene, Probe& probe, Remarks& remarks) {
  const Robot& robot = probe.robot();
  const std::optional<Footing> footing = footing_of(robot);
  if (!scene || !footing || !(footing->inside > 0.0)) return;
  double held = solver::infinity;
  for (const Vector3& direction : {Vector3(1.0, 0.0, 0.0), Vector3(0.0, 1.0, 0.0)}) {
    if (direction.y() > 0.5 && probe.base_mobility() < 3) continue;
    const double force = scene->floor_friction * grip(robot, *footing, direction);
    if (force > 0.0) held = std::min(held, force / footing->mass);
  }
  const double asked = robot.stop.deceleration;
  if (asked > held) remarks.add(wording::stops_beyond_the_floor(span, asked, held, scene->floor_friction));
}

}  // namespace zwang::lang
