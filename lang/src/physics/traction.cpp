// W642: a driver that asks for more than the floor holds. Each driven wheel passes on the force along the
// direction e that it holds on the ground, mu N at most, N its load:
//
//   F <= mu sum N |e . n|      along the axis n
//
// On three points the loads N are known by statics. On more nobody knows them: the driven wheels that lie
// best to the axis are taken to carry all of the weight, so that what is told is true however it is shared.
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

/// The share of a driven wheel's ground force that acts along the axis, at the start.
double share_along(const Robot& robot, const solver::Wheel& wheel, const Vector3& axis) {
  const solver::State state = start_state(robot);
  const solver::Pose pose = solver::motion_of({wheel.body, {}}, robot.model, state).pose;
  const Vector3 shaft = pose.rotation * robot.model.joint(wheel.body - 1).axis;
  const Vector3 flat = Vector3(shaft.x(), shaft.y(), 0.0).normalized();
  Vector3 held = flat.cross(Vector3::UnitZ());
  if (wheel.roller_angle) held = Eigen::AngleAxisd(*wheel.roller_angle, Vector3::UnitZ()) * flat;
  return std::abs(held.dot(axis));
}

/// What the floor holds along the axis with mu = 1. [N]
double grip(const Robot& robot, const Footing& footing, const Vector3& axis) {
  const std::vector<double> loads = footing.loads();
  const bool loads_are_known = footing.points.size() == 3;
  double known = 0.0, best = 0.0;
  for (std::size_t w = 0; w < robot.model.wheels().size(); ++w) {
    const solver::Wheel& wheel = robot.model.wheels()[w];
    if (!is_driven(robot.model, wheel)) continue;
    const double share = share_along(robot, wheel, axis);
    known += std::max(0.0, loads[w]) * share;
    best = std::max(best, share);
  }
  return loads_are_known ? known : footing.weight * best;
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
    const bool asks = axis.driver && axis.driver != solver::Quantity::position && axis.move.body == 0 &&
                      !axis.turns() && !axis.is_feature() && axis.target && *axis.target != 0.0 &&
                      !probe.is_out_of_plane(axis) && !remarks.any_at(axis.driver_span());
    const AxisFigures* figures = asks ? probe.figures(axis) : nullptr;
    if (figures == nullptr || !figures->is_reachable || !std::isfinite(figures->mass)) continue;
    const double asked = asked_force(plan, axis, figures->mass);
    const double held =
        scene->floor_friction * grip(probe.robot(), *footing, direction_in_base(axis, probe, scene));
    if (asked <= held || !(held > 0.0)) continue;
    remarks.add(wording::beyond_the_floor(axis.driver_span(), axis.path, asked, held, scene->floor_friction,
                                          held / scene->floor_friction));
  }
}

}  // namespace zwang::lang
