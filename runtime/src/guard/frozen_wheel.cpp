#include "guard/frozen_wheel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "guard/wheel_motors.hpp"

namespace zwang::runtime {

FrozenWheel::FrozenWheel(const lang::Robot& robot) {
  for (const WheelMotor& motor : wheel_motors(robot, smallest))
    wheels_.push_back({.joint = motor.joint, .threshold = motor.threshold});
}

/// The clock starts anew.
void FrozenWheel::begin(const solver::State& state, double time) noexcept {
  asked_ = -1;
  began_ = last_time_ = time;
  has_last_ = true;
  for (Wheel& wheel : wheels_) {
    const double q = state.q(wheel.joint);
    wheel = {.joint = wheel.joint, .threshold = wheel.threshold, .q = q, .began = q};
  }
}

std::optional<Event> FrozenWheel::look(const solver::State& state, const Eigen::VectorXd& sent,
                                       double time) noexcept {
  const double dt = time - last_time_;
  if (!has_last_ || dt <= 0.0 || dt > window) begin(state, time);
  last_time_ = time;
  const bool is_dumb = asked_ >= 0 && is_left_unanswered(state, dt);
  for (Wheel& wheel : wheels_) {
    const double step = std::abs(state.q(wheel.joint) - wheel.q);
    if (step > 0.0) {
      wheel.is_still = false;
      wheel.step = wheel.step > 0.0 ? std::min(wheel.step, step) : step;
    }
    wheel.q = state.q(wheel.joint);
    wheel.impulse += sent(wheel.joint) * dt;
  }
  if (is_dumb) return event_of(wheels_[static_cast<std::size_t>(std::exchange(asked_, -1))]);
  if (time - began_ < window) return std::nullopt;
  began_ = time;
  int rolling = 0;
  double longest = 0.0;
  for (const Wheel& wheel : wheels_) {
    const double way = std::abs(wheel.q - wheel.began);
    longest = std::max(longest, way);
    rolling += way > rolls_on * std::max(rolled, wheel.way_rolled()) ? 1 : 0;
  }
  const bool others_roll = 2 * rolling >= static_cast<int>(wheels_.size()) - 1;
  const Wheel* frozen = nullptr;
  for (Wheel& wheel : wheels_) {
    end_window(wheel, others_roll ? longest : 0.0);
    const bool has_died = wheel.still_windows >= windows && others_roll;
    if (has_died) frozen = &wheel;
    if (wheel.way_of_another > wheel.patience && asked_ < 0) begin_to_ask(wheel);
  }
  if (frozen == nullptr) return std::nullopt;
  return event_of(*frozen);
}

Event FrozenWheel::event_of(const Wheel& frozen) const noexcept {
  const int signal = event_signal::of_joint(frozen.joint, event_signal::q);
  return {EventCode::frozen, last_time_, signal, frozen.way_rolled() / window};
}

void FrozenWheel::begin_to_ask(const Wheel& wheel) noexcept {
  asked_ = static_cast<int>(&wheel - wheels_.data());
  asked_torque_ = -std::copysign(std::max(std::abs(wheel.told), asked_with * wheel.threshold), wheel.told);
  asked_for_ = 0.0;
  answers_ = 0;
}

/// Ends the question where the wheel has moved often enough.
bool FrozenWheel::is_left_unanswered(const solver::State& state, double dt) noexcept {
  Wheel& wheel = wheels_[static_cast<std::size_t>(asked_)];
  asked_for_ += dt;
  answers_ += state.q(wheel.joint) != wheel.q ? 1 : 0;
  if (answers_ < signs_of_life) return asked_for_ > answers_within;
  wheel.way_of_another = 0.0;
  wheel.patience = std::min(farthest, 2.0 * wheel.patience);
  asked_ = -1;
  return false;
}

void FrozenWheel::ask(Eigen::VectorXd& tau) const noexcept {
  if (asked_ >= 0) tau(wheels_[static_cast<std::size_t>(asked_)].joint) = asked_torque_;
}

/// `longest` [rad] is the way of the wheel that rolled farthest, where the others roll.
void FrozenWheel::end_window(Wheel& wheel, double longest) noexcept {
  const double way = std::abs(wheel.q - wheel.began);
  const bool did_roll = wheel.way_rolled() > std::max(rolled, steps * wheel.step);
  wheel.still_windows = wheel.is_still && did_roll ? wheel.still_windows + 1 : 0;
  if (wheel.still_windows == 0) {
    wheel.way_first = wheel.way_before;
    wheel.way_before = wheel.way;
    wheel.way = way;
  }
  const bool is_passed = wheel.is_still && longest > rolled;
  const bool is_told = std::abs(wheel.impulse) > wheel.threshold * window;
  if (!wheel.is_still) wheel.way_of_another = 0.0;
  if (way > rolled) wheel.patience = good_way;
  wheel.told = wheel.impulse / window;
  if (is_passed && is_told) wheel.way_of_another += longest;
  wheel.began = wheel.q;
  wheel.is_still = true;
  wheel.impulse = 0.0;
}

}  // namespace zwang::runtime
