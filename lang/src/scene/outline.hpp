/// Outlines of what stands on the floor, in a scene.
#pragma once

#include <array>
#include <vector>

#include "zwang/lang/scene.hpp"
#include "zwang/solver/spatial.hpp"

namespace zwang::lang {

using Outline = std::vector<solver::Vector3>;

/// A place on the floor.
struct Pose2 {
  std::array<double, 2> at{};  ///< [m]
  double yaw = 0.0;            ///< [rad]
};

Outline placed(Outline corners, const Pose2& pose);

}  // namespace zwang::lang
