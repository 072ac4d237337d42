#include "guard/reversed_motor.hpp"

#include <cmath>

#include "guard/wheel_motors.hpp"

namespace zwang::runtime {

ReversedMotor::ReversedMotor(const lang::Robot& robot, double period) : period_(period) {
  for (const WheelMotor& of : wheel_motors(robot, smallest)) {
    motors_.push_back(Motor{.joint = of.joint, .radius = of.radius, .threshold = of.threshold});
  }
}

void ReversedMotor::reset() noexcept {
  for (Motor& motor : motors_) motor.looks = 0;
}

/// Whether P is still the share of P_j that it was.
void ReversedMotor::follow(Motor& motor, double power, double told, double rate,
                           const ContactDepth& contact) const noexcept {
  const double share = power / (-2.0 * told * rate);
  const bool fits = std::abs(told) > motor.threshold && share > least && share < most;
  const bool keeps = fits && motor.looks > 0 && std::abs(share - motor.share) < steadily * motor.share;
  if (!keeps) {
    motor.share = share;
    motor.way = 0.0;
    motor.looks = 0;
    motor.contact = contact.now();
  }
  if (!fits) return;
  motor.way += motor.radius * std::abs(rate) * period_;
  ++motor.looks;
}

std::optional<Event> ReversedMotor::look(double power, const Eigen::VectorXd& told,
                                         const Eigen::VectorXd& rates, const ContactDepth& contact) noexcept {
  const double commanded = told.dot(rates);
  if (!(power > 0.0) || commanded < -braked * power || commanded > given * power) {
    reset();
    return std::nullopt;
  }
  const Motor* found = nullptr;
  int alike = 0;
  for (Motor& motor : motors_) {
    follow(motor, power, told(motor.joint), rates(motor.joint), contact);
    alike += motor.looks > 0 ? 1 : 0;
    const bool lasts = motor.looks * period_ > dwell - 0.5 * period_ && motor.way > travel;
    if (lasts && contact.is_no_spring(motor.contact)) found = &motor;
  }
  if (found == nullptr || alike > 1) return std::nullopt;
  return Event{EventCode::torque_flipped, 0.0, event_signal::of_joint(found->joint, event_signal::tau),
               -2.0 * told(found->joint)};
}

}  // namespace zwang::runtime
