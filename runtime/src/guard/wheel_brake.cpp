#include "guard/wheel_brake.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zwang::runtime {

WheelBrake::WheelBrake(const lang::Robot& robot, double period)
    : ticks_between_looks_(std::max(1, static_cast<int>(std::lround(look_every / period)))) {
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const int j = wheel.body - 1;
    const solver::Joint& joint = robot.model.joint(j);
    if (joint.actuated && joint.max_effort > 0.0)
      wheels_.push_back({.joint = j, .radius = wheel.radius, .limit = joint.max_effort});
  }
  const double force = robot.stop.force / std::max<double>(1.0, static_cast<double>(wheels_.size()));
  for (DrivenWheel& wheel : wheels_) wheel.limit = std::min(wheel.limit, force * wheel.radius);
}

void WheelBrake::begin(int suspect, bool is_sure) noexcept {
  left_out_ = -1;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    if (wheels_[i].joint == suspect) left_out_ = static_cast<int>(i);
  }
  searches_ = !is_sure || left_out_ < 0;
  sense_ = 0.0;
  may_turn_ = true;
  even_looks_ = 0;
  ticks_ = 0;
  last_sum_ = std::numeric_limits<double>::infinity();
}

void WheelBrake::look(const Eigen::VectorXd& qd) noexcept {
  double sum = 0.0;
  for (const DrivenWheel& wheel : wheels_) {
    const double rim = wheel.radius * qd(wheel.joint);
    sum += rim * rim;
  }
  const auto count = static_cast<int>(wheels_.size());
  if (sum > growth * last_sum_ && sum > count * slow * slow) {
    if (sense_ != 0.0) {
      sense_ = 0.0;
      may_turn_ = false;
    } else if (searches_) {
      left_out_ = left_out_ + 1 < count ? left_out_ + 1 : -1;
      may_turn_ = true;
    }
  }
  const bool rolls_on = sum > evenly * last_sum_ && sum > count * rest * rest;
  even_looks_ = rolls_on ? even_looks_ + 1 : 0;
  if (even_looks_ >= even_looks && left_out_ >= 0 && may_turn_) sense_ = -1.0;
  last_sum_ = sum;
}

void WheelBrake::brake(const Eigen::VectorXd& qd, Eigen::VectorXd& tau) noexcept {
  if (++ticks_ >= ticks_between_looks_) {
    ticks_ = 0;
    look(qd);
  }
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const DrivenWheel& wheel = wheels_[i];
    const double damped = -wheel.limit / full_brake_speed * qd(wheel.joint);
    const double sense = static_cast<int>(i) == left_out_ ? sense_ : 1.0;
    tau(wheel.joint) = sense * std::clamp(damped, -wheel.limit, wheel.limit);
  }
}

}  // namespace zwang::runtime
