#include "velocity_loop.hpp"

#include <algorithm>

#include "guard/wheel_motors.hpp"

namespace zwang::runtime {

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
    : torque_(Eigen::VectorXd::Zero(robot.model.joint_count())) {
  const std::vector<WheelMotor> motors = wheel_motors(robot, 0.0);
  const double mass = driven_mass(robot) / static_cast<double>(motors.size());
  for (const WheelMotor& motor : motors) {
    const double k_p = mass * motor.radius * motor.radius / robot.drive.time_constant;
    const double k_i = robot.drive.integral_time ? k_p / *robot.drive.integral_time : 0.0;
    wheels_.push_back({motor.joint, robot.model.joint(motor.joint).max_effort, k_p, k_i, 0.0});
  }
}

const Eigen::VectorXd& VelocityLoop::step(const Command& command, const Eigen::VectorXd& qd,
                                          double period) noexcept {
  for (Wheel& wheel : wheels_) {
    const int j = wheel.joint;
    const double low = std::clamp(command.lower(j), -wheel.limit, wheel.limit);
    const double high = std::clamp(command.upper(j), low, wheel.limit);
    const double error = command.velocity(j) - qd(j);
    const double wanted = wheel.proportional * error + wheel.sum;
    torque_(j) = std::clamp(wanted, low, high);
    const bool winds_up = (wanted > high && error > 0.0) || (wanted < low && error < 0.0);
    if (!winds_up) wheel.sum += wheel.integral * error * period;
  }
  return torque_;
}

}  // namespace zwang::runtime
