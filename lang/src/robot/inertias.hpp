/// `inertias`: bodies for links to which the URDF gives none, or one that cannot be.
#pragma once

#include "robot/robot_file.hpp"
#include "robot/urdf.hpp"

namespace zwang::lang {

InertiaText parse_inertia(const Entry& entry, Diagnostics& diagnostics);

/// A wheel's link becomes a solid disc about its axle, with its centre of mass on it. Another link becomes a
/// solid ball about its own centre of mass, or about `at`.
void apply_inertias(const RobotFile& file, Urdf& urdf, Diagnostics& diagnostics);

}  // namespace zwang::lang
