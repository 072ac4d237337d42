#include "velocity_loop.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "guard/wheel_motors.hpp"

namespace zwang::runtime {

namespace {

/// [rad/s] For a twist of the base. `wheel` hangs on the base.
Eigen::Vector3d rate_per_twist(const solver::Model& model, const solver::Wheel& wheel) {
  const solver::Body& body = model.bodies()[static_cast<std::size_t>(wheel.body)];
  const solver::Vector3 axis = (body.pose_in_parent.rotation * body.joint.axis).normalized();
  const solver::Vector3 down = -wheel.radius * solver::Vector3::UnitZ();
  const solver::Vector3 P = body.pose_in_parent.position + down;
  // A roller's axis at the ground; without rollers the way that the wheel rolls.
  const solver::Vector3 rolling = axis.cross(solver::Vector3::UnitZ());
  solver::Vector3 u = rolling;
  if (wheel.roller_angle) u = Eigen::AngleAxisd(*wheel.roller_angle, solver::Vector3::UnitZ()) * axis;
  const solver::Vector3 turn = solver::Vector3::UnitZ().cross(P);
  return -Eigen::Vector3d(u.x(), u.y(), u.dot(turn)) / u.dot(axis.cross(down));
}

}  // namespace

double VelocityLoop::driven_mass(const lang::Robot& robot) {
  double mass = 0.0;
  for (const solver::Body& body : robot.model.bodies()) mass += body.inertia.mass;
  for (const WheelMotor& motor : wheel_motors(robot, 0.0)) {
    const solver::Body& body = robot.model.bodies()[static_cast<std::size_t>(motor.joint) + 1];
    const solver::Vector3& axis = body.joint.axis;
    const double spin = axis.dot(body.inertia.rotational * axis) + body.joint.rotor_inertia;
    mass += spin / (motor.radius * motor.radius);
  }
  return mass;
}

VelocityLoop::VelocityLoop(const lang::Robot& robot)
    : takes_twist_(robot.drive.takes_twist),
      limit_is_fixed_(robot.drive.limit_is_fixed),
      torque_(Eigen::VectorXd::Zero(robot.model.joint_count())) {
  const std::vector<WheelMotor> motors = wheel_motors(robot, 0.0);
  const double mass = driven_mass(robot) / static_cast<double>(motors.size());
  for (const WheelMotor& motor : motors) {
    const double k_p = mass * motor.radius * motor.radius / robot.drive.time_constant;
    const double k_i = robot.drive.integral_time ? k_p / *robot.drive.integral_time : 0.0;
    Wheel wheel{motor.joint, robot.model.joint(motor.joint).max_effort, k_p, k_i, 0.0};
    for (const solver::Wheel& of : robot.model.wheels()) {
      if (takes_twist_ && of.body == motor.joint + 1) wheel.per_twist = rate_per_twist(robot.model, of);
    }
    wheels_.push_back(wheel);
  }
}

const Eigen::VectorXd& VelocityLoop::step(const Command& command, const Eigen::VectorXd& qd,
                                          double period) noexcept {
  for (Wheel& wheel : wheels_) {
    const int j = wheel.joint;
    const double low =
        limit_is_fixed_ ? -wheel.limit : std::clamp(command.lower(j), -wheel.limit, wheel.limit);
    const double high = limit_is_fixed_ ? wheel.limit : std::clamp(command.upper(j), low, wheel.limit);
    const double error = wanted_velocity(wheel, command) - qd(j);
    const double wanted = wheel.proportional * error + wheel.sum;
    torque_(j) = std::clamp(wanted, low, high);
    const bool winds_up = (wanted > high && error > 0.0) || (wanted < low && error < 0.0);
    if (!winds_up) wheel.sum += wheel.integral * error * period;
  }
  return torque_;
}

}  // namespace zwang::runtime
