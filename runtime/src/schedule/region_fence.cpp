#include "schedule/region_fence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "schedule/edge_braking.hpp"
#include "schedule/in_plane.hpp"
#include "zwang/lang/plane.hpp"

namespace zwang::runtime {

namespace {

using solver::Vector3;

constexpr double far = std::numeric_limits<double>::infinity();
// Beyond a corner that the region does not turn around, both edges hold already: none may come as a surprise.
constexpr double look_ahead = 1.0;  // [m]
// Between normals of edges that do not share a vertex; beyond it they face each other, like two walls of a
// corridor.
constexpr double facing_cosine = -0.866;  // of 150 deg
constexpr double turn_step = 0.26;  // [rad] of 15 deg, in which braking on the way of a turn is looked at
constexpr double quarter_turn = 1.5708;  // [rad]

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

std::vector<RegionFence::Side> RegionFence::sides_of(const std::vector<Point>& polygon) {
  std::vector<Side> sides;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n; ++i) {
    Side side;
    side.begin = polygon[i];
    side.along = polygon[(i + 1) % n] - polygon[i];
    side.length = side.along.norm();
    side.along /= side.length;
    side.left = {-side.along.y(), side.along.x()};
    sides.push_back(side);
  }
  return sides;
}

RegionFence::RegionFence(const lang::Region& region, std::vector<Vector3> corners)
    : region_(region), corners_(std::move(corners)) {
  for (const auto& p : region.polygon) polygon_.emplace_back(p[0], p[1]);
  for (const Vector3& c : corners_) outline_.push_back(flat(c));
  for (const Point& corner : outline_) reach_ = std::max(reach_, corner.norm());
  edges_ = sides_of(polygon_);
  if (outline_.size() > 2) sides_ = sides_of(outline_);
  const std::size_t n = edges_.size();
  for (std::size_t i = 0; i < n; ++i) {
    Side& edge = edges_[i];
    Side& last = edges_[(i + n - 1) % n];
    if (turn(last.along, edge.along) < 0.0) {
      reflex_.push_back(static_cast<int>(i));
    } else {
      edge.before = std::min(look_ahead, last.length);
      last.after = std::min(look_ahead, edge.length);
    }
  }
  list_pairs();
  find_meeting();
  list_stretches();
  corner_now_.resize(corners_.size());
  vertex_now_.resize(reflex_.size());
  approaches_.resize(pairs_.size());
  facing_.reserve(pairs_.size());
}

void RegionFence::list_pairs() {
  for (int c = 0; c < static_cast<int>(corners_.size()); ++c) {
    if (region_.radius > 0.0) pairs_.push_back({PairKind::corner_circle, c, 0});
    for (int e = 0; e < static_cast<int>(edges_.size()); ++e) pairs_.push_back({PairKind::corner_edge, c, e});
    for (int v = 0; v < static_cast<int>(reflex_.size()); ++v) {
      pairs_.push_back({PairKind::corner_vertex, c, v});
    }
  }
  for (int v = 0; v < static_cast<int>(reflex_.size()); ++v) {
    for (int s = 0; s < static_cast<int>(sides_.size()); ++s) {
      pairs_.push_back({PairKind::vertex_side, v, s});
    }
  }
}

/// Two edges bind together at a vertex that they share, or where what moves is between them.
void RegionFence::find_meeting() {
  const std::size_t n = edges_.size();
  const double near = 2.0 * reach_ + look_ahead;
  const auto gap = [&](const Side& side, const Point& p) {
    return (p - side.begin - std::clamp(side.along.dot(p - side.begin), 0.0, side.length) * side.along)
        .norm();
  };
  meeting_.resize(n);
  over_quarter_turn_.resize(n, far);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const Side &a = edges_[i], &b = edges_[j];
      const double cosine = a.left.dot(b.left);
      const bool adjacent = j == (i + 1) % n || i == (j + 1) % n;
      const bool reflex =
          adjacent && turn(j == (i + 1) % n ? a.along : b.along, j == (i + 1) % n ? b.along : a.along) < 0.0;
      if (i == j || reflex || (!adjacent && cosine < facing_cosine)) continue;
      const double distance = std::min({gap(a, b.begin), gap(a, b.begin + b.length * b.along),
                                        gap(b, a.begin), gap(b, a.begin + a.length * a.along)});
      if (distance > near) continue;
      meeting_[i].push_back(j);
      least_cosine_ = std::min(least_cosine_, std::sqrt(std::max(0.0, 0.5 * (1.0 + cosine))));
    }
  }
  // Of a circle: towards its centre, from where a corner is that touches it.
  if (region_.radius > 0.0) {
    const double sine = std::min(1.0, reach_ / region_.radius);
    least_cosine_ = std::sqrt(1.0 - sine * sine);
  }
}

