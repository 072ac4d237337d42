/// How hard a hit is: a mass that runs into a linear spring and damper.
#pragma once

#include "zwang/export.hpp"

namespace zwang::lang {

/// A mass m arrives with the velocity v at a spring K and a damper c, while a force F pushes on.
/// Equation of motion:
///     m x'' + c x' + K x = F,   x(0) = 0, x'(0) = v
/// Contact force:
///     C = c x' + K x
struct ZWANG_EXPORT Hit {
  double mass = 0.0;       ///< m [kg]
  double speed = 0.0;      ///< v [m/s]
  double stiffness = 0.0;  ///< K [N/m] of all points that touch together
  double damping = 0.0;    ///< c [N s/m] of all of them
  double push = 0.0;       ///< F [N]

  /// The largest C [N]. Let z = c / (2 sqrt(K m)) be the damping ratio and s = sqrt(1 - z^2).
  /// Without F, C / (v sqrt(K m)) is
  ///     exp(-z/s atan2(s (1 - 4 z^2), z (3 - 4 z^2)))   for z < 1/2: 0.81 at z = 0.27, 1 at z = 1/2
  ///     2 z                                             for z >= 1/2, at t = 0: C(0) = c v
  double peak_force() const;
};

}  // namespace zwang::lang
