#include "physics/ahead.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "zwang/lang/object_outline.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {

namespace {

using solver::Vector3;

struct Touch {
  double way = 0.0;  ///< [m]
  Vector3 at;        ///< on what stands
};

/// From p along `sign` times `forward` to the nearest edge of a polygon; infinite: to none. [m]
double way_to(const Vector3& p, const Outline& polygon, const Vector3& forward, double sign) {
  constexpr double rounding = 1e-9;  // corners of equal widths meet
  double least = solver::infinity;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vector3 edge = polygon[i] - polygon[j], to = polygon[j] - p;
    // p + t sign forward = polygon[j] + u edge
    const double cross = sign * (forward.x() * edge.y() - forward.y() * edge.x());
    if (std::abs(cross) < 1e-12) continue;
    const double t = (to.x() * edge.y() - to.y() * edge.x()) / cross;
    const double u = sign * (to.x() * forward.y() - to.y() * forward.x()) / cross;
    if (t >= -1e-6 && u >= -rounding && u <= 1.0 + rounding) least = std::min(least, std::max(0.0, t));
  }
  return least;
}

}  // namespace

Meeting meeting_of(const Outline& moved, const Outline& other, const Vector3& forward) {
  constexpr double together = 1e-3;  // [m]
  std::vector<Touch> touches;
  for (const Vector3& p : moved) {
    const double way = way_to(p, other, forward, 1.0);
    if (std::isfinite(way)) touches.push_back({way, p + way * forward});
  }
  for (const Vector3& p : other) {
    const double way = way_to(p, moved, forward, -1.0);
    if (std::isfinite(way)) touches.push_back({way, p});
  }
  Meeting meeting;
  for (const Touch& touch : touches) meeting.way = std::min(meeting.way, touch.way);
  for (const Touch& touch : touches) {
    if (touch.way > meeting.way + together) continue;
    ++meeting.points;
    meeting.middle += touch.at;
  }
  if (meeting.points > 0) meeting.middle /= meeting.points;
  return meeting;
}

Outline outline_in_world(const SceneObject& object, double height) {
  constexpr int sides = 32;
  const Pose2 pose{object.at, object.yaw};
  if (object.shape != ShapeKind::cylinder) return placed(outline_of(object, height), pose);
  Outline outline;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    outline.push_back(object.size[0] * Vector3(std::cos(angle), std::sin(angle), 0.0));
  }
  return placed(std::move(outline), pose);
}

Outline outline_in_world(const SceneRobot& robot) {
  return robot.program ? placed(robot.program->robot.footprint, {robot.at, robot.yaw}) : Outline{};
}

Outline outline_at_start(const Robot& robot, const Scene& scene) {
  const solver::Pose pose = start_state(robot, scene).base_pose;
  Outline outline;
  for (const Vector3& corner : robot.footprint) outline.push_back(pose * corner);
  return outline;
}

Ahead first_ahead(const Scene& scene, const Robot& robot, const Vector3& forward) {
  const Outline base = outline_at_start(robot, scene);
  Ahead ahead;
  for (const SceneObject& object : scene.objects) {
    if (!reaches(object, robot.bumper_height) || !object.motion.empty()) continue;
    Meeting meeting = meeting_of(base, outline_in_world(object, robot.bumper_height), forward);
    if (object.shape == ShapeKind::cylinder) meeting.points = std::min(meeting.points, 1);
    if (meeting.way < ahead.meeting.way) ahead = {&object, nullptr, meeting};
  }
  for (const SceneRobot& other : scene.robots) {
    const Outline outline = outline_in_world(other);
    if (outline.empty()) continue;
    const Meeting meeting = meeting_of(base, outline, forward);
    if (meeting.way < ahead.meeting.way) ahead = {nullptr, &other, meeting};
  }
  return ahead;
}

double way_behind(const Scene& scene, const SceneObject& object, double height, const Vector3& forward) {
  const Outline moved = outline_in_world(object, height);
  double way = solver::infinity;
  for (const SceneObject& other : scene.objects) {
    if (&other == &object || !reaches(other, height)) continue;
    way = std::min(way, meeting_of(moved, outline_in_world(other, height), forward).way);
  }
  for (const SceneRobot& other : scene.robots) {
    const Outline outline = outline_in_world(other);
    if (!outline.empty()) way = std::min(way, meeting_of(moved, outline, forward).way);
  }
  return way;
}

bool is_behind(const Outline& other, const Outline& base, const Vector3& forward) {
  double foremost = -solver::infinity, rearmost = solver::infinity;
  for (const Vector3& p : other) foremost = std::max(foremost, p.dot(forward));
  for (const Vector3& p : base) rearmost = std::min(rearmost, p.dot(forward));
  return foremost <= rearmost;
}

}  // namespace zwang::lang
