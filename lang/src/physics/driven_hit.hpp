/// How hard a robot hits while its driver pushes on, where the object may give way.
#pragma once

#include "zwang/lang/hit.hpp"

namespace zwang::lang {

/// The driver's force F after it touched, u more slowly and x farther than then:
///     F = f + g u - k x,   |F| <= most.
struct DriverPush {
  double most = 0.0;        ///< [N]
  double at_arrival = 0.0;  ///< f [N]
  double per_speed = 0.0;   ///< g [N s/m]
  double per_way = 0.0;     ///< k [N/m]

  /// The same force however the robot moves.
  static DriverPush constant(double force) { return {force, force, 0.0, 0.0}; }
  bool is_constant() const { return per_speed == 0.0 && per_way == 0.0; }
  double at(double slower, double way) const;
};

/// A robot of the mass m meets an object of the mass M at the speed v. A spring K and a damper c join them.
/// Dry friction and a preload hold the object with H. It moves while more than H presses on it:
///     m x'' = F - C,   M y'' = C - H,   C = K (x - y) + c (x' - y').
struct DrivenHit {
  double mass = 0.0;          ///< m [kg]
  double speed = 0.0;         ///< v [m/s] at which the two close
  double stiffness = 0.0;     ///< K [N/m] of all points that touch together
  double damping = 0.0;       ///< c [N s/m] of all of them
  double inverse_mass = 0.0;  ///< 1/M [1/kg]; 0: nothing moves the object
  double hold = 0.0;          ///< H [N]
  DriverPush push;

  /// m M / (m + M) [kg]
  double reduced_mass() const { return 1.0 / (1.0 / mass + inverse_mass); }
  /// The largest C [N]: in closed form for a constant push without H, else step by step.
  double peak() const;
};

}  // namespace zwang::lang
