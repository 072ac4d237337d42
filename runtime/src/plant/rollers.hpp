/// A mecanum or omni wheel as it is built: a hub, and rollers around it that spin freely.
///
/// The axis of a roller is turned by the roller angle delta from the wheel's axis. It lies in the plane that
/// touches the circle of the rollers' centres, at the radius c = R - r from the wheel's axis. If the roller
/// is turned by t out of the lowest place, its axis leans by sin delta sin t. An ellipsoid with the semi-axes
/// (r, r, a) then reaches below the wheel's axis down to
///   H(t) = c cos t + sqrt(r^2 + (a^2 - r^2) (sin delta sin t)^2)
/// H is R in the lowest place. It is R again at t = pi/n, where the next of n rollers takes over, with
///   a^2 = r^2 + ((R - c cos t)^2 - r^2) / (sin delta sin t)^2
#pragma once

#include <optional>
#include <vector>

#include "zwang/solver/model.hpp"

namespace zwang::runtime {

struct Roller {
  solver::Pose pose;             ///< in the wheel's body at q = 0, z along the roller's axis
  double radius = 0.0;           ///< r [m]
  double half = 0.0;             ///< a [m]
  solver::RigidInertia inertia;  ///< about its centre, in its own axes
};

struct RollerWheel {
  std::vector<Roller> rollers;
  solver::RigidInertia hub;  ///< the wheel's inertia without its rollers'
};

inline constexpr int roller_count = 18;

/// nullopt where rollers of this kind do not fit the wheel: they would lie along its axis, or would have more
/// inertia than all of it.
std::optional<RollerWheel> build_rollers(const solver::Model& model, const solver::Wheel& wheel);

}  // namespace zwang::runtime
