/// The outline that an object of a scene has at some height.
#pragma once

#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/scene.hpp"
#include "zwang/solver/spatial.hpp"

namespace zwang::lang {

/// Of a box or a wall, in its own axes without roll and pitch, from its `at`: convex, counter-clockwise, [m]
/// with z = 0. One that leans is cut at `height` [m] above the floor; empty where it does not reach there.
/// One that is upright has the same outline at any height.
ZWANG_EXPORT std::vector<solver::Vector3> outline_of(const SceneObject& object, double height);
/// Whether it is there at `height` [m] above the floor, whatever its shape.
ZWANG_EXPORT bool reaches(const SceneObject& object, double height);
/// From the axes of a leaning object to those that it has without roll and pitch.
ZWANG_EXPORT solver::Matrix3 lean_of(const SceneObject& object);

}  // namespace zwang::lang
