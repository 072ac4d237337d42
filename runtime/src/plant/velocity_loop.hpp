/// The drive of a simulated robot that takes velocities.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "drive/loop_gain.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/command.hpp"

namespace zwang::runtime {

/// A line that takes a value every `cycle` and hands it out `delay` later. [s] Does not allocate after
/// construction where a copy of `Value` does not.
template <typename Value>
class SampledLine {
 public:
  /// `first` is there before anything has arrived.
  SampledLine(double cycle, double delay, const Value& first)
      : cycle_(cycle),
        delay_(delay),
        ring_(static_cast<std::size_t>(std::ceil(delay / cycle)) + 2, {first}) {}

  /// The value that has arrived at `time`; `now` is the value at the other end.
  const Value& pass(const Value& now, double time) noexcept {
    if (time >= next_ - rounding) {
      newest_ = (newest_ + 1) % ring_.size();
      ring_[newest_].value = now;
      ring_[newest_].at = time;
      next_ = std::max(next_ + cycle_, time);
      if (waiting_ + 1 < ring_.size()) ++waiting_;
    }
    const auto next_is_there = [&] {
      return waiting_ > 0 && ring_[(oldest_ + 1) % ring_.size()].at <= time - delay_ + rounding;
    };
    while (next_is_there()) {
      oldest_ = (oldest_ + 1) % ring_.size();
      --waiting_;
    }
    return ring_[oldest_].value;
  }

 private:
  static constexpr double rounding = 1e-9;  // [s]
  struct Entry {
    Value value;
    double at = 0.0;  ///< [s] when it was taken
  };
  double cycle_, delay_;
  std::vector<Entry> ring_;
  std::size_t newest_ = 0, oldest_ = 0, waiting_ = 0;  ///< behind `oldest_`, which has arrived
  double next_ = 0.0;                                  ///< [s] when a value is taken
};

/// The loops of `loop_gains`, in each step of the simulation, inside the command's bounds and the motor's
/// limit. The integral is frozen while the torque is at a bound and the error would push it farther.
///
/// A drive with torque limits of its own takes the motors' limits, whatever the command says. A drive that
/// takes the base's twist turns it into V as drivers do, by the places of the wheels.
class VelocityLoop {
 public:
  explicit VelocityLoop(const lang::Robot& robot);

  /// The motors' torques; `qd` as it is now. Does not allocate, lock, throw or print.
  const Eigen::VectorXd& step(const Command& command, const Eigen::VectorXd& qd, double period) noexcept;

 private:
  struct Wheel {
    LoopGain gain;
    double sum = 0.0;  ///< [N m] of the integral
  };
  double wanted_velocity(const Wheel& wheel, const Command& command) const noexcept {
    return takes_twist_ ? wheel.gain.per_twist.dot(command.twist) : command.velocity(wheel.gain.joint);
  }

  bool takes_twist_;
  bool limit_is_fixed_;
  std::vector<Wheel> wheels_;
  Eigen::VectorXd torque_;
};

}  // namespace zwang::runtime
