/// How much room a region leaves.
#pragma once

#include <array>
#include <vector>

#include "zwang/solver/spatial.hpp"

namespace zwang::lang {

using Corners = std::vector<std::array<double, 2>>;

/// Whether some point of the polygon is farther than `margin` [m] from all of its edges. The polygon need not
/// be convex, and must not cross itself. True, too, where that is too close to call.
bool has_room(const Corners& polygon, double margin);
/// Whether it turns one way all around.
bool is_convex(const Corners& polygon);
/// Radius of a circle that fits into a convex outline, not always the widest one; 0 where it is not convex.
/// [m]
double circle_within(const std::vector<solver::Vector3>& outline);

}  // namespace zwang::lang
