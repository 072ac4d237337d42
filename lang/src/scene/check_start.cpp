#include "scene/check_start.hpp"

#include <algorithm>

#include "diagnostic/wordings_standing.hpp"
#include "diagnostic/wordings_statics.hpp"
#include "scene/outline.hpp"
#include "zwang/lang/footing.hpp"
#include "zwang/lang/object_outline.hpp"
#include "zwang/lang/overlap.hpp"
#include "zwang/lang/plane.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {

namespace {

using solver::Vector3;

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

/// A guided object passes fixed ones: a drawer stands in its cabinet, a door in its frame.
bool meet(const SceneObject& one, const SceneObject& other) {
  if (one.guide && other.guide) return false;
  return (!one.guide || other.moves()) && (!other.guide || one.moves());
}

/// E913 of objects that the contact between them would throw apart. At least one of them gives way to a push.
/// `height` [m] of the lowest bumper: the plant leaves lower objects out.
void check_objects(const Scene& scene, double height, Diagnostics& diagnostics) {
  const auto& objects = scene.objects;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (std::size_t other = 0; other < i; ++other) {
      const bool gives_way = objects[i].inverse_mass() > 0.0 || objects[other].inverse_mass() > 0.0;
      if (!gives_way || !meet(objects[i], objects[other])) continue;
      if (!reaches(objects[i], height) || !reaches(objects[other], height)) continue;
      const double depth = overlap(objects[i], objects[other], height);
      if (depth > touching)
        diagnostics.add(wording::objects_overlap(objects[i].span, objects[i].name, objects[other].name, depth,
                                                 objects[other].span));
    }
  }
}

/// W644 of a bumper above all that the scene has.
void check_bumper(const Scene& scene, const Robot& robot, Diagnostics& diagnostics) {
  const SceneObject* highest = nullptr;
  for (const SceneObject& object : scene.objects) {
    if (object.leans() ? reaches(object, robot.bumper_height) : object.size[2] >= robot.bumper_height) return;
    if (highest == nullptr || object.size[2] > highest->size[2]) highest = &object;
  }
  if (highest != nullptr)
    diagnostics.add(
        wording::passes_all(highest->span, robot.name, highest->name, highest->size[2], robot.bumper_height));
}

}  // namespace

void check_objects_at_start(const Scene& scene, Diagnostics& diagnostics) {
  check_objects(scene, Robot{}.bumper_height, diagnostics);
}

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
  double lowest = first.bumper_height;
  for (const Standing& robot : robots) lowest = std::min(lowest, robot.robot->bumper_height);
  check_objects(scene, lowest, diagnostics);
  for (std::size_t r = 0; r < robots.size(); ++r) {
    const Standing& robot = robots[r];
    const double highest = highest_bumper(*robot.robot);
    if (robot.robot->bumper_height_said) check_bumper(scene, *robot.robot, diagnostics);
    for (const SceneObject& object : scene.objects) {
      if (object.size[2] < highest)
        diagnostics.add(wording::meets_or_passes(object.span, robot.robot->name, object.name, object.size[2],
                                                 robot.robot->bumper_height));
      const double height = robot.robot->bumper_height;
      if (!reaches(object, height)) continue;  // the robot passes
      const double depth = overlap(robot.outline, object, height);
      if (depth > touching)
        diagnostics.add(wording::starts_inside(object.span, robot.words, object.name, depth));
    }
    for (std::size_t other = r + 1; other < robots.size(); ++other) {
      const double depth = overlap(robot.outline, robots[other].outline);
      if (depth > touching)
        diagnostics.add(wording::starts_inside(robots[other].span, robot.words, robots[other].name, depth));
    }
  }
}

}  // namespace zwang::lang
