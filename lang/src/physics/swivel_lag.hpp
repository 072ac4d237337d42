/// How far a base on driven casters leaves a fillet while its push is bounded.
#pragma once

#include "zwang/solver/model.hpp"

namespace zwang::lang {

/// A base that goes along a path, and the least and the most that it weighs across its way.
struct Rounding {
  double speed = 0.0;                        ///< v [m/s]
  double radius = 0.0;                       ///< r [m] of the fillet
  double least_mass = 0.0, most_mass = 0.0;  ///< m and M [kg]
  double trail = 0.0;                        ///< c [m] of the wheels behind their swivels; 0: none swivels
  double most_push = 0.0;                    ///< F [N]
};

/// The longest trail of the wheels on free swivels; 0 without one. [m]
double trail_of_swivels(const solver::Model& model);

/// How far it comes off the path, from the begin of the fillet to its end at a right angle. [m]
double off_the_path(const Rounding& rounding);

}  // namespace zwang::lang
