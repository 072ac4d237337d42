/// Where two convex outlines touch, as far as a log tells it: it has forces, and no places.
#pragma once

#include <vector>

#include "zwang/lang/scene.hpp"
#include "zwang/solver/spatial.hpp"

namespace zwang::runtime {

/// In the plane, z = 0.
struct ContactPlace {
  solver::Vector3 at = solver::Vector3::Zero();
  double heading = 0.0;  ///< [rad] of the way from the object into the robot
};

/// Both counter-clockwise, in the same axes. The place is where they are nearest; of edges that lie flush it
/// is the middle of what they share.
ContactPlace contact_place(const std::vector<solver::Vector3>& robot,
                           const std::vector<solver::Vector3>& object);

/// Counter-clockwise, in the object's own axes, where it is met at `height` [m].
std::vector<solver::Vector3> touched_outline(const lang::SceneObject& object, double height);

}  // namespace zwang::runtime
