/// The entry `feels` of a robot file: what tells a robot of the contacts that press on it.
#pragma once

#include "robot/robot_file.hpp"
#include "tree/node.hpp"

namespace zwang::lang {

Feels parse_feels(const Node& node, Diagnostics& diagnostics);
/// Checks `feels` against the drive of the same file and the frames of the model. Removes a wrong entry.
void check_feels(const RobotFile& file, const solver::Model& model, Diagnostics& diagnostics);
/// Chooses the virtual robot of a robot of `mass` [kg] that feels, for its drive. E631 where none will do,
/// W632 where it is slow in contact.
void lead_by_contact(Drive& drive, double mass, const Span& feels, Diagnostics& diagnostics);

}  // namespace zwang::lang
