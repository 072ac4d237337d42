// W809 and W874: joints with motors that turn no wheel and carry none, as the robot starts.
//
// The guard stops an arm before a joint leaves its travel, so one that starts close to an end is stopped by
// the least sway. At an end it rests: a closed gripper, a lift that is down.
//
// A motor holds its joint against gravity: `solver::JointLoads` says what that takes.
// With less the arm sinks from the start.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnostic/wordings_standing.hpp"
#include "robot/check_joints.hpp"
#include "zwang/solver/joint_loads.hpp"
#include "zwang/solver/wheels.hpp"

namespace zwang::lang {

namespace {

/// As close to an end the guard takes a joint to rest on it.
constexpr double rests_within = 2e-3, slide_rests_within = 2e-4;  // [rad], [m]
/// An arm that is held sways by less, and by a smaller share of a short travel.
constexpr double sways_within = 2.0 * std::numbers::pi / 180.0, slide_sways_within = 5e-3;  // [rad], [m]
constexpr double sway_of_travel = 0.04, proposed_of_travel = 0.08;

bool is_sliding(const solver::Joint& joint) {
  return joint.type == solver::JointType::prismatic;
}

/// Where the file says how the joint stands, else where it names the motor.
Span start_span(const RobotFile& file, const std::string& joint) {
  for (const PostureText& posture : file.posture) {
    if (posture.joint.text == joint) return posture.value.span;
  }
  for (const ActuatorText& actuator : file.actuators) {
    if (actuator.joint.text == joint) return actuator.joint.span;
  }
  return file.urdf.span;
}

void check_travel(const RobotFile& file, const solver::Joint& joint, double q, Diagnostics& diagnostics) {
  const double travel = joint.upper - joint.lower;
  if (!(travel > 0.0) || !std::isfinite(travel)) return;
  const bool is_below = q - joint.lower < joint.upper - q;
  const double left = is_below ? q - joint.lower : joint.upper - q;
  const double sways =
      std::min(is_sliding(joint) ? slide_sways_within : sways_within, sway_of_travel * travel);
  if (left <= (is_sliding(joint) ? slide_rests_within : rests_within) || left >= sways) return;
  const double inside = proposed_of_travel * travel;
  diagnostics.add(wording::starts_near_an_end(
      start_span(file, joint.name), {.joint = joint.name,
                                     .slides = is_sliding(joint),
                                     .left = left,
                                     .end = is_below ? joint.lower : joint.upper,
                                     .inside = is_below ? joint.lower + inside : joint.upper - inside}));
}

}  // namespace

void check_arms(const RobotFile& file, const Robot& robot, Diagnostics& diagnostics) {
  const solver::State start = start_state(robot);
  solver::JointLoads loads(robot.model);
  loads.weigh(start);
  for (const solver::JointLoads::Load& load : loads.all()) {
    if (solver::carries_wheel(robot.model, load.joint + 1)) continue;
    const solver::Joint& joint = robot.model.joint(load.joint);
    check_travel(file, joint, start.q(load.joint), diagnostics);
    const double borne = std::abs(load.weight);
    if (borne > joint.max_effort)
      diagnostics.add(wording::arm_too_heavy(start_span(file, joint.name), joint.name, borne,
                                             joint.max_effort, is_sliding(joint)));
  }
}

}  // namespace zwang::lang
