#include "scene/outline.hpp"

#include <cmath>

namespace zwang::lang {

Outline placed(Outline corners, const Pose2& pose) {
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  for (solver::Vector3& p : corners) {
    p = solver::Vector3(pose.at[0] + c * p.x() - s * p.y(), pose.at[1] + s * p.x() + c * p.y(), 0.0);
  }
  return corners;
}

Outline outline_of(const SceneObject& object) {
  const bool is_wall = object.shape == ShapeKind::wall;
  const double x = object.size[is_wall ? 1 : 0], y = object.size[is_wall ? 0 : 1];
  const double back = is_wall ? 0.0 : -0.5 * x;
  return {{back, -0.5 * y, 0.0}, {back + x, -0.5 * y, 0.0}, {back + x, 0.5 * y, 0.0}, {back, 0.5 * y, 0.0}};
}

}  // namespace zwang::lang
