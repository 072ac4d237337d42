#include "robot/placed_urdf.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace zwang::lang {

bool has_travel(const UrdfJoint& joint) {
  if (joint.joint.type == solver::JointType::fixed) return false;
  return joint.joint.type == solver::JointType::continuous || joint.joint.upper > joint.joint.lower;
}

PlacedUrdf::PlacedUrdf(const Urdf& urdf, std::string base) : urdf_(urdf), base_(std::move(base)) {
  std::map<std::string, solver::Pose> in_root{{urdf_.root, {}}};
  for (bool is_growing = true; is_growing;) {
    is_growing = false;
    for (const UrdfJoint& joint : urdf_.joints) {
      const auto parent = in_root.find(joint.parent);
      if (parent == in_root.end() || in_root.contains(joint.child)) continue;
      in_root[joint.child] = parent->second * joint.origin;
      is_growing = true;
    }
  }
  const solver::Pose to_base = in_root.at(base_).inverse();
  for (const auto& [name, pose] : in_root) in_base_[name] = to_base * pose;
}

const UrdfJoint* PlacedUrdf::carrier(const std::string& link) const {
  const auto next = [&](const std::string& l) { return l == base_ ? nullptr : urdf_.joint_above(l); };
  const UrdfJoint* above = next(link);
  while (above != nullptr && !has_travel(*above)) above = next(above->parent);
  return above;
}

std::vector<const UrdfJoint*> PlacedUrdf::carriers(const std::string& link) const {
  std::vector<const UrdfJoint*> above;
  for (const UrdfJoint* joint = carrier(link); joint != nullptr; joint = carrier(joint->parent))
    above.push_back(joint);
  return above;
}

std::vector<const UrdfJoint*> PlacedUrdf::carried_by(const UrdfJoint& joint) const {
  std::vector<const UrdfJoint*> below;
  for (const UrdfJoint& other : urdf_.joints) {
    if (has_travel(other) && carrier(other.parent) == &joint) below.push_back(&other);
  }
  return below;
}

std::optional<double> PlacedUrdf::radius_of(const UrdfJoint& joint) const {
  std::optional<double> radius = urdf_.find_link(joint.child)->radius;
  for (const UrdfLink& link : urdf_.links) {
    if (link.name == joint.child || !link.radius || carrier(link.name) != &joint) continue;
    const bool is_on_axle =
        (pose_of(link.name) * link.round_at - place_of(joint)).cross(axis_of(joint)).norm() <
        slack * *link.radius;
    const bool lies_flat =
        link.cylinder_axis &&
        (pose_of(link.name).rotation * *link.cylinder_axis).cross(axis_of(joint)).norm() > level;
    if (is_on_axle && !lies_flat) radius = std::max(radius.value_or(0.0), *link.radius);
  }
  return radius;
}

std::optional<double> PlacedUrdf::lowest_of(const UrdfJoint& joint) const {
  const std::optional<double> radius = radius_of(joint);
  if (!radius) return std::nullopt;
  return place_of(joint).z() - *radius;
}

bool PlacedUrdf::turns_about_level_axle(const UrdfJoint& joint) const {
  return joint.joint.type == solver::JointType::continuous && std::abs(axis_of(joint).z()) <= level;
}

}  // namespace zwang::lang
