// W611: a speed of the base that its wheels' motors cannot turn to, by the <limit velocity> of the URDF.
// Along the base's own axes it is asked as it is. Along the world's axes, and of the planar `speed`, the
// direction in the base is any one. A speed is told if it is too fast in all of them.
//
// An arm's frame goes at most
//
//   v <= max over q of sum |J_i| qd_i + v_base + w_base r      q: the configurations that are looked at
//
// so a driver beyond it ends at a joint's speed, where the guard stops the arm. Whatever else holds the arm
// is not asked.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_standing.hpp"
#include "physics/questions.hpp"
#include "robot/wheel_speed.hpp"
#include "zwang/solver/wheels.hpp"

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

/// Of the base, at a lever as long as the way to the frame at the start. 0 where rows keep it standing.
double speed_of_base(const PlannedTask& plan, const PlannedAxis& axis, Probe& probe) {
  if (axis.in.body >= 0 && axis.in.body != axis.move.body) return 0.0;  // it carries both
  int held = 0;
  for (const PlannedAxis& row : plan.axes)
    held += row.move.body == 0 && row.stands_still() && !row.is_soft ? 1 : 0;
  if (held >= probe.base_mobility()) return 0.0;
  const double lever = probe.reach_at_start(axis.move);
  const double turning = most_turning(plan, probe).most;
  return axis.turns() ? turning : most_speed(plan, {0, {}, {}}, probe).most + lever * turning;
}

void ask_arm_speed(const PlannedTask& plan, const PlannedAxis& axis, const Robot& robot, Probe& probe,
                   Remarks& remarks) {
  const bool is_of_arm = axis.move.body > 0 && !solver::carries_wheel(robot.model, axis.move.body);
  const bool drives = axis.driver == solver::Quantity::velocity && axis.target && axis.text != nullptr;
  if (!is_of_arm || !drives || axis.is_feature() || axis.is_soft) return;
  const Probe::JointSpeed joints = probe.joint_speed(axis);
  const double most = joints.most + speed_of_base(plan, axis, probe), asked = std::abs(*axis.target);
  if (joints.joint < 0 || !(asked > most * (1.0 + 1e-6))) return;
  const solver::Joint& joint = robot.model.joint(joints.joint);
  remarks.add(
      wording::beyond_the_joints(axis.driver_span(),
                                 {axis.path, axis.turns(), asked, most, joint.name, joint.max_velocity, false,
                                  false, joint.type == solver::JointType::prismatic},
                                 robot.joint_spans[static_cast<std::size_t>(joints.joint)]));
}

}  // namespace

void ask_top_speed(const PlannedTask& plan, const Robot& robot, Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) ask_arm_speed(plan, axis, robot, probe, remarks);
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
