#include "outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zwang::runtime {

using solver::Vector3;

namespace {

double cross2(const Vector3& o, const Vector3& a, const Vector3& b) {
  return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
}

}  // namespace

// Monotone chain.
std::vector<Vector3> convex_hull(std::vector<Vector3> points) {
  for (Vector3& p : points) p.z() = 0.0;
  const auto before = [](const Vector3& a, const Vector3& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {};
  std::vector<Vector3> hull;
  const auto extend = [&hull](const Vector3& p, std::size_t kept) {
    while (hull.size() >= kept + 2 && cross2(hull[hull.size() - 2], hull.back(), p) <= 1e-12) hull.pop_back();
    hull.push_back(p);
  };
  for (const Vector3& p : points) extend(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) extend(*p, lower);
  hull.pop_back();
  if (hull.size() < 3) hull.clear();
  return hull;
}

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
  const Eigen::Vector2d point(x, y);
  double nearest = std::numeric_limits<double>::infinity();
  bool is_inside = !polygon.empty();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d from = polygon[i].head<2>(),
                          side = polygon[(i + 1) % polygon.size()].head<2>() - from;
    const Eigen::Vector2d away = point - from;
    // Counter-clockwise: what is inside lies to the left of every side.
    is_inside = is_inside && side.x() * away.y() - side.y() * away.x() >= 0.0;
    const double along = std::clamp(side.dot(away) / side.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (away - along * side).norm());
  }
  return is_inside || polygon.empty() ? 0.0 : nearest;
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
