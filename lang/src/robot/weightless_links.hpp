/// Links that a URDF lets move, and gives no body.
#pragma once

#include <string>
#include <vector>

#include "robot/urdf.hpp"

namespace zwang::lang {

/// Links behind moving joints that have no mass, or no inertia about some axis through their centre of mass.
std::vector<std::string> without_inertia(const Urdf& urdf);

/// The `open` links as balls of 5 cm, of 0.1 kg where they have no mass.
Urdf completed(Urdf urdf, const std::vector<std::string>& open);

}  // namespace zwang::lang
