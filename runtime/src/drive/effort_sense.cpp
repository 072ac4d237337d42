#include "drive/effort_sense.hpp"

#include <algorithm>
#include <cmath>

#include "guard/wheel_motors.hpp"

namespace zwang::runtime {

EffortSense::EffortSense(const lang::Robot& robot)
    : drive_(robot.drive),
      friction_(robot.friction),
      T_factor_(robot.model.joint_count() + 6),
      B_factor_(3),
      B_turned_(Eigen::MatrixXd::Zero(robot.model.joint_count() + 6, 3)),
      bias_(Eigen::VectorXd::Zero(robot.model.joint_count() + 6)),
      now_(Eigen::VectorXd::Zero(robot.model.joint_count())),
      effort_(now_),
      qd_(now_),
      filtered_(now_),
      y_(bias_),
      p_(bias_) {
  double square = 0.0;
  friction_.resize(static_cast<std::size_t>(robot.model.joint_count()));
  for (const WheelMotor& motor : wheel_motors(robot, 0.0)) {
    wheels_.push_back(motor.joint);
    square += 1.0 / (motor.radius * motor.radius);
    const lang::JointFriction& friction = friction_[static_cast<std::size_t>(motor.joint)];
    unknown_friction_ += (1.0 - friction.compensate) * friction.coulomb / motor.radius;
  }
  force_per_torque_ = std::sqrt(square);
  rates_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(wheels_.size()));
  T_ = Eigen::MatrixXd::Zero(rates_.size(), bias_.size());
}

double EffortSense::noise() const noexcept {
  const double step = drive_.feels.resolution / std::sqrt(12.0);
  return std::hypot(drive_.feels.noise, step) * force_per_torque_;
}

/// bias = T' tau - ydd.
void EffortSense::follow(const solver::FreeMotions& motions, const solver::Solution& solution) noexcept {
  count_ = motions.count;
  for (int a = 0; a < count_; ++a) {
    for (std::size_t i = 0; i < wheels_.size(); ++i)
      T_(static_cast<Eigen::Index>(i), a) = motions.joint(wheels_[i], a);
    for (int row = 0; row < 3; ++row) B_turned_(a, row) = motions.base(row, a);
  }
  T_factor_.factorise(T_, T_.rows(), count_);
  B_factor_.factorise(B_turned_, count_, 3);
  for (std::size_t i = 0; i < wheels_.size(); ++i)
    rates_(static_cast<Eigen::Index>(i)) = solution.qdd(wheels_[i]);
  least_squares();
  for (int a = 0; a < count_; ++a) {
    bias_(a) = -y_(a);
    for (const int j : wheels_) bias_(a) += motions.joint(j, a) * solution.tau(j);
  }
}

void EffortSense::least_squares() noexcept {
  for (int a = 0; a < count_; ++a) y_(a) = dot(T_.col(a).data(), rates_.data(), T_.rows());
  T_factor_.solve(y_, y_);
}

void EffortSense::take(const Sensed& sensed) noexcept {
  for (const int j : wheels_) {
    const lang::JointFriction& friction = friction_[static_cast<std::size_t>(j)];
    const double rate = sensed.state.qd(j);
    const double dry = friction.coulomb * std::tanh(rate / sliding);
    now_(j) = sensed.effort(j) - friction.compensate * (dry + friction.viscous * rate);
  }
}

/// Between two samples the rate goes straight.
void EffortSense::accelerate(const Eigen::VectorXd& qd, double since) noexcept {
  const double T = drive_.feels.filter;
  const double left = T > 0.0 ? std::exp(-since / T) : 0.0;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const int j = wheels_[i];
    const double slope = (qd(j) - qd_(j)) / since;
    const double behind = left * filtered_(j) + (1.0 - left) * qd_(j) + slope * (since - T * (1.0 - left));
    rates_(static_cast<Eigen::Index>(i)) = (behind - filtered_(j)) / since;
    filtered_(j) = behind;
  }
}

solver::Vector3 EffortSense::feel(const Sensed& sensed, double stamp) noexcept {
  constexpr double longest = 4.0;  // cycles
  const double since = stamp - felt_at_;
  const bool is_next = is_known_ && count_ > 0 && since > 0.0 && since < longest / drive_.rate;
  take(sensed);
  solver::Vector3 w = solver::Vector3::Zero();
  if (is_next) {
    accelerate(sensed.state.qd, since);
    least_squares();
    for (int a = 0; a < count_; ++a) {
      p_(a) = (y_(a) + bias_(a)) / drive_.mass_factor;
      for (std::size_t i = 0; i < wheels_.size(); ++i) {
        const double effort = 0.5 * (now_(wheels_[i]) + effort_(wheels_[i]));
        p_(a) -= T_(static_cast<Eigen::Index>(i), a) * effort;
      }
    }
    for (int row = 0; row < 3; ++row) y_(row) = dot(B_turned_.col(row).data(), p_.data(), count_);
    B_factor_.solve(y_, y_);
    w = y_.head<3>();
  } else {
    filtered_ = sensed.state.qd;
  }
  effort_ = now_;
  qd_ = sensed.state.qd;
  felt_at_ = stamp;
  is_known_ = true;
  return w;
}

}  // namespace zwang::runtime
