// Two convex outlines are apart by at least
//
//   max over the directions n of   min_b n'b - max_a n'a - r_a - r_b
//
// with n across each of their edges and from one middle to the other; r is a circle's radius, whose outline
// is its centre.
#include "object_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "zwang/lang/object_outline.hpp"

namespace zwang::runtime {

using lang::SceneObject;
using lang::ShapeKind;
using solver::Vector3;

ObjectGeometry geometry_of(const SceneObject& object) {
  const auto& size = object.size;
  ObjectGeometry g;
  g.round = object.shape == ShapeKind::cylinder;
  g.shift = Vector3::Zero();
  if (object.shape == ShapeKind::wall) {
    g.half = 0.5 * Vector3(size[1], size[0], size[2]);  // the wall's x is its thickness
    g.shift.x() = g.half.x();                           // `at` lies on the face that looks along -x
  } else if (object.shape == ShapeKind::box) {
    g.half = 0.5 * Vector3(size[0], size[1], size[2]);
  } else {
    g.half = Vector3(size[0], size[0], 0.5 * size[2]);
  }
  if (!(g.half.minCoeff() > 0.0))
    throw std::invalid_argument("plant: the object `" + object.name + "` has no size");
  g.rotation = solver::rotation_from_rpy(object.roll, object.pitch, object.yaw);
  if (object.leans()) {
    g.shift.z() = g.half.z();
    g.centre = Vector3(object.at[0], object.at[1], 0.0) + g.rotation * g.shift;
  } else {
    g.centre = Vector3(object.at[0], object.at[1], g.half.z()) + g.rotation * g.shift;
  }
  return g;
}

namespace {

struct StandingOutline {
  std::vector<Vector3> corners;  ///< [m] world
  double radius = 0.0;           ///< [m]
};

StandingOutline standing_outline(const SceneObject& object, double height) {
  const Vector3 at(object.at[0], object.at[1], 0.0);
  if (object.shape == ShapeKind::cylinder) return {{at}, object.size[0]};
  StandingOutline standing;
  const solver::Matrix3 turned = solver::rotation_from_rpy(0.0, 0.0, object.yaw);
  for (const Vector3& corner : lang::outline_of(object, height))
    standing.corners.push_back(at + turned * corner);
  return standing;
}

double apart_along(const Vector3& n, const StandingOutline& a, const StandingOutline& b) {
  double end_of_a = -std::numeric_limits<double>::infinity(), begin_of_b = -end_of_a;
  for (const Vector3& corner : a.corners) end_of_a = std::max(end_of_a, n.dot(corner));
  for (const Vector3& corner : b.corners) begin_of_b = std::min(begin_of_b, n.dot(corner));
  return begin_of_b - end_of_a - a.radius - b.radius;
}

Vector3 middle_of(const StandingOutline& outline) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& corner : outline.corners) sum += corner;
  return sum / static_cast<double>(outline.corners.size());
}

}  // namespace

double gap_between(const SceneObject& a, const SceneObject& b, double height) {
  if (!lang::reaches(a, height) || !lang::reaches(b, height)) return std::numeric_limits<double>::infinity();
  const StandingOutline one = standing_outline(a, height), other = standing_outline(b, height);
  std::vector<Vector3> across{middle_of(other) - middle_of(one)};
  for (const StandingOutline* outline : {&one, &other}) {
    for (std::size_t i = 0; i < outline->corners.size(); ++i) {
      const Vector3 edge = outline->corners[(i + 1) % outline->corners.size()] - outline->corners[i];
      across.emplace_back(edge.y(), -edge.x(), 0.0);
    }
  }
  double gap = -std::numeric_limits<double>::infinity();
  for (const Vector3& n : across) {
    if (n.norm() < 1e-9) continue;
    gap = std::max({gap, apart_along(n.normalized(), one, other), apart_along(-n.normalized(), one, other)});
  }
  return gap;
}

ScriptedPose scripted_pose(const std::vector<lang::Waypoint>& motion, double time) noexcept {
  ScriptedPose pose;
  std::size_t next = 0;
  while (next < motion.size() && motion[next].time <= time) ++next;
  const lang::Waypoint& from = motion[next == 0 ? 0 : next - 1];
  pose.at = from.at;
  pose.yaw = from.yaw;
  if (next == 0 || next == motion.size()) return pose;
  const lang::Waypoint& to = motion[next];
  const double length = to.time - from.time;
  const double share = (time - from.time) / length;
  for (std::size_t i = 0; i < 2; ++i) {
    pose.velocity[i] = (to.at[i] - from.at[i]) / length;
    pose.at[i] = from.at[i] + share * (to.at[i] - from.at[i]);
  }
  pose.turn = (to.yaw - from.yaw) / length;
  pose.yaw = from.yaw + share * (to.yaw - from.yaw);
  return pose;
}

}  // namespace zwang::runtime
