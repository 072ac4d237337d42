#include "outline.hpp"

#include <algorithm>
#include <cmath>

#include "zwang/lang/plane.hpp"

namespace zwang::runtime {

using solver::Vector3;

std::vector<Corner> corners_of(const std::vector<Vector3>& polygon) {
  std::vector<Corner> corners;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3 to_next = (polygon[(i + 1) % n] - polygon[i]).normalized();
    const Vector3 to_last = (polygon[(i + n - 1) % n] - polygon[i]).normalized();
    const Vector3 inward = (to_next + to_last).normalized();
    const double half_angle_sine = std::abs(to_next.cross(inward).z());
    corners.push_back({polygon[i] + corner_radius / half_angle_sine * inward,
                       std::atan2(-inward.y(), -inward.x()), std::acos(std::min(1.0, half_angle_sine))});
  }
  return corners;
}

double distance_to(const std::vector<Vector3>& polygon, double x, double y) noexcept {
  const Vector3 point(x, y, 0.0);
  const bool is_outside = !polygon.empty() && !lang::plane::contains(polygon, point);
  return is_outside ? lang::plane::distance_to_edges(polygon, point) : 0.0;
}

std::vector<Vector3> rectangle(double half_x, double half_y) {
  return {{-half_x, -half_y, 0.0}, {half_x, -half_y, 0.0}, {half_x, half_y, 0.0}, {-half_x, half_y, 0.0}};
}

bool is_rectangle(const std::vector<Vector3>& p) {
  if (p.size() != 4) return false;
  const Vector3 side = p[1] - p[0];
  const Vector3 next = p[2] - p[1];
  return (p[0] + p[2] - p[1] - p[3]).norm() < 1e-9 &&
         std::abs(side.dot(next)) < 1e-9 * side.norm() * next.norm();
}

}  // namespace zwang::runtime
