/// How nearly a ground holds a direction before it holds it.
///
/// The lines of two wheels that toe by the angle e leave each other a share of sin^2 e. In exact arithmetic,
/// four steered wheels that toe by 1e-5 rad hold the base. At 1e-4 rad a row along y holds it. No motor
/// steers so exactly, and a tyre gives way. The model's steering error e counts where motors steer wheels:
///   - a wheel that toes by less than e holds nothing that the other wheels leave,
///   - a row of which the wheels leave less than sin^2 e holds and pushes nothing.
#pragma once

#include <algorithm>
#include <cmath>

#include "zwang/solver/model.hpp"

namespace zwang::solver {

/// Of A M^-1 A': the share of a row that the rows of the ground leave.
struct LeastShares {
  double of_ground = 1e-10;  ///< with less, a row of the ground depends on others; rounding leaves 1e-15
  double of_row = 1e-8;      ///< with less, nothing moves along a row
};

/// Whether a motor steers one of the plain wheels, which hold sideways.
inline bool has_steered_wheel(const Model& model) {
  for (const Wheel& wheel : model.wheels()) {
    const int carrier = model.bodies()[static_cast<std::size_t>(wheel.body)].parent;
    if (!wheel.roller_angle && wheel.holds_sideways && carrier > 0 && model.joint(carrier - 1).actuated)
      return true;
  }
  return false;
}

inline LeastShares least_shares(const Model& model) {
  LeastShares least;
  if (!has_steered_wheel(model)) return least;
  const double share = std::pow(std::sin(model.steering_error()), 2);
  return {std::max(least.of_ground, share), std::max(least.of_row, share)};
}

}  // namespace zwang::solver
