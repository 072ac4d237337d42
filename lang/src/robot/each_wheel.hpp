/// `each_wheel`: what every wheel with a motor is, where the wheel or its motor says nothing. `each_joint`:
/// the same of motors that turn no wheel.
#pragma once

#include <optional>

#include "robot/robot_file.hpp"
#include "robot/urdf.hpp"

namespace zwang::lang {

EachWheel parse_each_wheel(const Node& node, Diagnostics& diagnostics);
EachJoint parse_each_joint(const Node& node, Diagnostics& diagnostics);

/// Radii and motors from `each_wheel`, gears and rotors of the others from `each_joint`. A wheel that has no
/// radius then is told.
void complete_wheels(RobotFile& file, Diagnostics& diagnostics);

/// That of `each_joint`, for a joint that turns no wheel and has no effort in the URDF. A torque is for
/// joints that turn, a force for those that slide. nullptr where it is not for this joint.
const ValueText* effort_of_each_joint(const RobotFile& file, const UrdfJoint& joint,
                                      const Dimension& expected);

/// `kind: mecanum` as an angle of each wheel's rollers, from where it stands.
void place_rollers(RobotFile& file, const Urdf& urdf);

}  // namespace zwang::lang
