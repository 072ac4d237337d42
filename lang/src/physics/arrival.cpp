// How fast the base arrives:
//
//   velocity v             |v|
//   a velocity range       its end: of the axis, of `speed`, beside a force driver the end that it pushes to
//   else                   over the way s to the object, from rest, with the acceleration a
//
//     v^2 = 2 a s,   a = min(demand, the acceleration limits, F / m),   v <= the robot's own limits
//
// F is the force of the motors along the axis. The demand is F / m of a force driver, and c of an
// acceleration. Of a position it is the critically damped  (d - x) / T^2 - 2 v / T,  d from the start to the
// target.
//
// The way is known in the task that begins where the scene says. Elsewhere the limits are a bound.
#include "physics/arrival.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "physics/statics.hpp"
#include "scene/outline.hpp"
#include "zwang/lang/object_outline.hpp"
#include "zwang/lang/plane.hpp"

namespace zwang::lang {

namespace {

using solver::Quantity;
using solver::Vector3;

/// What the file itself says; infinite where it says nothing. [m/s]
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

/// From the foremost points of `outline` to the object, straight on along `forward`; infinite: it passes by.
/// All in the world. [m]
double way_between(const std::vector<Vector3>& outline, const std::vector<Vector3>& object,
                   const Vector3& forward) {
  double least = solver::infinity;
  const auto from = [&](const Vector3& p, const std::vector<Vector3>& polygon, double sign) {
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
      const Vector3 edge = polygon[i] - polygon[j], to = polygon[j] - p;
      // p + t sign forward = polygon[j] + u edge
      const double cross = sign * (forward.x() * edge.y() - forward.y() * edge.x());
      if (std::abs(cross) < 1e-12) continue;
      const double t = (to.x() * edge.y() - to.y() * edge.x()) / cross;
      const double u = sign * (to.x() * forward.y() - to.y() * forward.x()) / cross;
      if (t >= -1e-6 && u >= 0.0 && u <= 1.0) least = std::min(least, std::max(0.0, t));
    }
  };
  for (const Vector3& p : outline) from(p, object, 1.0);
  for (const Vector3& p : object) from(p, outline, -1.0);
  return least;
}

Outline outline_in_world(const SceneObject& object, double height) {
  constexpr int sides = 32;
  const Pose2 pose{object.at, object.yaw};
  if (object.shape != ShapeKind::cylinder) return placed(outline_of(object, height), pose);
  Outline outline;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    outline.push_back(object.size[0] * Vector3(std::cos(angle), std::sin(angle), 0.0));
  }
  return placed(std::move(outline), pose);
}

struct Ahead {
  const SceneObject* object = nullptr;
  double way = solver::infinity;  ///< [m]
};

/// The first object that the base meets, straight on from its start.
Ahead first_ahead(const Scene& scene, const Robot& robot, const Vector3& forward) {
  const solver::Pose pose = start_state(robot, scene).base_pose;
  std::vector<Vector3> outline;
  for (const Vector3& corner : robot.footprint) outline.push_back(pose * corner);
  Ahead ahead;
  for (const SceneObject& object : scene.objects) {
    if (!reaches(object, robot.bumper_height) || !object.motion.empty()) continue;
    const double way = way_between(outline, outline_in_world(object, robot.bumper_height), forward);
    if (way < ahead.way) ahead = {&object, way};
  }
  return ahead;
}

/// From rest to the way s; 0: it never comes there. [m/s]
double speed_after(double way, const PlannedAxis& axis, double acceleration, double to_target, double most) {
  if (axis.driver != Quantity::position) return std::min(most, std::sqrt(2.0 * acceleration * way));
  constexpr double step = 1e-3, longest = 120.0;  // [s]
  const double T = axis.time_constant;
  double x = 0.0, v = 0.0;
  for (double t = 0.0; t < longest; t += step) {
    const double demand = (to_target - x) / (T * T) - 2.0 * v / T;
    v = std::min(most, v + step * std::clamp(demand, -acceleration, acceleration));
    x += step * v;
    if (x >= way) return v;
  }
  return 0.0;
}

}  // namespace

double pressed_without_range(const PlannedTask& plan, const PlannedAxis& axis, const AxisFigures& figures) {
  const double sign = axis.target && *axis.target < 0.0 ? -1.0 : 1.0;
  double a = std::min(acceleration_limit(plan, axis, sign, true).most, figures.force / figures.mass);
  if (axis.driver == solver::Quantity::acceleration && axis.target) a = std::min(a, std::abs(*axis.target));
  if (axis.driver == solver::Quantity::force && axis.target)
    a = std::min(a, std::abs(*axis.target) / figures.mass);
  if (const auto& range = axis[solver::Quantity::force])
    a = std::min(a, std::max(range->high, -range->low) / figures.mass);
  return figures.mass * a;
}

Arrival arrival_of(const PlannedTask& plan, const PlannedAxis& axis, const AxisFigures& figures,
                   const std::optional<Scene>& scene, bool is_first, Probe& probe) {
  const double said = said_speed(plan, axis);
  if (std::isfinite(said)) return {said, false, nullptr};
  if (!axis.target || axis.driver == solver::Quantity::velocity) return {};
  if (axis.driver != solver::Quantity::position && *axis.target == 0.0) return {};
  const Robot& robot = probe.robot();
  const bool starts_here = is_first && axis.is_placed && !axis.is_set && !axis.is_on_path;
  double to_target = *axis.target;
  if (axis.driver == solver::Quantity::position && starts_here) to_target -= probe.position_at_start(axis);
  const double sign = to_target < 0.0 ? -1.0 : 1.0;
  const double most = limit_along(plan, direction_in_base(axis, probe, scene), axis, probe);
  const double bound = std::isfinite(most) ? most : 0.0;
  if (!starts_here) return {bound, true, nullptr};
  if (axis.driver == solver::Quantity::position && std::abs(to_target) < 1e-3) return {};  // it is there
  if (!scene || robot.footprint.empty()) return {bound, true, nullptr};
  const Ahead ahead = first_ahead(*scene, robot, sign * probe.direction(axis));
  if (ahead.object == nullptr) return {bound, true, nullptr};
  const double a = pressed_without_range(plan, axis, figures) / figures.mass;
  return {speed_after(ahead.way, axis, a, std::abs(to_target), most), false, ahead.object};
}

}  // namespace zwang::lang
