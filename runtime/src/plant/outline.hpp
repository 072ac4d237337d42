/// Convex outlines in the plane, and the spheres that stand for their corners.
#pragma once

#include <vector>

#include "zwang/solver/spatial.hpp"

namespace zwang::runtime {

inline constexpr double corner_radius = 1e-6;  ///< [m]

/// A sphere tangent to both sides of a corner, from inside. Away from the polygon it presses in directions
/// between the normals of the two sides only.
struct Corner {
  solver::Vector3 centre;   ///< [m]
  double outward = 0.0;     ///< [rad] heading of the bisector of the two normals
  double half_angle = 0.0;  ///< [rad] between the bisector and a normal
};
std::vector<Corner> corners_of(const std::vector<solver::Vector3>& polygon);

/// In the plane, from a point to a convex polygon [m]; 0 inside.
double distance_to(const std::vector<solver::Vector3>& polygon, double x, double y) noexcept;

std::vector<solver::Vector3> rectangle(double half_x, double half_y);
bool is_rectangle(const std::vector<solver::Vector3>& polygon);

}  // namespace zwang::runtime
