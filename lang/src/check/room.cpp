// The point deepest inside of a polygon, looked for by halving squares. Of a square with half side h around c
// no point lies deeper than
//
//   depth(c) + sqrt(2) h        depth: signed distance to the edges, above 0 inside
#include "check/room.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "zwang/lang/plane.hpp"

namespace zwang::lang {

namespace {

/// Of a square from an edge, in one question: a file may be hostile.
constexpr std::size_t most_distances = 50000;

double depth_of(const Corners& polygon, double x, double y) {
  const std::array<double, 2> p{x, y};
  const double nearest = plane::distance_to_edges(polygon, p);
  return plane::contains(polygon, p) ? nearest : -nearest;
}

}  // namespace

bool has_room(const Corners& polygon, double margin) {
  if (polygon.size() < 3) return true;
  std::array<double, 2> low = polygon[0], high = polygon[0];
  for (const auto& p : polygon) {
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  struct Square {
    double x, y, h;
  };
  std::deque<Square> open{{0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]),
                           0.5 * std::max(high[0] - low[0], high[1] - low[1])}};
  for (std::size_t looked = 0; !open.empty(); looked += polygon.size()) {
    if (looked > most_distances) return true;
    const Square s = open.front();
    open.pop_front();
    const double depth = depth_of(polygon, s.x, s.y);
    if (depth > margin) return true;
    if (depth + std::sqrt(2.0) * s.h <= margin) continue;
    const double h = 0.5 * s.h;
    for (const double x : {s.x - h, s.x + h}) {
      for (const double y : {s.y - h, s.y + h}) open.push_back({x, y, h});
    }
  }
  return false;
}

bool is_convex(const Corners& polygon) {
  bool turns_left = false, turns_right = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const double turn =
        plane::side(polygon[i], polygon[(i + 1) % polygon.size()], polygon[(i + 2) % polygon.size()]);
    turns_left = turns_left || turn > 1e-9;
    turns_right = turns_right || turn < -1e-9;
  }
  return !(turns_left && turns_right);
}

double circle_within(const std::vector<solver::Vector3>& outline) {
  if (outline.size() < 3) return 0.0;
  Corners corners;
  std::array<double, 2> middle{};
  for (const solver::Vector3& p : outline) {
    corners.push_back({p.x(), p.y()});
    middle[0] += p.x() / static_cast<double>(outline.size());
    middle[1] += p.y() / static_cast<double>(outline.size());
  }
  return is_convex(corners) ? std::max(0.0, depth_of(corners, middle[0], middle[1])) : 0.0;
}

}  // namespace zwang::lang
