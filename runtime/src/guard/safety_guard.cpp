#include "zwang/runtime/safety_guard.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace zwang::runtime {

namespace {

// No position, speed, wrench or time of a robot is larger; a number that is, is a broken one. 1e9 s are 32
// years.
constexpr double largest_plausible = 1e9;
// The protective stop's torques reach their limit at this joint speed and shrink with it below, so that the
// wheels come to rest without chattering around it.
constexpr double full_brake_speed = 0.5;  // [rad/s] or [m/s]
// A robot that says to be faster than this changes its position within a few ticks, however coarse its
// encoders are.
constexpr double moving_joint = 0.1;  // [rad/s] or [m/s]
constexpr double moving_base = 0.01;  // [m/s]
constexpr int believed_frozen_ticks = 2;
// Rounding in a clock that adds up periods must not count as a lost tick.
constexpr double clock_rounding = 0.5;  // of a period

bool plausible(double x) {
  // Written so that NaN fails.
  return std::abs(x) <= largest_plausible;
}

template <typename Values>
bool all_plausible(const Values& values) {
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (!plausible(values.coeff(i))) return false;
  }
  return true;
}

bool all_plausible(const solver::Matrix3& m) {
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      if (!plausible(m(i, j))) return false;
    }
  }
  return true;
}

bool all_plausible(const solver::State& state) {
  if (!all_plausible(state.q) || !all_plausible(state.qd) || !all_plausible(state.tau_ff)) return false;
  if (!all_plausible(state.base_pose.rotation) || !all_plausible(state.base_pose.position)) return false;
  if (!all_plausible(state.base_twist.angular) || !all_plausible(state.base_twist.linear)) return false;
  for (const solver::ForceVector& f : state.f_ext) {
    if (!all_plausible(f.angular) || !all_plausible(f.linear)) return false;
  }
  return true;
}

}  // namespace

const char* to_string(SampleStatus status) noexcept {
  switch (status) {
    case SampleStatus::good:
      return "good";
    case SampleStatus::not_finite:
      return "not finite";
    case SampleStatus::bad_clock:
      return "bad clock";
  }
  return "?";
}

const char* to_string(StopReason reason) noexcept {
  switch (reason) {
    case StopReason::none:
      return "none";
    case StopReason::bad_sample:
      return "a sensed number is not finite";
    case StopReason::lost_ticks:
      return "too long without a good sample";
    case StopReason::frozen:
      return "the robot says that it moves, and its position does not change";
    case StopReason::bad_torque:
      return "a commanded torque is not finite";
    case StopReason::solver:
      return "the solver gave no solution";
    case StopReason::plant:
      return "the robot does not answer";
    case StopReason::requested:
      return "requested";
  }
  return "?";
}

const char* to_string(GuardStatus status) noexcept {
  switch (status) {
    case GuardStatus::passed:
      return "passed";
    case GuardStatus::limited:
      return "limited";
    case GuardStatus::slewed:
      return "slewed";
    case GuardStatus::held:
      return "held";
    case GuardStatus::stopped:
      return "stopped";
  }
  return "?";
}

SafetyGuard::SafetyGuard(const lang::Robot& robot, const GuardSettings& settings)
    : settings_(settings),
      limit_(Eigen::VectorXd::Zero(robot.model.joint_count())),
      stop_limit_(limit_),
      last_(limit_),
      next_(limit_),
      last_q_(limit_) {
  if (!(settings.period > 0.0) || !(settings.max_step >= settings.period) || settings.max_lost_ticks < 1 ||
      !(settings.max_slew > 0.0)) {
    throw std::invalid_argument("safety guard: a setting is not positive, or max_step is below the period");
  }
  const solver::Model& model = robot.model;
  for (int j = 0; j < model.joint_count(); ++j) {
    if (model.joint(j).actuated) limit_(j) = model.joint(j).max_effort;
  }
  int driven = 0;
  for (const solver::Wheel& wheel : model.wheels()) driven += limit_(wheel.body - 1) > 0.0 ? 1 : 0;
  // All wheels together may press the ground with the stop's force.
  for (const solver::Wheel& wheel : model.wheels()) {
    const int joint = wheel.body - 1;
    stop_limit_(joint) = std::min(limit_(joint), robot.stop.force * wheel.radius / std::max(driven, 1));
  }
}

