/// Inertias that are nearly those of a body.
#pragma once

#include <optional>

#include "zwang/solver/spatial.hpp"

namespace zwang::lang {

/// Of the largest moment: by as much parts of a drawing and of a robot differ anyway.
inline constexpr double most_inertia_correction = 0.1;

/// A swivel with its fork and motors lies within so many times the reach of its wheel.
inline constexpr double swivel_reaches = 3.0;

/// [m] How far a body's centre of mass lies beside its joint's axis.
double beside_axis(const solver::RigidInertia& inertia, const solver::Vector3& axis);

/// A wheel of mass m whose centre lies e beside its axle drives the base by its weight with up to
/// m g e / R. Of the robot's weight more than this is told: as much as on a floor that leans by 0.6 deg.
inline constexpr double most_imbalance = 0.01;

struct CorrectedInertia {
  solver::RigidInertia inertia;
  double share = 0.0;  ///< of the largest moment, by which each moment was moved
};

/// No moment of a body about its centre of mass is larger than the sum of the other two. Where `inertia`
/// breaks this by little: the nearest that keeps it, by Frobenius norm. nullopt: it keeps it, or breaks it by
/// more.
std::optional<CorrectedInertia> corrected(const solver::RigidInertia& inertia);

}  // namespace zwang::lang
