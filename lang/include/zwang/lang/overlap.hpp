/// How far two things on the floor overlap, or stand apart, where a scene begins.
#pragma once

#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/scene.hpp"
#include "zwang/solver/spatial.hpp"

namespace zwang::lang {

inline constexpr double touching = 1e-4;  ///< [m] by so much what touches may overlap

/// [m] By so much one of two convex, counter-clockwise outlines has to move for them to part. Below 0 they
/// are apart, by its absolute value.
double overlap(const std::vector<solver::Vector3>& a, const std::vector<solver::Vector3>& b);
/// `height` [m] above the floor, which the object reaches. An object that leans is cut there.
double overlap(const std::vector<solver::Vector3>& outline, const SceneObject& object, double height);
/// Both reach `height` [m].
ZWANG_EXPORT double overlap(const SceneObject& one, const SceneObject& other, double height);

}  // namespace zwang::lang
