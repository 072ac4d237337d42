/// Where the objects of a scene stand, and what of them the robot can touch.
#pragma once

#include "zwang/lang/scene.hpp"
#include "zwang/solver/spatial.hpp"

namespace zwang::runtime {

struct ObjectGeometry {
  solver::Vector3 centre;  ///< [m] world
  solver::Vector3 half;    ///< [m] half extents of a box; radius, radius, half height of a cylinder
  solver::Vector3 shift;   ///< [m] from the object's `at` to its centre, in its own axes
  solver::Matrix3 rotation = solver::Matrix3::Identity();  ///< of its axes, in the world
  bool round = false;
};

/// Throws std::invalid_argument on an object without a size.
ObjectGeometry geometry_of(const lang::SceneObject& object);

/// Where a scripted object stands at a time: at, yaw, and their rates.
struct ScriptedPose {
  std::array<double, 2> at{}, velocity{};
  double yaw = 0.0, turn = 0.0;
};
ScriptedPose scripted_pose(const std::vector<lang::Waypoint>& motion, double time) noexcept;

}  // namespace zwang::runtime
