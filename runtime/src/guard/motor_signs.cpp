#include "guard/motor_signs.hpp"

#include <algorithm>
#include <cmath>

#include "estimate/ticks.hpp"

namespace zwang::runtime {

MotorSigns::MotorSigns(const lang::Robot& robot, double period)
    : motors_(wheel_motors(robot, smallest)),
      c_(Eigen::VectorXd::Zero(robot.model.joint_count() + 6)),
      dwell_ticks_(ticks_of(dwell, period)) {}

void MotorSigns::begin(bool is_touched) noexcept {
  is_touched_ = is_touched;
  ticks_ = 0;
  c_c_ = p_c_ = p_p_ = 0.0;
}

std::optional<Event> MotorSigns::look(const DisturbanceObserver& observer) noexcept {
  if (obey_ || motors_.empty()) return std::nullopt;
  const solver::FreeMotions& motions = observer.motions();
  const auto p = observer.force().head(motions.count);
  auto c = c_.head(motions.count);
  c.setZero();
  bool is_told = false;
  for (const WheelMotor& motor : motors_) {
    const auto T = motions.joint.row(motor.joint).head(motions.count);
    const double tau = observer.torque()(motor.joint);
    c += tau * T.transpose();
    is_told = is_told || std::abs(tau) > motor.threshold;
  }
  const double least = least_force(motors_, motions);
  if (std::max(p.squaredNorm(), c.squaredNorm()) < quiet * quiet * least * least) {
    begin(false);
    return std::nullopt;
  }
  if (is_touched_) return std::nullopt;
  c_c_ += c.squaredNorm();
  p_c_ += p.dot(c);
  p_p_ += p.squaredNorm();
  if (!is_told || ++ticks_ < dwell_ticks_) return std::nullopt;
  const double gamma = -p_c_ / c_c_;
  const double left = p_p_ - p_c_ * p_c_ / c_c_;
  obey_ = std::abs(gamma) < obeying && left < obeying * obeying * c_c_;
  const bool turn_around = gamma > least_gamma && gamma < most_gamma && left < unexplained * p_p_;
  begin(true);
  if (!turn_around) return std::nullopt;
  return Event{EventCode::motors_reversed, 0.0, event_signal::base_twist, 1.0 - gamma};
}

}  // namespace zwang::runtime
