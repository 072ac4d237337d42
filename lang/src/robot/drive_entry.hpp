/// The entry `drive` of a robot file: what the motors' drive takes.
#pragma once

#include "robot/robot_file.hpp"
#include "tree/node.hpp"

namespace zwang::lang {

Drive parse_drive(const Node& node, Diagnostics& diagnostics);
/// Against the motors of the same file.
void check_drive(const RobotFile& file, Diagnostics& diagnostics);

}  // namespace zwang::lang
