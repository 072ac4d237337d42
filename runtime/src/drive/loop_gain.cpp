#include "drive/loop_gain.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>

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

/// [rad/s] For a twist of the base; none: the wheel swivels.
std::optional<Eigen::Vector3d> rate_of(const solver::Model& model, const WheelMotor& motor) {
  for (const solver::Wheel& wheel : model.wheels()) {
    const bool is_it = wheel.body == motor.joint + 1;
    if (is_it && model.bodies()[static_cast<std::size_t>(wheel.body)].parent == 0)
      return rate_per_twist(model, wheel);
  }
  return std::nullopt;
}

/// The weight of each motor's wheel: R^2 (V_x^2 + V_y^2) for 1 m/s, in the mean of x and y as far as wheels
/// turn for them.
std::vector<double> shares(const solver::Model& model, const std::vector<WheelMotor>& motors) {
  Eigen::Vector2d all = Eigen::Vector2d::Zero();
  std::vector<double> share;
  for (const WheelMotor& motor : motors) {
    const std::optional<Eigen::Vector3d> rate = rate_of(model, motor);
    const Eigen::Vector2d way =
        rate ? (motor.radius * rate->head<2>()).cwiseAbs2() : Eigen::Vector2d(1.0, 0.0);
    all += way;
    share.push_back(way.sum());
  }
  constexpr double none = 1e-9;
  const double directions = (all.x() > none ? 1.0 : 0.0) + (all.y() > none ? 1.0 : 0.0);
  for (double& one : share) one /= std::max(1.0, directions);
  return share;
}

double spin_of(const solver::Model& model, const WheelMotor& motor) {
  const solver::Body& body = model.bodies()[static_cast<std::size_t>(motor.joint) + 1];
  const solver::Vector3& axis = body.joint.axis;
  return axis.dot(body.inertia.rotational * axis) + body.joint.rotor_inertia;
}

}  // namespace

double driven_mass(const lang::Robot& robot) {
  const std::vector<WheelMotor> motors = wheel_motors(robot, 0.0);
  const std::vector<double> share = shares(robot.model, motors);
  double mass = robot.model.total_mass();
  for (std::size_t i = 0; i < motors.size(); ++i)
    mass += share[i] * spin_of(robot.model, motors[i]) / (motors[i].radius * motors[i].radius);
  return mass;
}

std::vector<LoopGain> loop_gains(const lang::Robot& robot) {
  const std::vector<WheelMotor> motors = wheel_motors(robot, 0.0);
  double count = 0.0;
  for (const double share : shares(robot.model, motors)) count += share;
  const double mass = driven_mass(robot) / std::max(count, 1e-9);
  std::vector<LoopGain> gains;
  for (const WheelMotor& motor : motors) {
    const double k_p = mass * motor.radius * motor.radius / robot.drive.time_constant;
    const double k_i = robot.drive.integral_time ? k_p / *robot.drive.integral_time : 0.0;
    gains.push_back({motor.joint, robot.model.joint(motor.joint).max_effort, k_p, k_i,
                     rate_of(robot.model, motor).value_or(Eigen::Vector3d::Zero())});
  }
  return gains;
}

}  // namespace zwang::runtime
