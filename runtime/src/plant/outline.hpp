/// Convex outlines in the plane, and the spheres that stand for their corners.
#pragma once

#include <vector>

#include "zwang/solver/spatial.hpp"

namespace zwang::runtime {

inline constexpr double corner_radius = 1e-6;  ///< [m]

/// Counter-clockwise, without points on straight stretches; empty for less than a triangle.
std::vector<solver::Vector3> convex_hull(std::vector<solver::Vector3> points);

/// Centres of spheres tangent to both sides of each corner of a convex polygon, from inside.
std::vector<solver::Vector3> corner_centres(const std::vector<solver::Vector3>& polygon);

std::vector<solver::Vector3> rectangle(double half_x, double half_y);
bool is_rectangle(const std::vector<solver::Vector3>& polygon);

}  // namespace zwang::runtime
