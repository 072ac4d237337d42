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

/// Held direction number `index` of a wheel, a unit vector in the plane of the ground. `axis` is the wheel's
/// own; all in the same axes.
Vector3 held_direction(const Wheel& wheel, int index, const Vector3& axis, const Vector3& normal) noexcept;

int ground_row_count(const Model& model) noexcept;

/// Row `index` of the ground at the configuration and the twists in `sweeps`.
GroundRow ground_row(int index, const Model& model, const Sweeps& sweeps) noexcept;

}  // namespace zwang::solver
