// Which features of what moves and of the region face each other, and how near they are.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "schedule/in_plane.hpp"
#include "schedule/region_fence.hpp"
#include "zwang/lang/plane.hpp"

namespace zwang::runtime {

namespace {

using solver::Vector3;

constexpr double no_distance = std::numeric_limits<double>::infinity();
constexpr double no_direction = 1e-6;  // [m] between points that are one
constexpr double slack = 1e-6;         // [m] by which a circle is taken larger: more than it is rounded

/// The motion of `f` against `t`, in the axes of `t`: of a point at `arm` from the origin of `f`
///   v = linear + angular x arm.
solver::FrameMotion seen_from(const solver::FrameMotion& t, const solver::FrameMotion& f) {
  const solver::Matrix3 to_axes = t.pose.rotation.transpose();
  const Vector3 offset = f.pose.position - t.pose.position;
  return {{to_axes * f.pose.rotation, to_axes * offset},
          to_axes * (f.angular - t.angular),
          to_axes * (f.linear - t.linear - t.angular.cross(offset))};
}

/// How many features a stretch has: with the square root of all of them, a search looks at the fewest. To
/// pass over a stretch costs as much as some three features.
int stretch_of(std::size_t count) {
  constexpr int least = 8;
  return std::max(least, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))));
}

/// A circle around the points: about the middle of their box.
template <typename Stretch>
void put_circle(const std::vector<Eigen::Vector2d>& points, Stretch& stretch) {
  Eigen::Vector2d low = points.front(), high = points.front();
  for (const Eigen::Vector2d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  stretch.centre = 0.5 * (low + high);
  stretch.radius = 0.0;
  for (const Eigen::Vector2d& p : points)
    stretch.radius = std::max(stretch.radius, (p - stretch.centre).norm() + slack);
}

}  // namespace

/// An edge counts beyond its ends, too: its stretch holds it whole.
void RegionFence::list_stretches() {
  std::vector<Point> points;
  const int edge_count = static_cast<int>(edges_.size()), edge_step = stretch_of(edges_.size());
  for (int begin = 0; begin < edge_count; begin += edge_step) {
    Stretch stretch{.begin = begin, .end = std::min(begin + edge_step, edge_count)};
    points.clear();
    for (int e = begin; e < stretch.end; ++e) {
      const Side& edge = edges_[static_cast<std::size_t>(e)];
      points.push_back(edge.begin - edge.before * edge.along);
      points.push_back(edge.begin + (edge.length + edge.after) * edge.along);
    }
    put_circle(points, stretch);
    put_axis(stretch);
    edge_stretches_.push_back(stretch);
  }
  const int vertex_count = static_cast<int>(reflex_.size()), vertex_step = stretch_of(reflex_.size());
  for (int begin = 0; begin < vertex_count; begin += vertex_step) {
    Stretch stretch{.begin = begin, .end = std::min(begin + vertex_step, vertex_count)};
    points.clear();
    for (int v = begin; v < stretch.end; ++v)
      points.push_back(polygon_[static_cast<std::size_t>(reflex_[static_cast<std::size_t>(v)])]);
    put_circle(points, stretch);
    vertex_stretches_.push_back(stretch);
  }
}

/// The mean direction of the edges, both ways being one: of twice their angles.
void RegionFence::put_axis(Stretch& stretch) const {
  Point twice = Point::Zero();
  const std::span<const Side> edges(edges_.data() + stretch.begin, edges_.data() + stretch.end);
  for (const Side& edge : edges) {
    const Point& t = edge.along;
    twice += Point(t.x() * t.x() - t.y() * t.y(), 2.0 * t.x() * t.y());
  }
  const double angle = 0.5 * std::atan2(twice.y(), twice.x());
  stretch.axis = {std::cos(angle), std::sin(angle)};
  stretch.cosine = 1.0;
  for (const Side& edge : edges)
    stretch.cosine = std::min(stretch.cosine, std::abs(edge.along.dot(stretch.axis)));
  stretch.sine = std::sqrt(1.0 - stretch.cosine * stretch.cosine);
}

