/// Whether a motor was seen to do what it is told.
#pragma once

#include <cmath>

namespace zwang::runtime {

/// A motor that failed while it was told nothing has not given its torque once since it is told something.
/// One that has, with nothing missing of it for as long as the observer's mean is, did not fail then: what
/// has the size of its command later, without a begin of its own, is contact's, or the error of a model that
/// is too light or too heavy: that is proportional to the accelerations, of whichever motors they come, and
/// does not begin with a fault.
class Obedience {
 public:
  explicit Obedience(int dwell) noexcept : dwell_(dwell) {}

  void reset() noexcept { ticks_ = 0; }
  /// `tau` is the command, `f` what the motor differs by if it is the one. [N m], or [N]
  void follow(double f, double tau, double threshold) noexcept {
    if (std::abs(tau) < threshold) {
      ticks_ = 0;
    } else if (ticks_ < dwell_) {
      ticks_ = f * tau > -most_missed * tau * tau ? ticks_ + 1 : 0;
    }
  }
  bool is_seen() const noexcept { return ticks_ >= dwell_; }

  static constexpr double most_missed = 0.4;  ///< of the command

 private:
  int dwell_;
  int ticks_ = 0;
};

}  // namespace zwang::runtime
