// A driver of position goes from its start s0 to its target p without overshoot:
//
//   path of the point         <= sum over the axes of |p - s0|
//   turn                      <= |p - s0|, the shorter way around
//
// Encoders and contacts shake the base a little, and both measures add up: a quarter, 5 cm and 5 deg are
// left.
//
// Along a path the frame goes ds = v / (1 - k y), with k the curvature and y the offset to the left. Within
// b of the least radius ds is at most v / (1 - b).
#include "physics/driven_way.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "path/place_on_path.hpp"

namespace zwang::lang {

namespace {

constexpr double shaken = 1.25, shaken_by = 0.05, turned_by = 5.0 / 180.0 * std::numbers::pi;

bool is_exact(const PlannedAxis& axis) {
  return !axis.is_feature() && axis.is_placed && !axis.is_set && !axis.is_on_path && !axis.is_soft &&
         !axis.is_spring && !axis.is_yield && axis.target.has_value();
}

/// The way that the driver adds; nullopt where nobody knows it.
std::optional<double> way_of_driver(const PlannedAxis& axis, const Probe& probe) {
  if (!is_exact(axis)) return std::nullopt;
  if (axis.stands_still()) return 0.0;
  if (axis.driver != solver::Quantity::position || !axis.in_world) return std::nullopt;
  double way = *axis.target - probe.position_at_start(axis);
  if (axis.turns()) way = std::remainder(way, 2.0 * std::numbers::pi);
  return std::abs(way);
}

struct Ways {
  DrivenWay moved, turned;
  int planar = 0, turning = 0;  ///< drivers
};

std::optional<Ways> ways_of(const PlannedTask& plan, const solver::AttachedFrame* point, const Probe& probe) {
  Ways ways;
  double longest = 0.0;
  for (const PlannedAxis& axis : plan.axes) {
    if (!axis.driver || axis.move.body != 0) continue;
    const std::optional<double> way = way_of_driver(axis, probe);
    if (!way) return std::nullopt;
    if (axis.turns()) {
      ++ways.turning;
      ways.turned.most += *way;
      if (*way > 0.0) ways.turned.by = &axis;
      continue;
    }
    if (point != nullptr && (axis.move.pose.position - point->pose.position).norm() > 1e-6)
      return std::nullopt;
    ++ways.planar;
    ways.moved.most += *way;
    if (*way > longest) ways.moved.by = &axis;
    longest = std::max(longest, *way);
  }
  return ways;
}

}  // namespace

std::optional<DrivenWay> way_to_places(const PlannedTask& plan, const solver::AttachedFrame& point,
                                       Probe& probe) {
  if (point.body != 0 || probe.base_mobility() < 3) return std::nullopt;
  std::optional<Ways> ways = ways_of(plan, &point, probe);
  // A base that stands waits for somebody who pushes.
  if (!ways || ways->planar != 2 || ways->moved.by == nullptr) return std::nullopt;
  ways->moved.most = shaken * ways->moved.most + shaken_by;
  return ways->moved;
}

std::optional<DrivenWay> turn_to_places(const PlannedTask& plan, Probe& probe) {
  std::optional<Ways> ways = ways_of(plan, nullptr, probe);
  if (!ways || ways->turning != 1 || ways->turned.by == nullptr) return std::nullopt;
  ways->turned.most = shaken * ways->turned.most + turned_by;
  return ways->turned;
}

std::optional<double> start_along_path(const CheckContext& context, const PlannedTask& plan,
                                       const PlannedAxis& axis, const Probe& probe) {
  const Path* path = path_of(context, axis);
  if (path == nullptr || axis.axis != solver::Axis::x || !axis.is_placed || axis.is_set ||
      axis.move.body != 0)
    return std::nullopt;
  const double most_offset = beside_path * path->least_radius();
  const bool is_kept = std::any_of(plan.axes.begin(), plan.axes.end(), [&](const PlannedAxis& other) {
    return other.axis == solver::Axis::y && other.in_name == axis.in_name &&
           other.move_name == axis.move_name && other.driver == solver::Quantity::position && other.target &&
           std::abs(*other.target) <= most_offset;
  });
  if (!is_kept) return std::nullopt;
  PlannedAxis at = axis;
  const double x = probe.position_at_start(at);
  at.axis = solver::Axis::y;
  const double y = probe.position_at_start(at);
  // Outside of a fillet a way passes no more of it than its own length.
  const PlaceOnPath place = place_on(*path, x, y);
  const bool is_near = std::abs(place.offset) <= most_offset ||
                       (place.share > 1.0 && std::abs(place.offset) <= 0.5 * path->least_radius());
  return is_near ? std::optional(place.along) : std::nullopt;
}

}  // namespace zwang::lang
