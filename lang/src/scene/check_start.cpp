// Two convex outlines overlap where no line parts them. The line that comes nearest to it lies along an edge
// of one of them:
//
//   depth = least over the edges' outward normals n of   max_a n'a - min_b n'b
//
// and is how far one has to move for them to part. A circle is its centre's depth plus its radius.
#include "scene/check_start.hpp"

#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_standing.hpp"
#include "diagnostic/wordings_statics.hpp"
#include "scene/outline.hpp"
#include "zwang/lang/footing.hpp"
#include "zwang/lang/object_outline.hpp"
#include "zwang/lang/plane.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {

namespace {

using solver::Vector3;

constexpr double touching = 1e-4;  ///< [m] by so much what touches may overlap

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

double depth(const Outline& a, const Outline& b) {
  return std::min(depth_by_edges(a, b), depth_by_edges(b, a));
}

double depth(const Outline& a, const Vector3& centre, double radius) {
  const double inside = depth_by_edges(a, {centre});
  if (inside >= 0.0) return inside + radius;
  return radius - plane::distance_to_edges(a, centre);
}

/// Where it stands at the start: a script that begins later holds its first place.
Pose2 start_of(const SceneObject& object) {
  if (object.motion.empty()) return {object.at, object.yaw};
  return {object.motion.front().at, object.motion.front().yaw};
}

/// `height` [m] is the bumper's.
double depth(const Outline& robot, const SceneObject& object, double height) {
  const Pose2 pose = start_of(object);
  if (object.shape == ShapeKind::cylinder) return depth(robot, {pose.at[0], pose.at[1], 0.0}, object.size[0]);
  return depth(robot, placed(outline_of(object, height), pose));
}

/// The largest height [m] of a bumper whose height the robot file does not give. An even body is twice as
/// high as its centre of mass. 0: the height is given, or the robot has no footing.
double highest_bumper(const Robot& robot) {
  if (robot.bumper_height_said) return 0.0;
  const std::optional<Footing> footing = footing_of(robot);
  return footing ? 2.0 * footing->height : 0.0;
}

struct Standing {
  std::string words;  ///< "the robot", "`partner`"
  std::string name;
  const Robot* robot;
  Outline outline;  ///< in the world
  Span span;
};

}  // namespace

void check_start(const Scene& scene, const Robot& first, Diagnostics& diagnostics) {
  std::vector<Standing> robots;
  const auto stand = [&](std::string words, const std::string& name, const Robot& robot, const Pose2& pose,
                         const Span& span) {
    if (robot.footprint.size() < 3) return;
    robots.push_back(
        {std::move(words), name, &robot, plane::convex_hull(placed(robot.footprint, pose)), span});
  };
  stand("the robot", "", first, {scene.start_at, scene.start_yaw}, {});
  for (const SceneRobot& other : scene.robots) {
    if (other.program)
      stand("robot `" + other.name + "`", other.name, other.program->robot, {other.at, other.yaw},
            other.span);
  }
  for (std::size_t r = 0; r < robots.size(); ++r) {
    const Standing& robot = robots[r];
    const double highest = highest_bumper(*robot.robot);
    for (const SceneObject& object : scene.objects) {
      if (object.size[2] < highest)
        diagnostics.add(wording::meets_or_passes(object.span, robot.robot->name, object.name, object.size[2],
                                                 robot.robot->bumper_height));
      const double height = robot.robot->bumper_height;
      if (!reaches(object, height)) continue;  // the robot passes
      const double overlap = depth(robot.outline, object, height);
      if (overlap > touching)
        diagnostics.add(wording::starts_inside(object.span, robot.words, object.name, overlap));
    }
    for (std::size_t other = r + 1; other < robots.size(); ++other) {
      const double overlap = depth(robot.outline, robots[other].outline);
      if (overlap > touching)
        diagnostics.add(wording::starts_inside(robots[other].span, robot.words, robots[other].name, overlap));
    }
  }
}

}  // namespace zwang::lang
