#include "log/contact_place.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "zwang/lang/object_outline.hpp"

namespace zwang::runtime {

namespace {

using solver::Vector3;

constexpr double flush = 1e-3;  // [m] an edge that lies on another one touches with both of its ends

/// A corner of one outline beside an edge of the other one.
struct Approach {
  Vector3 at;       ///< on the edge
  Vector3 out;      ///< away from the object
  double distance;  ///< [m]
};

void add_approaches(const std::vector<Vector3>& corners, const std::vector<Vector3>& edges, double sign,
                    std::vector<Approach>& all) {
  for (const Vector3& corner : corners) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Vector3 along = edges[(i + 1) % edges.size()] - edges[i];
      const double share = along.dot(corner - edges[i]) / std::max(along.squaredNorm(), 1e-12);
      const Vector3 at = edges[i] + std::clamp(share, 0.0, 1.0) * along;
      // Counter-clockwise: the outside of an edge is on its right.
      all.push_back({at, sign * Vector3(along.y(), -along.x(), 0.0).normalized(), (corner - at).norm()});
    }
  }
}

}  // namespace

ContactPlace contact_place(const std::vector<Vector3>& robot, const std::vector<Vector3>& object) {
  std::vector<Approach> all;
  add_approaches(robot, object, 1.0, all);
  add_approaches(object, robot, -1.0, all);
  const auto best = std::ranges::min_element(all, {}, &Approach::distance);
  if (best == all.end()) return {};
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Approach& one : all) {
    if (one.distance > best->distance + flush) continue;
    low = low.cwiseMin(one.at);
    high = high.cwiseMax(one.at);
  }
  return {0.5 * (low + high), std::atan2(best->out.y(), best->out.x())};
}

std::vector<Vector3> touched_outline(const lang::SceneObject& object, double height) {
  if (object.shape != lang::ShapeKind::cylinder) {
    const std::vector<Vector3> cut = lang::outline_of(object, height);
    return cut.empty() ? lang::outline_of(object, 0.0) : cut;  // one that ends below it is met by an arm
  }
  // A round one that leans stands aside at this height: its upright axis u goes through height u / u_z.
  const Vector3 upright = lang::lean_of(object).col(2);
  const Vector3 aside = Vector3(upright.x(), upright.y(), 0.0) * (height / upright.z());
  constexpr int corners_of_a_round = 24;
  std::vector<Vector3> corners;
  for (int i = 0; i < corners_of_a_round; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners_of_a_round;
    corners.push_back(aside + object.size[0] * Vector3(std::cos(angle), std::sin(angle), 0.0));
  }
  return corners;
}

}  // namespace zwang::runtime