/// Whether each edge points at the place, `offset` from the stretch's centre, or away from it: then the place
/// is beside none. Let a be the angle between offset and axis, and s that of the largest spread. An edge's
/// end is less far along the edge than the place if
///   |offset| cos(a + s) > radius.
inline bool RegionFence::points_at(const Stretch& stretch, const Point& offset) noexcept {
  const double along = std::abs(offset.dot(stretch.axis));
  const double across = std::abs(offset.x() * stretch.axis.y() - offset.y() * stretch.axis.x());
  return along * stretch.cosine - across * stretch.sine > stretch.radius;
}

RegionFence::Moving RegionFence::seen(const solver::FrameMotion& f, const Vector3& point) const noexcept {
  const Vector3 arm = f.pose.rotation * point;
  const Vector3 place = f.pose.position + arm;
  return {flat(place), place.z(), flat(f.linear + f.angular.cross(arm))};
}

void RegionFence::update(const solver::FrameMotion& move, const solver::FrameMotion& in,
                         double margin) noexcept {
  margin_ = margin;
  to_world_ = in.pose.rotation;
  move_to_world_ = move.pose.rotation;
  const solver::FrameMotion move_seen = seen_from(in, move);
  double fastest_square = 0.0;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    corner_now_[i] = seen(move_seen, corners_[i]);
    fastest_square = std::max(fastest_square, corner_now_[i].velocity.squaredNorm());
  }
  fastest_ = std::sqrt(fastest_square);
  if (!sides_.empty() && !reflex_.empty()) in_seen_ = seen_from(move, in);
}

double RegionFence::distance_to(const Side& side, const Point& p) noexcept {
  const double along = std::clamp(side.along.dot(p - side.begin), 0.0, side.length);
  return (p - side.begin - along * side.along).norm();
}

/// As lang::plane::contains: a stretch below, above or behind the ray is not crossed.
bool RegionFence::contains(const Point& p) const noexcept {
  bool inside = false;
  for (const Stretch& s : edge_stretches_) {
    if (std::abs(p.y() - s.centre.y()) > s.radius || p.x() > s.centre.x() + s.radius) continue;
    for (int e = s.begin; e < s.end; ++e) {
      const auto i = static_cast<std::size_t>(e), next = i + 1 < polygon_.size() ? i + 1 : 0;
      if (lang::plane::is_crossed(polygon_[next], polygon_[i], p)) inside = !inside;
    }
  }
  return inside;
}

int RegionFence::nearest_edge(const Point& p) const noexcept {
  int nearest = -1;
  double least = no_distance;
  for (const Stretch& s : edge_stretches_) {
    if ((p - s.centre).norm() - s.radius > least) continue;
    for (int e = s.begin; e < s.end; ++e) {
      const double distance = distance_to(edges_[static_cast<std::size_t>(e)], p);
      if (!(distance < least)) continue;
      least = distance;
      nearest = e;
    }
  }
  return nearest;
}

inline RegionFence::Approach RegionFence::of_edge(const Moving& corner, const Side& edge) const noexcept {
  return {edge.left.dot(corner.place - edge.begin) - margin_, -edge.left.dot(corner.velocity)};
}

inline RegionFence::Approach RegionFence::of_vertex(const Moving& corner,
                                                    const Point& vertex) const noexcept {
  const Point offset = corner.place - vertex;
  const double d = offset.norm();
  if (d > no_direction) return {d - margin_, -(offset.dot(corner.velocity) / d)};
  return {no_distance, 0.0};
}

inline RegionFence::Approach RegionFence::of_side(const Moving& vertex, const Side& side) const noexcept {
  return {-side.left.dot(vertex.place - side.begin) - margin_, side.left.dot(vertex.velocity)};
}

RegionFence::Approach RegionFence::of_circle(const Moving& corner) const noexcept {
  const Point offset = corner.place - centre();
  const double d = offset.norm();
  if (d > no_direction) return {region_.radius - margin_ - d, offset.dot(corner.velocity) / d};
  return {no_distance, 0.0};
}

inline void RegionFence::note(std::size_t pair, const Approach& approach, double reach) noexcept {
  if (approach.left > reach) return;
  approaches_[pair] = approach;
  facing_.push_back(pair);
}

