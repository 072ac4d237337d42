/// Which of the wheels found have a motor, which follow, and what steers.
#pragma once

#include "robot/wheel_search.hpp"

namespace zwang::lang {

/// Parts `found.wheels`, which holds all wheels, into those with a motor, those without that hold, casters,
/// and stiff casters, which count as balls.
void assign_roles(const Urdf& urdf, FoundWheels& found);

}  // namespace zwang::lang
