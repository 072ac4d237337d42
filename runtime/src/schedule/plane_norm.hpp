/// A norm in a plane as limits along directions.
///
/// An acceleration p'' of a point stays below a, whatever its direction, if
///
///   n_k . p'' <= a cos(pi/16),   n_k the 16 directions of a regular polygon.
///
/// A force of f at most on a frictionless wall with any normal n: what the robot presses along n_k stays
/// below f cos(pi/16) / o. Between two n_k the wall feels more where the mass differs by direction: o makes
/// up for it.
///
/// A point that wheels do not let move sideways has one direction, and s = w v of it is its acceleration
/// across:
///
///   v' <= sqrt(a^2 - s^2),   v' >= -max(a/2, sqrt(a^2 - s^2)),   |s| <= a.
#pragma once

#include <numbers>
#include <string>

#include "zwang/lang/program.hpp"
#include "zwang/solver/constraint.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// How one point of the robot moves in the plane of some axes.
struct PlaneNorm {
  static constexpr int most_sides = 8;                    ///< each stands for two directions
  static constexpr int across = most_sides / 2;           ///< the side at right angles to side 0
  static constexpr double apothem = 0.98078528040323043;  ///< cos(pi/16)

  bool rolls = false;        ///< it moves along one direction
  double heading = 0.0;      ///< that one, in the axes of the plane [rad]
  double mass_factor = 1.0;  ///< o

  /// Constraints that a norm of accelerations or forces becomes.
  int count() const noexcept { return rolls ? 2 : most_sides; }
  /// Of f, what is pressed along a direction at most.
  double share_of_force() const noexcept { return rolls ? 1.0 : apothem / mass_factor; }
  /// "side3", "ahead", "turn". Allocates.
  std::string name(int i) const;
  /// Constraint `i` between the two frames, without ranges.
  solver::AxisConstraint constraint(int i, const solver::AttachedFrame& move,
                                    const solver::AttachedFrame& in) const noexcept;
};

/// Whether the axis stands for the norm of an acceleration or of a force.
bool limits_a_plane(const lang::AxisStatements& axis) noexcept;

/// `in` only orients where it belongs to the body of `move`: axes that do not turn with it leave no direction
/// in which a point rolls. Allocates.
PlaneNorm plane_norm_of(const solver::Model& model, const solver::AttachedFrame& move,
                        const solver::AttachedFrame& in);

/// o of a mass whose largest and smallest effective value differ by `ratio` >= 1, at the worst orientation.
double mass_factor_of(double ratio) noexcept;

/// The allowed acceleration ahead of a rolling point while it accelerates across by `across`. [m/s^2]
solver::Range ahead_of(double most, double across) noexcept;

}  // namespace zwang::runtime
