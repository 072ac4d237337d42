/// Outlines of what stands on the floor, in a scene.
#pragma once

#include <array>
#include <vector>

#include "zwang/lang/scene.hpp"

namespace zwang::lang {

using Outline = std::vector<solver::Vector3>;

/// A place on the floor.
struct Pose2 {
  std::array<double, 2> at{};  ///< [m]
  double yaw = 0.0;            ///< [rad]
};

Outline placed(Outline corners, const Pose2& pose);
/// Of a box or a wall, in its own axes, as large as it is; a wall's `at` lies on the face that looks along
/// its -x.
Outline outline_of(const SceneObject& object);

}  // namespace zwang::lang
