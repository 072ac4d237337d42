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

/// The wheels of a swivel by its name: joints that it carries and that turn without end. Else none.
std::vector<const UrdfJoint*> wheels_of_swivel(const PlacedUrdf& placed, const UrdfJoint& joint) {
  const solver::JointType type = joint.joint.type;
  if (type != solver::JointType::continuous && type != solver::JointType::revolute) return {};
  std::vector<const UrdfJoint*> wheels = placed.carried_by(joint);
  std::erase_if(wheels,
                [](const UrdfJoint* other) { return other->joint.type != solver::JointType::continuous; });
  if (wheels.empty() || !is_called_swivel_of(joint, *wheels.front(), placed)) return {};
  return wheels;
}

bool is_level(const PlacedUrdf& placed, const UrdfJoint& joint) {
  return std::abs(placed.axis_of(joint).z()) <= PlacedUrdf::level;
}

/// In the frame of the joint: a direction of the base.
solver::Vector3 in_joint(const PlacedUrdf& placed, const UrdfJoint& joint, const solver::Vector3& direction) {
  return placed.pose_of(joint.child).rotation.transpose() * direction;
}

/// 1 0 0 at both, as a template leaves it: a swivel whose axis is its wheel's axle steers nothing.
bool are_left_alike(const PlacedUrdf& placed, const UrdfJoint& swivel, const UrdfJoint& wheel) {
  const auto is_left = [](const UrdfJoint& joint) {
    return joint.has_axis && joint.joint.type == solver::JointType::continuous &&
           joint.drawn_axis.isApprox(solver::Vector3::UnitX());
  };
  return is_left(swivel) && is_left(wheel) && is_level(placed, swivel) &&
         placed.axis_of(swivel).cross(placed.axis_of(wheel)).norm() < PlacedUrdf::level;
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

bool is_called_swivel_of(const UrdfJoint& joint, const UrdfJoint& wheel, const PlacedUrdf& placed) {
  constexpr double above = 5e-3;  // [m] beside its wheel: a suspension's arm is longer
  const auto is_called = [](const std::string& name) {
    return is_called_steering(name) || is_called_caster(name);
  };
  if (is_called(joint.joint.name) || is_called(joint.child)) return true;
  if (!is_called_hinge(joint.joint.name) && !is_called_hinge(joint.child)) return false;
  return (placed.place_of(joint) - placed.place_of(wheel)).head<2>().norm() < above;
}

std::vector<JointAxis> find_axes_of(Urdf& urdf, const std::vector<JointAxis>& given) {
  std::vector<JointAxis> found;
  for (const JointAxis& axis : given) {
    const UrdfJoint* joint = urdf.find_joint(axis.joint);
    if (joint != nullptr && joint->joint.type != solver::JointType::fixed) found.push_back(axis);
  }
  set_axes(urdf, found);
  const PlacedUrdf placed(urdf, urdf.root);
  const auto propose = [&](const UrdfJoint& joint, const solver::Vector3& axis) {
    const bool is_given = std::any_of(
        found.begin(), found.end(), [&](const JointAxis& other) { return other.joint == joint.joint.name; });
    if (!is_given && !(axis.cross(joint.joint.axis).norm() < PlacedUrdf::level))
      found.push_back({joint.joint.name, tidied(axis)});
  };
  for (const UrdfJoint& joint : urdf.joints) {
    const std::vector<const UrdfJoint*> wheels = wheels_of_swivel(placed, joint);
    const bool is_left = !wheels.empty() && are_left_alike(placed, joint, *wheels.front());
    const bool is_held_level = joint.is_turned && is_level(placed, joint);
    if (!wheels.empty() && (!joint.has_axis || is_left || is_held_level))
      propose(joint, in_joint(placed, joint, solver::Vector3::UnitZ()));
    for (const UrdfJoint* wheel : wheels) {
      const solver::Vector3 sideways = in_joint(placed, *wheel, solver::Vector3::UnitY());
      if (is_left) propose(*wheel, cylinder_axis_of(placed, *wheel).value_or(sideways));
    }
    if (!lacks_axis(joint) || !placed.carried_by(joint).empty()) continue;
    if (const auto axis = cylinder_axis_of(placed, joint)) propose(joint, *axis);
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
      "\n# The URDF has no <axis> for these joints, which means 1 0 0, or one that tells nothing. Proposed: "
      "of a "
      "wheel the\n# axis of its cylinder, or across the base; of a swivel upwards; x, y, z in the frame of "
      "the "
      "joint.\naxes:\n";
  for (const JointAxis& axis : axes) {
    char numbers[80];
    std::snprintf(numbers, sizeof numbers, "[%.6g, %.6g, %.6g]", axis.axis.x() + 0.0, axis.axis.y() + 0.0,
                  axis.axis.z() + 0.0);  // -0 + 0 is 0
    text += "  " + axis.joint + ": " + numbers + "\n";
  }
  return text;
}

}  // namespace zwang::lang
