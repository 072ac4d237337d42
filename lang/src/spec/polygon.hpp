/// Outlines that an author draws: of regions and of footprints.
#pragma once

#include <cstddef>
#include <vector>

namespace zwang::lang {

/// Twice the area of the triangle a, b, c: on which side of a to b the third one lies. [m^2]
template <typename Point>
double side(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
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

}  // namespace zwang::lang
