// W611: a speed of the base that its wheels' motors cannot turn to, by the <limit velocity> of the URDF.
// Along the base's own axes it is asked as it is. Along the world's axes, and of the planar `speed`, the
// direction in the base is any one. A speed is told if it is too fast in all of them.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_standing.hpp"
#include "physics/questions.hpp"
#include "robot/wheel_speed.hpp"

namespace zwang::lang {

namespace {

/// The speed that the wheels attain along a planar axis of a frame that is fixed to the base.
struct Attainable {
  WheelSpeed speed;
  bool in_any_direction = false;  ///< the best of them
};

std::optional<Attainable> attainable(const PlannedAxis& axis, const Robot& robot) {
  using solver::Axis;
  if (axis.move.body != 0 || axis.in.body > 0 || axis.is_feature()) return std::nullopt;
  if (axis.axis == Axis::rz) return Attainable{wheel_speed_along(robot, Axis::rz)};
  if (axis.axis != Axis::x && axis.axis != Axis::y) return std::nullopt;
  if (axis.in.body < 0) return Attainable{wheel_speed_at_best(robot), true};
  const solver::Vector3 along = axis.in.pose.rotation.col(axis.axis == Axis::x ? 0 : 1);
  if (std::abs(along.z()) > 1e-9) return std::nullopt;
  return Attainable{wheel_speed(robot, along, 0.0)};
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
    const std::optional<Attainable> can = attainable(axis, robot);
    if (!can || axis.text == nullptr) continue;  // the robot file's own limits are asked with it
    const auto& range = axis[solver::Quantity::velocity];
    const bool drives = axis.driver == solver::Quantity::velocity && axis.target;
    if (!drives && !range) continue;
    wording::TooFast fast;
    fast.axis = axis.path;
    fast.turns = axis.turns();
    fast.is_range = !drives;
    fast.asked = drives ? std::abs(*axis.target) : std::max(range->high, -range->low);
    fast.in_any_direction = can->in_any_direction;
    compare(robot, axis.span(solver::Quantity::velocity), fast, can->speed, remarks);
  }
  for (const PlannedSpeed& speed : plan.speeds) {
    if (speed.body != 0) continue;
    wording::TooFast fast;
    fast.axis = speed.path;
    fast.is_range = true;
    fast.asked = speed.most;
    fast.in_any_direction = true;
    compare(robot, speed.span, fast, wheel_speed_at_best(robot), remarks);
  }
}

}  // namespace zwang::lang
