/// How exactly a wheel has to be drawn: the robot's reader goes by these bounds, and the messages name them.
#pragma once

#include <numbers>

namespace zwang::lang {

/// How far from an exact place a wheel may be drawn. 5 mm are a tenth of the smallest wheelbase that drives.
/// 2 deg are the looseness of a hand-built axle. A wheel that is farther off is meant to be there.
inline constexpr double most_wheel_offset = 5e-3;                          // [m]
inline constexpr double most_axis_angle = 2.0 * std::numbers::pi / 180.0;  // [rad]
/// A wheel under a steering with an end to its travel may stand this part of its radius ahead or behind.
inline constexpr double tyre_print = 10.0;
/// By which a steered wheel may point aside and hold nothing. Servos keep their angles to a few tenths of a
/// degree. Drawn angles such as 1.57 are 0.05 deg off.
inline constexpr double steering_error = 0.5 * std::numbers::pi / 180.0;  // [rad]
/// From here on it is told: a tenth of what changes a robot's motion by less than encoders see.
inline constexpr double told_wheel_offset = 0.1e-3;                         // [m]
inline constexpr double told_axis_angle = 0.05 * std::numbers::pi / 180.0;  // [rad]

}  // namespace zwang::lang
