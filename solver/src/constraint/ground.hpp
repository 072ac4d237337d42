/// The motions that the ground holds: the base's height, roll and pitch, and under each wheel the directions
/// that do not slip.
#pragma once

#include <cmath>
#include <vector>

#include "sweep/sweeps.hpp"
#include "zwang/solver/model.hpp"

namespace zwang::solver {

/// A direction in the plane of the ground in which a wheel does not slip, as parts of its rolling and its
/// sideways direction.
struct HeldDirection {
  double rolling = 0.0;
  double sideways = 0.0;

  /// As a unit vector for a wheel that turns about `axis`, in axes with z along the ground's normal:
  /// sideways = axis in the plane, rolling = axis x z.
  Vector3 along(const Vector3& axis) const noexcept {
    const double square = axis.x() * axis.x() + axis.y() * axis.y();
    const double scale = square > 0.0 ? 1.0 / std::sqrt(square) : 0.0;
    return {scale * (sideways * axis.x() + rolling * axis.y()),
            scale * (sideways * axis.y() - rolling * axis.x()), 0.0};
  }
};

/// Every direction that a wheel holds: `visit(wheel, direction)`. The one of a roller's axis is turned by the
/// roller angle from sideways, away from rolling.
template <class Visit>
void for_each_held_direction(const Model& model, const Visit& visit) {
  for (const Wheel& wheel : model.wheels()) {
    if (wheel.roller_angle) {
      visit(wheel, HeldDirection{-std::sin(*wheel.roller_angle), std::cos(*wheel.roller_angle)});
      continue;
    }
    if (wheel.holds_rolling) visit(wheel, HeldDirection{1.0, 0.0});
    if (wheel.holds_sideways) visit(wheel, HeldDirection{0.0, 1.0});
  }
}

/// The rows a . A = bias of a model's ground, wheel by wheel. A are the spatial accelerations of the wheels,
/// in the base's axes and at its origin. (The base's own height, roll and pitch need no row: they are no
/// freedoms of it.)
class Ground {
 public:
  explicit Ground(const Model& model);

  int row_count() const noexcept { return static_cast<int>(held_.size()); }
  /// The wheel on which row `index` acts.
  std::size_t body(int index) const noexcept { return held_[static_cast<std::size_t>(index)].body; }
  /// a of row `index`, where the bodies are in `sweeps`; it stays while the robot's rows there do.
  Vector6 axis(int index, const Sweeps& sweeps) const noexcept;
  /// Minus the velocity products of row `index`, whose axis is `a`, at the twists in `sweeps`.
  double bias(int index, const Eigen::Ref<const Vector6>& a, const Sweeps& sweeps) const noexcept;

 private:
  struct Held {
    std::size_t body = 0;
    std::size_t carrier = 0;  ///< the body that the wheel turns on
    double radius = 0.0;
    HeldDirection direction;
  };

  std::vector<Held> held_;
};

}  // namespace zwang::solver
