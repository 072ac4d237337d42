// W611: a speed along an axis of the base that its wheels' motors cannot turn to, by the <limit velocity> of
// the URDF.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_standing.hpp"
#include "physics/questions.hpp"
#include "robot/wheel_speed.hpp"

namespace zwang::lang {

namespace {

/// The base's own x, y or rz, of whatever is fixed to it; nullopt of other axes. Along the axes of the world
/// the speed depends on the heading, which nobody knows yet.
std::optional<solver::Axis> base_axis(const PlannedAxis& axis) {
  const bool is_on_base = axis.move.body == 0 && axis.in.body == 0 && !axis.is_feature();
  const bool is_aligned = axis.in.pose.rotation.isIdentity(1e-9);
  if (!is_on_base || !is_aligned) return std::nullopt;
  if (axis.axis == solver::Axis::rz) return axis.axis;
  if (axis.axis == solver::Axis::x || axis.axis == solver::Axis::y) return axis.axis;
  return std::nullopt;
}

void compare(const Robot& robot, const Span& span, wording::TooFast fast, const WheelSpeed& speed,
             Remarks& remarks) {
  if (!(fast.asked > speed.most * (1.0 + 1e-6))) return;
  const solver::Joint& joint = robot.model.joint(speed.joint);
  fast.most = speed.most;
  fast.wheel = joint.name;
  fast.wheel_most = joint.max_velocity;
  remarks.add(
      wording::beyond_the_wheels(span, fast, robot.joint_spans[static_cast<std::size_t>(speed.joint)]));
}

}  // namespace

void ask_top_speed(const PlannedTask& plan, const Robot& robot, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) {
    const std::optional<solver::Axis> along = base_axis(axis);
    if (!along || axis.text == nullptr) continue;  // the robot file's own limits are asked with it
    const auto& range = axis[solver::Quantity::velocity];
    const bool drives = axis.driver == solver::Quantity::velocity && axis.target;
    if (!drives && !range) continue;
    wording::TooFast fast;
    fast.axis = axis.path;
    fast.turns = axis.turns();
    fast.is_range = !drives;
    fast.asked = drives ? std::abs(*axis.target) : std::max(range->high, -range->low);
    compare(robot, axis.span(solver::Quantity::velocity), fast, wheel_speed_along(robot, *along), remarks);
  }
}

}  // namespace zwang::lang
