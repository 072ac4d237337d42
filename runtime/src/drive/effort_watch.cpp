#include "drive/effort_watch.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

namespace {

constexpr double most_cycles = 4.0;  // between two samples that are compared

/// Of a first-order low pass of the time constant T, after `since` [s].
double left_of(double since, double T) noexcept {
  return T > 0.0 ? std::exp(-since / T) : 0.0;
}

}  // namespace

EffortWatch::EffortWatch(const lang::Robot& robot, double period)
    : filter_(robot.drive.feels.filter),
      late_(0.5 * robot.drive.delay),
      cycle_(1.0 / robot.drive.rate),
      doubt_(0.5 * cycle_ + period) {
  const lang::Feels& feels = robot.drive.feels;
  const double a = left_of(cycle_, smoothing);
  const double noise = std::hypot(feels.noise, feels.resolution / std::sqrt(12.0));
  const double loud = sigmas * noise * std::sqrt((1.0 - a) / (1.0 + a));
  for (LoopGain gain : loop_gains(robot)) {
    // The model is the virtual robot's, the motors are the real one's.
    gain.limit /= robot.drive.mass_factor;
    gain.proportional /= robot.drive.mass_factor;
    gain.integral /= robot.drive.mass_factor;
    wheels_.push_back({.gain = gain, .threshold = std::max(loud, smallest * gain.limit)});
  }
  // A sample is delay/2 and a cycle old at most. It asks for the commands of `most_cycles` before.
  const double longest = 2.0 * late_ + (2.0 + most_cycles) * cycle_;
  const auto ticks = static_cast<std::size_t>(std::ceil(longest / period)) + 2;
  times_.resize(ticks, 0.0);
  rates_ = ways_ =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(wheels_.size()), static_cast<Eigen::Index>(ticks));
}

/// A tick that sends nothing goes on with the last command, as the drive does.
void EffortWatch::tell(const Eigen::VectorXd& velocity, double time) noexcept {
  const Eigen::Index next = (newest_ + 1) % ways_.cols();
  const bool is_first = told_count_ == 0;
  const double since = is_first ? 0.0 : std::max(0.0, time - times_[static_cast<std::size_t>(newest_)]);
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    ways_(row, next) = is_first ? 0.0 : ways_(row, newest_) + since * rates_(row, newest_);
    rates_(row, next) = velocity(wheels_[i].gain.joint);
  }
  times_[static_cast<std::size_t>(next)] = time;
  newest_ = next;
  told_count_ = std::min(told_count_ + 1, ways_.cols());
}

/// Before the first command the drive did what that command says: the virtual robot begins as the base moves.
EffortWatch::Place EffortWatch::place(double time) const noexcept {
  constexpr double rounding = 1e-9;  // [s]
  const Eigen::Index n = ways_.cols();
  Place then;
  for (Eigen::Index k = 0; k < told_count_; ++k) {
    then.command = (newest_ - k + n) % n;
    then.since = time - times_[static_cast<std::size_t>(then.command)];
    if (then.since >= -rounding) return then;
  }
  return told_count_ < n ? then : Place{};
}

void EffortWatch::add(Sum& sum, double change, const Left& left) noexcept {
  sum.value = left.sum * sum.value + change;
  sum.filtered += (1.0 - left.filtered) * (sum.value - sum.filtered);
  sum.smooth += (1.0 - left.smooth) * (sum.filtered - sum.smooth);
}

void EffortWatch::follow(Wheel& wheel, const Sample& now, double way, double since) const noexcept {
  const Sample& last = wheel.last;
  const double k_p = wheel.gain.proportional, k_i = wheel.gain.integral;
  const double limit = at_limit * wheel.gain.limit;
  const Left left{left_of(since, memory), left_of(since, filter_), left_of(since, smoothing)};
  add(wheel.told, k_p * (now.error - last.error) + k_i * (way - (now.q - last.q)), left);
  add(wheel.felt, now.effort - last.effort, {left.sum, 0.0, left.smooth});
  add(wheel.told_earlier, k_p * (now.acceleration - last.acceleration) + k_i * (now.velocity - last.velocity),
      left);
  if (std::max(std::abs(now.effort), std::abs(last.effort)) > limit)
    wheel.told = wheel.felt = wheel.told_earlier = {};
  const double sign = wheel.told.smooth < 0.0 ? -1.0 : 1.0;
  const double least = std::abs(wheel.told.smooth) - doubt_ * std::abs(wheel.told_earlier.smooth);
  const bool is_lost = least > wheel.threshold && sign * wheel.felt.smooth < share * least;
  wheel.lost_for = is_lost ? wheel.lost_for + since : 0.0;
  wheel.effort += (1.0 - left.smooth) * (now.effort - wheel.effort);
  const bool is_high = std::abs(wheel.effort) > limit;
  wheel.at_limit_for = std::clamp(wheel.at_limit_for + (is_high ? since : -since), 0.0, lasts);
}

std::optional<Event> EffortWatch::look(const Sensed& sensed, double stamp) noexcept {
  const double since = stamp - looked_at_;
  looked_at_ = stamp;
  const double acted = stamp - late_;  // the newest command that the wheels can have had
  const double mean = acted - 0.5 * cycle_;
  const Place newest = place(acted), oldest = place(acted - cycle_);
  const Place now = place(mean), before = place(mean - since);
  if (oldest.command < 0 || before.command < 0) {
    is_known_ = false;
    return std::nullopt;
  }
  const bool is_next = is_known_ && since > 0.0 && since < most_cycles * cycle_;
  std::optional<Event> found;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    Wheel& wheel = wheels_[i];
    const int j = wheel.gain.joint;
    Sample sample{.q = sensed.state.q(j), .effort = sensed.effort(j)};
    sample.error = (way(i, newest) - way(i, oldest)) / cycle_ - sensed.state.qd(j);
    const double told_way = way(i, now) - way(i, before);
    if (is_next) {
      sample.velocity = told_way / since;
      sample.acceleration = (sample.velocity - wheel.last.velocity) / since;
      follow(wheel, sample, told_way, since);
    } else {
      sample.velocity = rates_(static_cast<Eigen::Index>(i), now.command);
      wheel = {.gain = wheel.gain, .threshold = wheel.threshold, .is_limit_told = wheel.is_limit_told};
    }
    wheel.last = sample;
    if (!found && wheel.lost_for > lasts)
      found =
          Event{EventCode::effort_lost, stamp, event_signal::of_joint(j, event_signal::tau), sample.effort};
  }
  is_known_ = true;
  return found;
}

std::optional<Event> EffortWatch::look_at_limits(double stamp) noexcept {
  std::optional<Event> found;
  for (Wheel& wheel : wheels_) {
    if (wheel.at_limit_for <= 0.0) wheel.is_limit_told = false;
    if (found || wheel.is_limit_told || wheel.at_limit_for < lasts) continue;
    wheel.is_limit_told = true;
    const int signal = event_signal::of_joint(wheel.gain.joint, event_signal::tau);
    found = Event{EventCode::drive_at_limit, stamp, signal, wheel.effort};
  }
  return found;
}

}  // namespace zwang::runtime
