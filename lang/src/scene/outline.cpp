#include "scene/outline.hpp"

#include <array>
#include <cmath>

#include "zwang/lang/object_outline.hpp"
#include "zwang/lang/plane.hpp"

namespace zwang::lang {

using solver::Vector3;

namespace {

/// Where the edges of an upright block meet a plane, once it was turned by `lean`. The corners of an edge
/// differ in one bit of their number.
Outline cut_block(const std::array<Vector3, 8>& corners, double height) {
  Outline cut;
  for (unsigned one = 0; one < 8; ++one) {
    for (const unsigned bit : {1U, 2U, 4U}) {
      if ((one & bit) != 0) continue;
      const Vector3 &a = corners[one], &b = corners[one | bit];
      if ((a.z() - height) * (b.z() - height) > 0.0 || a.z() == b.z()) continue;
      const Vector3 at = a + (height - a.z()) / (b.z() - a.z()) * (b - a);
      cut.emplace_back(at.x(), at.y(), 0.0);
    }
  }
  return cut.size() < 3 ? Outline{} : plane::convex_hull(std::move(cut));
}

}  // namespace

Outline placed(Outline corners, const Pose2& pose) {
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  for (Vector3& p : corners) {
    p = Vector3(pose.at[0] + c * p.x() - s * p.y(), pose.at[1] + s * p.x() + c * p.y(), 0.0);
  }
  return corners;
}

solver::Matrix3 lean_of(const SceneObject& object) {
  return solver::rotation_from_rpy(object.roll, object.pitch, 0.0);
}

Outline outline_of(const SceneObject& object, double height) {
  const bool is_wall = object.shape == ShapeKind::wall;
  const double x = object.size[is_wall ? 1 : 0], y = object.size[is_wall ? 0 : 1];
  const double back = is_wall ? 0.0 : -0.5 * x;
  if (!object.leans())
    return {{back, -0.5 * y, 0.0}, {back + x, -0.5 * y, 0.0}, {back + x, 0.5 * y, 0.0}, {back, 0.5 * y, 0.0}};
  const solver::Matrix3 lean = lean_of(object);
  std::array<Vector3, 8> corners;
  for (unsigned i = 0; i < 8; ++i) {
    corners[i] = lean * Vector3((i & 1U) != 0 ? back + x : back, (i & 2U) != 0 ? 0.5 * y : -0.5 * y,
                                (i & 4U) != 0 ? object.size[2] : 0.0);
  }
  return cut_block(corners, height);
}

bool reaches(const SceneObject& object, double height) {
  return object.leans() ? !outline_of(object, height).empty() : object.size[2] >= height;
}

}  // namespace zwang::lang
