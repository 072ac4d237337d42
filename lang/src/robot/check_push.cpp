// W872. With tau_i the largest torque of driven wheel i and R_i its radius, the wheels press against the
// floor with
//
//   F = sum tau_i / R_i           and the floor holds at most          F_floor = mu (m + m_load) g
//
// Beyond F_floor the wheels spin, whatever the motors could do. A URDF that says more was written for a
// simulator.
#include "robot/check_push.hpp"

#include <algorithm>

#include "diagnostic/wordings_standing.hpp"
#include "robot/gravity.hpp"

namespace zwang::lang {

namespace {

/// Of soft rubber on clean, dry concrete; the wheels of indoor robots have 0.4 to 1.
constexpr double most_friction = 1.5;
/// Beside its own weight, a load as heavy as the robot presses its wheels to the floor.
constexpr double most_load = 1.0;

}  // namespace

double floor_holds(double mass) {
  return most_friction * (1.0 + most_load) * mass * gravity;
}

void check_push(const RobotFile& file, const Robot& robot, Diagnostics& diagnostics) {
  double push = 0.0;  // [N] F, of wheels whose torque the robot file leaves to the URDF
  const ActuatorText* first = nullptr;
  double effort = 0.0;
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const solver::Joint& joint = robot.model.joint(wheel.body - 1);
    const auto motor = std::find_if(file.actuators.begin(), file.actuators.end(),
                                    [&](const ActuatorText& a) { return a.joint.text == joint.name; });
    if (motor == file.actuators.end() || motor->effort_text) continue;
    push += joint.max_effort / wheel.radius;
    if (first == nullptr) effort = joint.max_effort;
    if (first == nullptr) first = &*motor;
  }
  const double holds = floor_holds(robot.model.total_mass());
  if (first == nullptr || push <= holds) return;
  diagnostics.add(wording::push_beyond_floor(
      first->joint.span, first->joint.text,
      {.effort = effort, .push = push, .holds = holds, .mass = robot.model.total_mass()}));
}

}  // namespace zwang::lang
