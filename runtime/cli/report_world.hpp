/// What the page of a run draws: the robot, the scene, the regions and frames, the tasks, and the limits. All
/// of it is JSON text.
#pragma once

#include <string>

#include "zwang/lang/program.hpp"

namespace zwang::cli {

/// Lengths in m, angles in rad; a pose is {p: [x, y, z], r: its rotation by rows}.
std::string world_of(const lang::Program& program);

/// Each task, each way between two of them, and the task that the run starts in.
std::string graph_json(const lang::Program& program);

/// Each bound that a row of the program has: the column that it bounds, in which task, and where it is
/// written.
std::string bounds_of(const lang::Program& program);

}  // namespace zwang::cli
