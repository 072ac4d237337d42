/// The clock that a robot's stamps go by: this computer's, or one that a topic publishes (`use_sim_time`).
#pragma once

#include <algorithm>
#include <atomic>
#include <limits>

#include "clock.hpp"

namespace zwang::connect {

/// A published clock stands between two messages, as in every node of ROS 2. One thread writes; any reads.
class RobotClock {
 public:
  /// `longest_silence` [s] of this computer's clock, after which a published clock counts as standing.
  RobotClock(bool is_told, double longest_silence) : is_told_(is_told), longest_silence_(longest_silence) {}

  void tell(double time, double arrival) noexcept {
    if (arrival_ > 0.0 && time > time_) step_ = std::min(step_.load(), time - time_);
    time_ = time;
    arrival_ = arrival;
  }

  bool is_told() const noexcept { return is_told_; }
  /// It goes on: two times have been told.
  bool has_come() const noexcept { return !is_told_ || step() < std::numeric_limits<double>::infinity(); }
  /// [s] The shortest from one time to the next that was told: a lost message makes a longer one.
  double step() const noexcept { return step_; }
  /// [s]
  double time() const noexcept { return is_told_ ? time_.load() : now(); }
  /// [s] The time at which a message came, `arrival` [s] of `now`.
  double time_at(double arrival) const noexcept { return is_told_ ? time_.load() : arrival; }
  /// No time has come for too long: the simulation is paused, or it has ended. `at` [s] of `now`.
  bool stands(double at) const noexcept { return is_told_ && at - arrival_ > longest_silence_; }
  /// [s] For how long no sample has come at `at` [s] of `now`: the last one came at `arrival`, stamped
  /// `stamp`. A simulation may be slower than real time, so its own clock counts, as long as it runs.
  double silence(double at, double arrival, double stamp) const noexcept {
    if (!is_told_ || stands(at)) return at - arrival;
    return time_ > stamp ? time_ - stamp : 0.0;
  }

 private:
  const bool is_told_;
  const double longest_silence_;
  std::atomic<double> time_{0.0}, arrival_{0.0}, step_{std::numeric_limits<double>::infinity()};
};

}  // namespace zwang::connect
