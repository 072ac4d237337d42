// Two convex outlines overlap where no line parts them. The line that comes nearest to it lies along an edge
// of one of them:
//
//   depth = least over the edges' outward normals n of   max_a n'a - min_b n'b
//
// and is how far one has to move for them to part. Where it is below 0 they are apart: a corner of one is
// nearest to an edge of the other. A circle is its centre's depth plus its radius.
#include "zwang/lang/overlap.hpp"

#include <algorithm>
#include <cmath>

#include "scene/outline.hpp"
#include "zwang/lang/object_outline.hpp"
#include "zwang/lang/plane.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::lang {

using solver::Vector3;

namespace {

/// The least way over the edges of `a` only; below 0 they are apart.
double depth_by_edges(const Outline& a, const Outline& b) {
  double least = solver::infinity;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vector3 edge = a[(i + 1) % a.size()] - a[i];
    if (edge.norm() < 1e-9) continue;
    const Vector3 normal = Vector3(edge.y(), -edge.x(), 0.0).normalized();
    double nearest = solver::infinity;
    for (const Vector3& p : b) nearest = std::min(nearest, normal.dot(p - a[i]));
    least = std::min(least, -nearest);
  }
  return least;
}

/// Where it stands at the start: a script that begins later holds its first place.
Pose2 start_of(const SceneObject& object) {
  if (object.motion.empty()) return {object.at, object.yaw};
  return {object.motion.front().at, object.motion.front().yaw};
}

Vector3 centre_of(const SceneObject& object) {
  const Pose2 pose = start_of(object);
  return {pose.at[0], pose.at[1], 0.0};
}

/// [m] From the corners of `a` to the edges of `b`.
double way_between(const Outline& a, const Outline& b) {
  double least = solver::infinity;
  for (const Vector3& corner : a) least = std::min(least, plane::distance_to_edges(b, corner));
  return least;
}

double depth(const Outline& a, const Vector3& centre, double radius) {
  const double inside = depth_by_edges(a, {centre});
  if (inside >= 0.0) return inside + radius;
  return radius - plane::distance_to_edges(a, centre);
}

Outline outline_at_start(const SceneObject& object, double height) {
  return placed(outline_of(object, height), start_of(object));
}

}  // namespace

double overlap(const Outline& a, const Outline& b) {
  const double depth = std::min(depth_by_edges(a, b), depth_by_edges(b, a));
  return depth >= 0.0 ? depth : -std::min(way_between(a, b), way_between(b, a));
}

double overlap(const Outline& outline, const SceneObject& object, double height) {
  if (object.shape == ShapeKind::cylinder) return depth(outline, centre_of(object), object.size[0]);
  return overlap(outline, outline_at_start(object, height));
}

double overlap(const SceneObject& one, const SceneObject& other, double height) {
  if (one.shape != ShapeKind::cylinder) return overlap(outline_at_start(one, height), other, height);
  if (other.shape != ShapeKind::cylinder) return overlap(outline_at_start(other, height), one, height);
  return one.size[0] + other.size[0] - (centre_of(one) - centre_of(other)).norm();
}

}  // namespace zwang::lang
