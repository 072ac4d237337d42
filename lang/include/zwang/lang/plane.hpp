/// Polygons in the plane. Of a point [0] and [1] count, its x and y [m], and nothing else.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace zwang::lang::plane {

/// Twice the area of the triangle a, b, c: above 0 where c lies to the left of a to b. [m^2]
template <typename Point>
double side(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Above 0 where the corners go counter-clockwise. [m^2]
template <typename Point>
double signed_area(const std::vector<Point>& corners) {
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& next = corners[(i + 1) % corners.size()];
    area += 0.5 * (corners[i][0] * next[1] - next[0] * corners[i][1]);
  }
  return area;
}

/// From p to the nearest point between a and b. [m]
template <typename Point>
double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const double dx = b[0] - a[0], dy = b[1] - a[1];
  const double square = std::max(dx * dx + dy * dy, 1e-18);
  const double along = std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square, 0.0, 1.0);
  return std::hypot(p[0] - a[0] - along * dx, p[1] - a[1] - along * dy);
}

/// From p to the nearest edge. [m]
template <typename Point>
double distance_to_edges(const std::vector<Point>& polygon, const Point& p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
    least = std::min(least, distance_to_segment(p, polygon[j], polygon[i]));
  return least;
}

/// Whether a ray from p along x crosses the edge between a and b.
template <typename Point>
bool is_crossed(const Point& a, const Point& b, const Point& p) {
  if ((a[1] > p[1]) == (b[1] > p[1])) return false;
  return p[0] < a[0] + (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1]);
}

/// Whether p lies inside: a ray from it crosses the edges an odd number of times. Hollows are allowed.
template <typename Point>
bool contains(const std::vector<Point>& polygon, const Point& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    if (is_crossed(polygon[i], polygon[j], p)) inside = !inside;
  }
  return inside;
}

/// Whether two edges that share no corner have a point of their insides in common.
template <typename Point>
bool crosses_itself(const std::vector<Point>& corners) {
  const std::size_t n = corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point& a = corners[i];
    const Point& b = corners[(i + 1) % n];
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n == i) continue;
      const Point& c = corners[j];
      const Point& d = corners[(j + 1) % n];
      if (side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0) return true;
    }
  }
  return false;
}

/// Counter-clockwise, without points on straight stretches; empty for less than a triangle. A corner is
/// straight if its triangle has at most half of `flat` [m^2].
template <typename Point>
std::vector<Point> convex_hull(std::vector<Point> points, double flat = 1e-12) {
  // Monotone chain.
  const auto is_same = [](const Point& a, const Point& b) { return a[0] == b[0] && a[1] == b[1]; };
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]); });
  points.erase(std::unique(points.begin(), points.end(), is_same), points.end());
  if (points.size() < 3) return {};
  std::vector<Point> hull;
  const auto extend = [&hull, flat](const Point& p, std::size_t kept) {
    while (hull.size() >= kept + 2 && side(hull[hull.size() - 2], hull.back(), p) <= flat) hull.pop_back();
    hull.push_back(p);
  };
  for (const Point& p : points) extend(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) extend(*p, lower);
  hull.pop_back();
  if (hull.size() < 3) hull.clear();
  return hull;
}

}  // namespace zwang::lang::plane
