/// Inertias that are nearly those of a body.
#pragma once

#include <optional>

#include "zwang/solver/spatial.hpp"

namespace zwang::lang {

/// Of the largest moment: by as much parts of a drawing and of a robot differ anyway.
inline constexpr double most_inertia_correction = 0.1;

/// A swivel with its fork and motors lies within so many times the reach of its wheel.
inline constexpr double swivel_reaches = 3.0;

struct CorrectedInertia {
  solver::RigidInertia inertia;
  double share = 0.0;  ///< of the largest moment, by which each moment was moved
};

/// No moment of a body about its centre of mass is larger than the sum of the other two. Where `inertia`
/// breaks this by little: the nearest that keeps it, by Frobenius norm. nullopt: it keeps it, or breaks it by
/// more.
std::optional<CorrectedInertia> corrected(const solver::RigidInertia& inertia);

}  // namespace zwang::lang
