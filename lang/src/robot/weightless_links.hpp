/// Links that a URDF lets move, and gives no body.
#pragma once

#include <string>
#include <vector>

#include "robot/urdf.hpp"

namespace zwang::lang {

/// Links behind moving joints that have no mass, or no inertia about some axis through their centre of mass.
std::vector<std::string> without_inertia(const Urdf& urdf);

}  // namespace zwang::lang
