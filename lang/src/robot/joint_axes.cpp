#include "robot/joint_axes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "diagnostic/wordings.hpp"
#include "robot/placed_urdf.hpp"
#include "robot/wheel_names.hpp"
#include "spec/shape.hpp"

namespace zwang::lang {

namespace {

bool lacks_axis(const UrdfJoint& joint) {
  return !joint.has_axis && joint.joint.type == solver::JointType::continuous;
}

bool turns_named_wheel(const UrdfJoint& joint) {
  return is_called_wheel(joint.joint.name) || is_called_wheel(joint.child);
}

/// Along the axis that it means, with its largest part positive.
solver::Vector3 tidied(solver::Vector3 axis) {
  constexpr double rounding = 1e-3;
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  axis *= axis(largest) < 0.0 ? -1.0 : 1.0;
  for (double& part : axis) part = std::abs(part) < rounding ? 0.0 : part;
  return axis.normalized();
}

/// Of the cylinder of a link, or of one that is fixed to it, in the frame of the joint.
std::optional<solver::Vector3> cylinder_axis_of(const PlacedUrdf& placed, const UrdfJoint& joint) {
  const UrdfLink* own = placed.urdf().find_link(joint.child);
  if (own->cylinder_axis) return own->cylinder_axis;
  for (const UrdfLink& link : placed.urdf().links) {
    if (!link.cylinder_axis || placed.carrier(link.name) != &joint) continue;
    return placed.pose_of(joint.child).rotation.transpose() *
           (placed.pose_of(link.name).rotation * *link.cylinder_axis);
  }
  return std::nullopt;
}

void set_axes(Urdf& urdf, const std::vector<JointAxis>& axes) {
  for (const JointAxis& axis : axes) {
    urdf.find_joint(axis.joint)->joint.axis = axis.axis;
    urdf.find_joint(axis.joint)->has_axis = true;
  }
}

/// It carries a wheel, and is called steering or a caster's.
bool is_called_swivel(const PlacedUrdf& placed, const UrdfJoint& joint) {
  const std::vector<const UrdfJoint*> below = placed.carried_by(joint);
  const bool carries_a_wheel = std::any_of(below.begin(), below.end(), [](const UrdfJoint* other) {
    return other->joint.type == solver::JointType::continuous;
  });
  return carries_a_wheel && (is_called_steering(joint.joint.name) || is_called_caster(joint.joint.name));
}

}  // namespace

std::optional<JointAxisText> parse_axis_of_joint(const Entry& entry, Diagnostics& diagnostics) {
  const auto parts =
      parse_vector(entry.value, dimension::none, 3, 3, "the axis of `" + entry.key.text + "`", diagnostics);
  if (!parts) return std::nullopt;
  const solver::Vector3 axis(parts->at(0), parts->at(1), parts->at(2));
  constexpr double none = 1e-6;
  if (axis.norm() < none) {
    diagnostics.add(wording::zero_axis(entry.value.span, entry.key.text));
    return std::nullopt;
  }
  return JointAxisText{{entry.key.text, entry.key.span}, axis.normalized()};
}

void apply_axes(const RobotFile& file, Urdf& urdf, Diagnostics& diagnostics) {
  for (const JointAxisText& text : file.axes) {
    if (!text.joint.exists()) continue;
    UrdfJoint* joint = urdf.find_joint(text.joint.text);
    if (joint == nullptr) {
      diagnostics.add(wording::unknown_name(text.joint.span, "joint", text.joint.text, urdf.joint_names()));
    } else if (joint->joint.type == solver::JointType::fixed) {
      diagnostics.add(wording::fixed_joint(text.joint.span, text.joint.text, joint->span));
    } else {
      joint->joint.axis = text.axis;
    }
  }
}

std::vector<JointAxis> find_axes_of(Urdf& urdf, const std::vector<JointAxis>& given) {
  std::vector<JointAxis> found;
  for (const JointAxis& axis : given) {
    const UrdfJoint* joint = urdf.find_joint(axis.joint);
    if (joint != nullptr && joint->joint.type != solver::JointType::fixed) found.push_back(axis);
  }
  set_axes(urdf, found);
  const PlacedUrdf placed(urdf, urdf.root);
  for (const UrdfJoint& joint : urdf.joints) {
    if (!lacks_axis(joint)) continue;
    std::optional<solver::Vector3> axis;
    if (is_called_swivel(placed, joint)) {
      axis = placed.pose_of(joint.child).rotation.transpose() * solver::Vector3::UnitZ();
    } else if (placed.carried_by(joint).empty()) {
      axis = cylinder_axis_of(placed, joint);
    }
    if (!axis || axis->cross(joint.joint.axis).norm() < PlacedUrdf::level) continue;
    found.push_back({joint.joint.name, tidied(*axis)});
  }
  set_axes(urdf, found);
  return found;
}

std::vector<std::string> wheels_without_axis(const Urdf& urdf) {
  const PlacedUrdf placed(urdf, urdf.root);
  std::vector<std::string> names;
  for (const UrdfJoint& joint : urdf.joints) {
    const bool is_told = cylinder_axis_of(placed, joint).has_value();
    if (lacks_axis(joint) && turns_named_wheel(joint) && !is_told) names.push_back(joint.joint.name);
  }
  return names;
}

std::string axes_entry(const std::vector<JointAxis>& axes) {
  if (axes.empty()) return "";
  std::string text =
      "\n# The URDF has no <axis> for these joints, and that means 1 0 0. Proposed: of a wheel the axis of "
      "its "
      "cylinder, or\n# across the base; of a swivel upwards; x, y, z in the frame of the joint.\naxes:\n";
  for (const JointAxis& axis : axes) {
    char numbers[80];
    std::snprintf(numbers, sizeof numbers, "[%.6g, %.6g, %.6g]", axis.axis.x() + 0.0, axis.axis.y() + 0.0,
                  axis.axis.z() + 0.0);  // -0 + 0 is 0
    text += "  " + axis.joint + ": " + numbers + "\n";
  }
  return text;
}

}  // namespace zwang::lang
