/// Whether a motor was seen to follow its command.
#pragma once

#include <cmath>

namespace zwang::runtime {

/// A motor that failed without a command has not given its torque once since its command started. If a motor
/// gave its whole torque for the duration of the observer's mean, it did not fail then. A later force of the
/// command's size without an onset of its own has another source. It is a contact's, or the error of a model
/// that is too light or too heavy. That error is proportional to the accelerations, whichever motors cause
/// them, and does not start with a fault.
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
