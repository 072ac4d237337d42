/// `axes`: the axes of joints, in the place of the URDF's. A joint without an <axis> turns about 1 0 0, which
/// an author who forgot it did not mean.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "robot/placed_urdf.hpp"
#include "robot/robot_file.hpp"
#include "robot/urdf.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

/// Three plain numbers that are not all 0; made a unit vector.
std::optional<JointAxisText> parse_axis_of_joint(const Entry& entry, Diagnostics& diagnostics);

/// Complains of names that are unknown, and of joints that do not move.
void apply_axes(const RobotFile& file, Urdf& urdf, Diagnostics& diagnostics);

/// `given`, and of joints whose <axis> is missing or tells nothing: of a wheel drawn as a cylinder the
/// cylinder's, of a swivel upwards. A swivel whose axis is its wheel's axle steers nothing: a template left
/// both. Then the wheel's axle is the root's y. The URDF has them then.
std::vector<JointAxis> find_axes_of(Urdf& urdf, const std::vector<JointAxis>& given);

/// Whether the joint is a swivel of this wheel by its own name or its link's. The name is a caster's or a
/// steering's, or the hinge stands right above the wheel.
bool is_called_swivel_of(const UrdfJoint& joint, const UrdfJoint& wheel, const PlacedUrdf& placed);

/// Wheels without an <axis>, of which nothing tells it.
std::vector<std::string> wheels_without_axis(const Urdf& urdf);

/// The section `axes` of a draft.
std::string axes_entry(const std::vector<JointAxis>& axes);

}  // namespace zwang::lang
