/// Dry friction along one axis: an elastic bristle that yields, as in floor_friction.hpp. With the stretch s,
/// ds/dt = v,
///     f = k s + c v,  |f| <= F, and |s| <= s_F by cutting s, where k s_F = F.
#pragma once

#include <algorithm>

namespace zwang::runtime {

inline constexpr double floor_frequency = 200.0;    ///< w [1/s] of bristles below and beside objects
inline constexpr double floor_damping_ratio = 0.7;  ///< while they hold

struct Bristle {
  double stiffness = 0.0;  ///< k [N/m] or [N m/rad]
  double damping = 0.0;    ///< c [N s/m] or [N m s/rad]
  double most = 0.0;       ///< F [N] or [N m]
  double longest = 0.0;    ///< s_F [m] or [rad]
  double stretch = 0.0;    ///< s

  /// f against the velocity `v`; moves the bristle by one step of `period` [s].
  double step(double v, double period) noexcept {
    stretch = std::clamp(stretch + period * v, -longest, longest);
    return std::clamp(stiffness * stretch + damping * v, -most, most);
  }
};

/// As the floor's, k = m w^2, of what has the `inertia` m [kg] or [kg m^2] along the axis.
inline Bristle floor_bristle(double inertia, double most) {
  const double stiffness = floor_frequency * floor_frequency * inertia;
  return {stiffness, 2.0 * floor_damping_ratio * floor_frequency * inertia, most, most / stiffness};
}

}  // namespace zwang::runtime
