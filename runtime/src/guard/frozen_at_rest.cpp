#include "guard/frozen_at_rest.hpp"

#include <cmath>

#include "guard/wheel_motors.hpp"

namespace zwang::runtime {

FrozenAtRest::FrozenAtRest(const lang::Robot& robot) : q_(Eigen::VectorXd::Zero(robot.model.joint_count())) {
  for (const WheelMotor& motor : wheel_motors(robot, quiet))
    wheels_.push_back({.joint = motor.joint, .quiet = motor.threshold});
}

void FrozenAtRest::begin(bool is_quiet) noexcept {
  was_quiet_ = is_quiet;
  for (Wheel& wheel : wheels_) wheel.rate = wheel.way = 0.0;
}

std::optional<Event> FrozenAtRest::look(const Eigen::VectorXd& q, const Eigen::VectorXd& sent,
                                        const Eigen::VectorXd& expected, double time) noexcept {
  const double dt = time - time_;
  const bool begins = !has_last_ || dt <= 0.0 || dt > longest;  // before that nothing was sent
  const bool moved = !begins && q != q_;
  time_ = time;
  has_last_ = true;
  q_ = q;
  bool is_quiet = true;
  for (const Wheel& wheel : wheels_) is_quiet = is_quiet && std::abs(sent(wheel.joint)) <= wheel.quiet;
  if (moved || begins || is_quiet) begin(!moved);
  if (moved || begins || is_quiet || !was_quiet_) return std::nullopt;
  for (Wheel& wheel : wheels_) {
    wheel.rate += expected(wheel.joint) * dt;
    wheel.way += wheel.rate * dt;
    if (std::abs(wheel.way) < enough) continue;
    const Event found{EventCode::frozen, time, event_signal::of_joint(wheel.joint, event_signal::q),
                      wheel.way};
    begin(false);
    return found;
  }
  return std::nullopt;
}

}  // namespace zwang::runtime
