// How an outline comes to rest on a wall that it is pushed to.
//
// The wall touches the foremost corner p and presses along -x. The motors push through the outline's origin.
// The moment of the wall about the origin turns the base:
//
//   N (|p_y| - mu p_x) > M     wheels hold the base sideways
//   N |p_y - mu p_x sgn t| > M  it slides
//
// mu: the wall's friction. M: what holds the heading. If wheels hold the base sideways, the corner slides as
// the base turns, and the friction is against either turn. Else the push drives the base sideways, to the
// side of its yaw t. The friction acts to the other side, and turns the base square. The base turns until M
// is more, or until an edge lies on the wall. The edge's ends lie on both sides of the origin then.
#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "zwang/lang/task_draft.hpp"

namespace zwang::lang {

std::optional<double> resting_yaw(const std::vector<Eigen::Vector2d>& outline, double yaw,
                                  const WallGrip& grip) {
  const std::size_t count = outline.size();
  const auto turned = [&](std::size_t i, double by) -> Eigen::Vector2d {
    return Eigen::Rotation2Dd(by) * outline[i % count];
  };
  double angle = yaw;
  for (std::size_t step = 0; step < count && std::abs(angle - yaw) < std::numbers::pi / 2.0; ++step) {
    std::size_t foremost = 0;
    for (std::size_t i = 1; i < count; ++i) {
      if (turned(i, angle).x() > turned(foremost, angle).x()) foremost = i;
    }
    const Eigen::Vector2d corner = turned(foremost, angle);
    const double rub = grip.friction * corner.x();
    const double side = grip.slides ? corner.y() - std::copysign(rub, angle) : corner.y();
    if (std::abs(side) < (grip.slides ? 0.0 : rub) + grip.lever) return angle;
    // To the left of the origin the base turns left, and its edge to the right comes to the wall; and vice
    // versa.
    const std::size_t next = side > 0.0 ? foremost + count - 1 : foremost + 1;
    const Eigen::Vector2d edge = turned(next, angle) - corner;
    // By which the edge must turn to lie along the wall.
    angle += side > 0.0 ? std::atan2(-edge.x(), -edge.y()) : -std::atan2(-edge.x(), edge.y());
    if (turned(foremost, angle).y() * turned(next, angle).y() <= 0.0) return angle;
    angle += side > 0.0 ? 1e-9 : -1e-9;  // off the edge, on to its other corner
  }
  return std::nullopt;
}

}  // namespace zwang::lang
