/// How hard a hit is: a mass that runs into a linear spring and damper.
#pragma once

#include "zwang/export.hpp"

namespace zwang::lang {

/// A mass m that arrives at v where a spring K and a damper c stop it, while F pushes on:
///     m x'' + c x' + K x = F,   x(0) = 0, x'(0) = v;   the contact presses with C = c x' + K x.
struct ZWANG_EXPORT Hit {
  double mass = 0.0;       ///< m [kg]
  double speed = 0.0;      ///< v [m/s]
  double stiffness = 0.0;  ///< K [N/m] of all points that touch together
  double damping = 0.0;    ///< c [N s/m] of all of them
  double push = 0.0;       ///< F [N]

  /// The largest C [N]. Without F, as a share of v sqrt(K m) at the damping ratio z = c / (2 sqrt(K m)):
  ///     exp(-z/s atan2(s (1 - 4 z^2), z (3 - 4 z^2))),  s = sqrt(1 - z^2),   for z < 1/2,
  /// 0.81 at 0.27 and 1 at 1/2; from there on 2 z, the damper's C(0) = c v.
  double peak_force() const;
};

}  // namespace zwang::lang
