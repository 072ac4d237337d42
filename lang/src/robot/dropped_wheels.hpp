/// Wheels that stand lower than the URDF draws them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "robot/robot_file.hpp"
#include "robot/urdf.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

/// Moves the axle of each wheel with a `drop` down by it.
void drop_wheels(const RobotFile& file, Urdf& urdf);

/// Nobody knows their radius, and they are drawn by one mesh.
bool share_mesh(const std::vector<DraftWheel>& wheels);

/// [m] By its joint, how much lower than drawn each wheel stands if all end where the lowest one does. Empty:
/// they end on one level, or one ends higher than its own radius. Wheels that share a mesh have one radius.
std::map<std::string, double> drops_of(const std::vector<DraftWheel>& wheels);

}  // namespace zwang::lang
