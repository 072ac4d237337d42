/// How far two things on the floor overlap, where they stand at the start.
#pragma once

#include "scene/outline.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

inline constexpr double touching = 1e-4;  ///< [m] by so much what touches may overlap

/// [m] By so much one has to move for them to part; below 0 they are apart. Convex, counter-clockwise.
double overlap(const Outline& a, const Outline& b);
/// `height` [m] above the floor, at which an object that leans is cut.
double overlap(const Outline& outline, const SceneObject& object, double height);
double overlap(const SceneObject& one, const SceneObject& other, double height);

}  // namespace zwang::lang