SampleStatus SafetyGuard::admit(const Sensed& sensed) noexcept {
  ++counters_.samples;
  const bool sized = sensed.state.q.size() == limit_.size() && sensed.state.qd.size() == limit_.size();
  if (!plausible(sensed.time) || !sized || !all_plausible(sensed.state)) {
    ++counters_.refused_values;
    stop(StopReason::bad_sample);
    return SampleStatus::not_finite;
  }
  if (!has_time_) {
    has_time_ = true;
    last_time_ = sensed.time;
    lost_ticks_ = 0;
    return SampleStatus::good;
  }
  const double step = sensed.time - last_time_;
  if (step > (settings_.max_lost_ticks + clock_rounding) * settings_.period) stop(StopReason::lost_ticks);
  if (step <= 0.0 || step > settings_.max_step) {
    ++counters_.refused_clock;
    if (++lost_ticks_ >= settings_.max_lost_ticks) stop(StopReason::lost_ticks);
    // After a jump ahead the clock goes on from there; a clock that went back has to catch up first.
    if (step > settings_.max_step) last_time_ = sensed.time;
    return SampleStatus::bad_clock;
  }
  last_time_ = sensed.time;
  lost_ticks_ = 0;
  watch_for_a_frozen_state(sensed.state);
  return SampleStatus::good;
}

void SafetyGuard::watch_for_a_frozen_state(const solver::State& state) noexcept {
  const bool moves = state.qd.lpNorm<Eigen::Infinity>() > moving_joint ||
                     state.base_twist.linear.lpNorm<Eigen::Infinity>() > moving_base;
  const bool stands = state.q == last_q_ && state.base_pose.position == last_position_;
  frozen_ticks_ = moves && stands ? frozen_ticks_ + 1 : 0;
  if (frozen_ticks_ > 0) ++counters_.frozen;
  if (frozen_ticks_ >= settings_.max_lost_ticks) stop(StopReason::frozen);
  last_q_ = state.q;
  last_position_ = state.base_pose.position;
}

void SafetyGuard::brake(const Sensed& sensed) noexcept {
  for (Eigen::Index j = 0; j < next_.size(); ++j) {
    const double damping = stop_limit_(j) / full_brake_speed;
    next_(j) = std::clamp(-damping * sensed.state.qd(j), -stop_limit_(j), stop_limit_(j));
  }
}

GuardStatus SafetyGuard::output(const Sensed& sensed, const Eigen::VectorXd& wanted,
                                Eigen::VectorXd& tau) noexcept {
  if (!stopped()) {
    // Finite comes before the clamp: clamping a NaN gives a bound, and so full torque.
    if (wanted.size() != limit_.size() || !wanted.allFinite()) {
      ++counters_.bad_torques;
      stop(StopReason::bad_torque);
    }
  }
  if (stopped()) {
    // A brake that believes a speed of the past drives the robot backwards.
    if (frozen_ticks_ > believed_frozen_ticks) {
      next_.setZero();
    } else {
      brake(sensed);
    }
    return send(tau, GuardStatus::stopped);
  }
  GuardStatus status = GuardStatus::passed;
  for (Eigen::Index j = 0; j < next_.size(); ++j) {
    next_(j) = std::clamp(wanted(j), -limit_(j), limit_(j));
    if (next_(j) != wanted(j)) status = GuardStatus::limited;
  }
  if (status == GuardStatus::limited) ++counters_.limited;
  return send(tau, status);
}

GuardStatus SafetyGuard::output_blind(Eigen::VectorXd& tau) noexcept {
  if (stopped()) {
    next_.setZero();
    return send(tau, GuardStatus::stopped);
  }
  next_ = last_;
  return send(tau, GuardStatus::held);
}

GuardStatus SafetyGuard::send(Eigen::VectorXd& tau, GuardStatus status) noexcept {
  const double step = settings_.max_slew * settings_.period;
  bool slewed = false;
  for (Eigen::Index j = 0; j < next_.size(); ++j) {
    const double cut = std::clamp(next_(j), last_(j) - step, last_(j) + step);
    slewed = slewed || cut != next_(j);
    next_(j) = cut;
  }
  if (slewed) {
    ++counters_.slewed;
    if (status == GuardStatus::passed) status = GuardStatus::slewed;
  }
  last_ = next_;
  if (tau.size() == next_.size()) tau = next_;
  return status;
}

void SafetyGuard::stop(StopReason reason) noexcept {
  if (!stopped()) reason_ = reason;
}

void SafetyGuard::reset() noexcept {
  reason_ = StopReason::none;
  has_time_ = false;
  lost_ticks_ = 0;
  frozen_ticks_ = 0;
}

}  // namespace zwang::runtime
