/// What the ground holds: the base's height, roll and pitch, and under each wheel the directions that do not
/// slip.
#pragma once

#include "sweep/sweeps.hpp"
#include "zwang/solver/model.hpp"

namespace zwang::solver {

/// a . A = bias on the spatial acceleration A of `body`, in the base's axes and at its origin.
struct GroundRow {
  int body = 0;
  Vector6 a;
  double bias = 0.0;  ///< minus the velocity products
};

int ground_row_count(const Model& model) noexcept;

/// Row `index` of the ground at the configuration and the twists in `sweeps`.
GroundRow ground_row(int index, const Model& model, const Sweeps& sweeps) noexcept;

/// Whether the base cannot move in the plane, at any configuration, without turning a wheel: wheels that are
/// mounted on it directly hold all three of its directions. Then the joints' rows span every motion.
bool every_motion_turns_a_wheel(const Model& model) noexcept;

}  // namespace zwang::solver
