/// The entry `pads` of a robot file: flat ends of arms.
#pragma once

#include "robot/robot_file.hpp"
#include "tree/node.hpp"

namespace zwang::lang {

/// `tool: [6 cm, 4 cm]`
PadText parse_pad(const Entry& entry, Diagnostics& diagnostics);
/// Against the frames of the model: a pad sits on a link that a motor moves, and is no wheel's.
void check_pads(const RobotFile& file, const solver::Model& model, Diagnostics& diagnostics);

}  // namespace zwang::lang
