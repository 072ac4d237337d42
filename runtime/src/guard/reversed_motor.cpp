#include "guard/reversed_motor.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

ReversedMotor::ReversedMotor(const lang::Robot& robot, double period) : period_(period) {
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const int j = wheel.body - 1;
    const solver::Joint& joint = robot.model.joint(j);
    if (!joint.actuated || !std::isfinite(joint.max_effort)) continue;
    const auto i = static_cast<std::size_t>(j);
    const double coulomb = i < robot.friction.size() ? robot.friction[i].coulomb : 0.0;
    Motor motor;
    motor.joint = j;
    motor.radius = wheel.radius;
    motor.threshold = std::max(smallest * joint.max_effort, 2.0 * coulomb);
    motors_.push_back(motor);
  }
}

void ReversedMotor::reset() noexcept {
  for (Motor& motor : motors_) motor.looks = 0;
}

/// Whether P is still the share of P_j that it was.
void ReversedMotor::follow(Motor& motor, double power, double told, double rate) const noexcept {
  const double share = power / (-2.0 * told * rate);
  const bool fits = std::abs(told) > motor.threshold && share > least && share < most;
  const bool keeps = fits && motor.looks > 0 && std::abs(share - motor.share) < steadily * motor.share;
  if (!keeps) {
    motor.share = share;
    motor.way = 0.0;
    motor.looks = 0;
  }
  if (!fits) return;
  motor.way += motor.radius * std::abs(rate) * period_;
  ++motor.looks;
}

std::optional<Event> ReversedMotor::look(double power, const Eigen::VectorXd& told,
                                         const Eigen::VectorXd& rates) noexcept {
  const double commanded = told.dot(rates);
  if (!(power > 0.0) || commanded < -braked * power || commanded > given * power) {
    reset();
    return std::nullopt;
  }
  const Motor* found = nullptr;
  int alike = 0;
  for (Motor& motor : motors_) {
    follow(motor, power, told(motor.joint), rates(motor.joint));
    alike += motor.looks > 0 ? 1 : 0;
    if (motor.looks * period_ > dwell - 0.5 * period_ && motor.way > travel) found = &motor;
  }
  if (found == nullptr || alike > 1) return std::nullopt;
  return Event{EventCode::torque_flipped, 0.0, event_signal::of_joint(found->joint, event_signal::tau),
               -2.0 * told(found->joint)};
}

}  // namespace zwang::runtime