/// A share is at least r cos(theta/2) / |b|, with r = min(b_x, b_y). A disc of that radius is in the box, and
/// no edge alone brakes with more than the box's corner has.
double RegionFence::weakest_braking(const Point& box) const noexcept {
  const double r = box.minCoeff();
  constexpr double least = 1e-3;  // [m/s^2]
  const double a =
      region_.radius > 0.0 || least_cosine_ == 1.0 ? r * least_cosine_ : r * r * least_cosine_ / box.norm();
  return std::max(a, least);
}

/// A disc of the radius min(b_x, b_y) is in the box, so every direction has that. Rounding may take a part of
/// 1e-15 of it.
double RegionFence::least_alone(const Point& box) noexcept {
  constexpr double rounding = 1.0 - 1e-12;
  return rounding * box.minCoeff();
}

double RegionFence::edge_braking(std::size_t edge, const solver::Matrix3& to_base, const Point& box,
                                 double turning) noexcept {
  const double time_to_stop = fastest_ / (solver::braking_share * weakest_braking(box));
  const double arc = std::clamp(turning * time_to_stop, -quarter_turn, quarter_turn);
  if (std::abs(arc) == quarter_turn) return braking_at_any_heading(edge, box);
  return least_braking(edge, (to_base * to_world_).topLeftCorner<2, 2>(), arc, box);
}

/// A quarter turn meets every place of an edge in the box, wherever it begins: worked out anew only for
/// another box.
double RegionFence::braking_at_any_heading(std::size_t edge, const Point& box) noexcept {
  if (box != quarter_turn_box_) {
    std::ranges::fill(over_quarter_turn_, far);
    quarter_turn_box_ = box;
  }
  double& least = over_quarter_turn_[edge];
  if (least == far) least = least_braking(edge, Eigen::Matrix2d::Identity(), quarter_turn, box);
  return least;
}

/// While the axes of the region, seen in the base, turn back by `arc`.
double RegionFence::least_braking(std::size_t edge, const Eigen::Matrix2d& in_base, double arc,
                                  const Point& box) const noexcept {
  const int steps = static_cast<int>(std::ceil(std::abs(arc) / turn_step));
  Eigen::Matrix2d turned = in_base, step = Eigen::Matrix2d::Identity();
  if (steps > 0) step = Eigen::Rotation2Dd(-arc / steps).toRotationMatrix();
  double least = far;
  for (int k = 0; k <= steps; ++k) {
    const Point n = turned * edges_[edge].left;
    double share = 1.0;
    for (const std::size_t other : meeting_[edge]) {
      share = std::min(share, share_of_two(n, turned * edges_[other].left, box));
    }
    least = std::min(least, share * braking_alone(n, box));
    turned = step * turned;
  }
  return least;
}

double RegionFence::braking(std::size_t index, const solver::Matrix3& to_base, const Point& box,
                            double turning) noexcept {
  const Pair& pair = pairs_[index];
  if (pair.kind == PairKind::corner_edge)
    return edge_braking(static_cast<std::size_t>(pair.second), to_base, box, turning);
  if (pair.kind == PairKind::corner_circle && corners_.size() > 1) return weakest_braking(box);
  return braking_alone(flat(to_base * normal(index)), box);
}

Vector3 RegionFence::normal(std::size_t index) const noexcept {
  const Pair& pair = pairs_[index];
  const auto first = static_cast<std::size_t>(pair.first);
  const auto second = static_cast<std::size_t>(pair.second);
  switch (pair.kind) {
    case PairKind::corner_edge:
      return to_world_ * high(edges_[second].left);
    case PairKind::corner_vertex: {
      const Point offset = corner_now_[first].place - polygon_[static_cast<std::size_t>(reflex_[second])];
      return to_world_ * high(offset / offset.norm());
    }
    case PairKind::vertex_side:
      return move_to_world_ * high(sides_[second].left);
    case PairKind::corner_circle:
      break;
  }
  const Point offset = corner_now_[first].place - centre();
  return to_world_ * high(-offset / offset.norm());
}

}  // namespace zwang::runtime
