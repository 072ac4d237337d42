/// Objects and robots of a scene on the base's way.
#pragma once

#include <vector>

#include "scene/outline.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// Where two outlines touch first if one of them goes straight on.
struct Meeting {
  double way = solver::infinity;          ///< [m] infinite: it passes by
  int points = 0;                         ///< corners of either that strike together
  solver::Vector3 middle{0.0, 0.0, 0.0};  ///< [m] world, of these points as the other one stands
};

/// `moved` goes along `forward`, a unit vector. All in the world.
Meeting meeting_of(const Outline& moved, const Outline& other, const solver::Vector3& forward);

/// At the height of the bumper, in the world.
Outline outline_in_world(const SceneObject& object, double height);
Outline outline_in_world(const SceneRobot& robot);
/// The first robot's footprint at its start.
Outline outline_at_start(const Robot& robot, const Scene& scene);

/// The first that the base meets straight on from its start, of objects without a script and of robots.
struct Ahead {
  const SceneObject* object = nullptr;
  const SceneRobot* robot = nullptr;
  Meeting meeting;

  bool is_any() const { return object != nullptr || robot != nullptr; }
};
Ahead first_ahead(const Scene& scene, const Robot& robot, const solver::Vector3& forward);

/// From an object straight on to the next thing that stands behind it; infinite: nothing does. [m]
double way_behind(const Scene& scene, const SceneObject& object, double height,
                  const solver::Vector3& forward);

/// Whether it lies behind all of the base at its start: a base that does not turn never meets it on the way
/// ahead.
bool is_behind(const Outline& other, const Outline& base, const solver::Vector3& forward);

}  // namespace zwang::lang
