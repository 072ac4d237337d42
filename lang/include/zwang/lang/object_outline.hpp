/// The outline that an object of a scene has at some height.
#pragma once

#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/scene.hpp"
#include "zwang/solver/spatial.hpp"

namespace zwang::lang {

/// The outline of a box or a wall from its `at`, in its own axes without roll and pitch. The corners [m] are
/// convex, counter-clockwise, and have z = 0. A leaning object is cut at `height` [m] above the floor. The
/// outline is empty if the object does not reach that height. An upright object has the same outline at any
/// height.
ZWANG_EXPORT std::vector<solver::Vector3> outline_of(const SceneObject& object, double height);
/// Whether it is there at `height` [m] above the floor, whatever its shape.
ZWANG_EXPORT bool reaches(const SceneObject& object, double height);
/// From the axes of a leaning object to those that it has without roll and pitch.
ZWANG_EXPORT solver::Matrix3 lean_of(const SceneObject& object);

}  // namespace zwang::lang
