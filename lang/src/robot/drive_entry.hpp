/// The entry `drive` of a robot file: what the motors' drive takes.
#pragma once

#include "robot/robot_file.hpp"
#include "tree/node.hpp"

namespace zwang::lang {

Drive parse_drive(const Node& node, Diagnostics& diagnostics);
/// Against the motors of the same file.
void check_drive(const RobotFile& file, Diagnostics& diagnostics);
/// Against the wheels as they hang on the base.
void check_twist(const RobotFile& file, const solver::Model& model, Diagnostics& diagnostics);

}  // namespace zwang::lang
