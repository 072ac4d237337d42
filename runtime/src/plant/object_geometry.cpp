#include "object_geometry.hpp"

#include <stdexcept>

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
