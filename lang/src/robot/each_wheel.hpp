/// `each_wheel`: what every wheel with a motor is, where the wheel or its motor says nothing.
#pragma once

#include <optional>

#include "robot/robot_file.hpp"
#include "robot/urdf.hpp"

namespace zwang::lang {

EachWheel parse_each_wheel(const Node& node, Diagnostics& diagnostics);

/// Radii and motors from `each_wheel`. A wheel that has no radius then is told.
void complete_wheels(RobotFile& file, Diagnostics& diagnostics);

/// `kind: mecanum` as an angle of each wheel's rollers, from where it stands.
void place_rollers(RobotFile& file, const Urdf& urdf);

}  // namespace zwang::lang
