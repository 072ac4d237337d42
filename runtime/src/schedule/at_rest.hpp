/// When a base counts as standing, and how long it may take to get there.
#pragma once

#include "zwang/solver/spatial.hpp"

namespace zwang::runtime {

inline constexpr double at_rest_speed = 0.01;               ///< [m/s]
inline constexpr double at_rest_turn = 0.0174532925199433;  ///< [rad/s], 1 deg/s
inline constexpr double longest_stop = 10.0;                ///< [s]
/// A base that bounces stands for a moment where its contact is pressed in farthest: twice the brake's time
/// constant is longer than that. [s]
inline constexpr double rest_dwell = 0.1;

inline bool is_at_rest(const solver::MotionVector& twist) {
  return twist.linear.norm() < at_rest_speed && twist.angular.norm() < at_rest_turn;
}

/// How long a base has stood. Where its twist is measured with noise, single samples say that it moves: then
/// their mean over some 20 ms counts, which a bounce of 5 Hz keeps 85 % of.
class RestWatch {
 public:
  static constexpr double mean_over = 0.02;  ///< [s]

  void begin() noexcept {
    stood_for_ = 0.0;
    has_mean_ = false;
  }
  /// A sample, a period after the last one.
  void look(const solver::MotionVector& twist, double period) noexcept {
    const double share = has_mean_ ? period / (period + mean_over) : 1.0;
    mean_.linear += share * (twist.linear - mean_.linear);
    mean_.angular += share * (twist.angular - mean_.angular);
    has_mean_ = true;
    stood_for_ = is_at_rest(twist) || is_at_rest(mean_) ? stood_for_ + period : 0.0;
  }
  /// A period without a sample that shows the twist.
  void doubt() noexcept { stood_for_ = 0.0; }
  double stood_for() const noexcept { return stood_for_; }  ///< [s]

 private:
  solver::MotionVector mean_;
  bool has_mean_ = false;
  double stood_for_ = 0.0;
};

}  // namespace zwang::runtime