/// In the order of `pairs_`. A corner outside the region is led back across the nearest edge alone.
void RegionFence::find_facing(double edge_reach, double vertex_reach) noexcept {
  facing_.clear();
  std::size_t first = 0;
  for (const Moving& corner : corner_now_) {
    if (region_.radius > 0.0) note(first++, of_circle(corner), edge_reach);
    if (!polygon_.empty() && !contains(corner.place)) {
      const int nearest = nearest_edge(corner.place);
      const auto edge = static_cast<std::size_t>(std::max(nearest, 0));
      if (nearest >= 0) note(first + edge, of_edge(corner, edges_[edge]), edge_reach);
    } else {
      find_facing_edges(first, corner, edge_reach);
      find_facing_vertices(first + edges_.size(), corner, vertex_reach);
    }
    first += edges_.size() + reflex_.size();
  }
  if (!sides_.empty()) find_facing_sides(vertex_reach);
}

/// Edges beside the corner, which is inside the region.
void RegionFence::find_facing_edges(std::size_t first, const Moving& corner, double reach) noexcept {
  for (const Stretch& s : edge_stretches_) {
    const Point to_corner = corner.place - s.centre;
    if (to_corner.norm() > s.radius + reach + margin_ || points_at(s, to_corner)) continue;
    for (int e = s.begin; e < s.end; ++e) {
      const Side& edge = edges_[static_cast<std::size_t>(e)];
      const Point offset = corner.place - edge.begin;
      const double along = edge.along.dot(offset);
      const bool is_beside = along >= -edge.before && along <= edge.length + edge.after;
      if (is_beside && edge.left.dot(offset) >= 0.0)
        note(first + static_cast<std::size_t>(e), of_edge(corner, edge), reach);
    }
  }
}

/// Reflex vertices that are nearer than what lies beside them.
void RegionFence::find_facing_vertices(std::size_t first, const Moving& corner, double reach) noexcept {
  for (const Stretch& s : vertex_stretches_) {
    if ((corner.place - s.centre).norm() > s.radius + reach + margin_) continue;
    for (int k = s.begin; k < s.end; ++k) {
      const auto v = static_cast<std::size_t>(reflex_[static_cast<std::size_t>(k)]);
      const Side& after = edges_[v];
      const Side& before = edges_[(v + edges_.size() - 1) % edges_.size()];
      const Point offset = corner.place - polygon_[v];
      if (after.along.dot(offset) < 0.0 && before.along.dot(offset) > 0.0)
        note(first + static_cast<std::size_t>(k), of_vertex(corner, polygon_[v]), reach);
    }
  }
}

/// Sides of the footprint beside a reflex vertex. A vertex inside the footprint is left by the nearest side.
void RegionFence::find_facing_sides(double reach) noexcept {
  const std::size_t first = pairs_.size() - reflex_.size() * sides_.size();
  for (const Stretch& s : vertex_stretches_) {
    const Point centre = flat(in_seen_.pose.position + in_seen_.pose.rotation * high(s.centre));
    if (centre.norm() > s.radius + reach_ + reach + margin_) continue;
    for (auto k = static_cast<std::size_t>(s.begin); k < static_cast<std::size_t>(s.end); ++k) {
      vertex_now_[k] = seen(in_seen_, high(polygon_[static_cast<std::size_t>(reflex_[k])]));
      const Point& place = vertex_now_[k].place;
      const std::size_t pair = first + k * sides_.size();
      if (lang::plane::contains(outline_, place)) {
        const auto nearest = std::ranges::min_element(
            sides_, {}, [&place](const Side& side) { return distance_to(side, place); });
        note(pair + static_cast<std::size_t>(nearest - sides_.begin()), of_side(vertex_now_[k], *nearest),
             reach);
        continue;
      }
      for (std::size_t side = 0; side < sides_.size(); ++side) {
        const Point offset = place - sides_[side].begin;
        const double along = sides_[side].along.dot(offset);
        const bool is_beside = along >= 0.0 && along <= sides_[side].length;
        if (is_beside && sides_[side].left.dot(offset) <= 0.0)
          note(pair + side, of_side(vertex_now_[k], sides_[side]), reach);
      }
    }
  }
}

}  // namespace zwang::runtime
