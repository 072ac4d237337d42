// The object moves along the push by b for each unit of its travel q. There it weighs J / b^2, J the inertia
// of q. The preload P and the friction R hold it with (P + R) / b, and its way along the push is b times the
// range.
//
//   slide u            b = u . forward              J: the mass
//   hinge at p         b = (middle - p) x forward   J: about the hinge
//   on the floor       1/M, with r^2/I where it is struck r beside its middle by one corner
#include "physics/gives_way.hpp"

#include <algorithm>
#include <cmath>

#include "robot/gravity.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {

namespace {

using solver::Vector3;

Vector3 turned_with(const SceneObject& object, const Vector3& v) {
  return solver::rotation_from_rpy(0.0, 0.0, object.yaw) * v;
}

/// `lever`: b. Below `least_lever` it is a wall. `inertia`: J.
GivesWay on_joint(const Guide& guide, double lever, double inertia, double least_lever) {
  if (std::abs(lever) < least_lever) return {};
  const double range = lever > 0.0 ? guide.upper : -guide.lower;
  const double arm = std::abs(lever);
  constexpr double at_stop = 1e-6;  // [m] or [rad]
  if (range < at_stop) return {};
  return {arm * arm / inertia, (guide.preload + guide.friction) / arm, guide.stiffness / (arm * arm),
          range * arm};
}

}  // namespace

double held_by_floor(const Scene& scene, const SceneObject& object) {
  if (!object.mass || object.guide || object.caster_trail > 0.0) return 0.0;
  return object.slides_on(scene.floor_friction) * *object.mass * gravity;
}

GivesWay gives_way(const Scene& scene, const SceneObject& object, const Meeting& meeting,
                   const Vector3& forward, double height) {
  if (!object.mass || object.is_locked()) return {};
  const Vector3 at(object.at[0], object.at[1], 0.0);
  if (!object.guide) {
    double inverse = 1.0 / *object.mass;
    const double aside = (meeting.middle - at).cross(forward).z();
    // Two corners hold its heading; one turns it, unless it is round.
    if (meeting.points == 1 && object.shape != ShapeKind::cylinder)
      inverse += aside * aside / object.yaw_inertia();
    return {inverse, held_by_floor(scene, object), 0.0, way_behind(scene, object, height, forward)};
  }
  const Guide& guide = *object.guide;
  if (!guide.turns) {
    constexpr double least_share = 0.2;  // beyond 78 deg it jams by friction
    const Vector3 along = turned_with(object, Vector3(guide.axis[0], guide.axis[1], guide.axis[2]));
    const double share = along.dot(forward);
    return on_joint(guide, share, *object.mass, least_share);
  }
  constexpr double least_arm = 0.02;  // [m] beside the axis it is a wall
  const Vector3 offset = turned_with(object, Vector3(guide.at[0], guide.at[1], 0.0));
  const double arm = (meeting.middle - at - offset).cross(forward).z();
  return on_joint(guide, arm, object.yaw_inertia() + *object.mass * offset.squaredNorm(), least_arm);
}

}  // namespace zwang::lang
