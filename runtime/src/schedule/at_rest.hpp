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

}  // namespace zwang::runtime
