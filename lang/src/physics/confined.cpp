// Of a region only its convex hull counts, so that a position that is left out is left out for certain. A
// footprint inside holds a circle about each of its points, with the radius r to its nearest edge. So the
// point stays r away from the region's edges.
#include "physics/confined.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "zwang/lang/plane.hpp"

namespace zwang::lang {

namespace {

using solver::Vector3;

std::optional<Confinement> confinement_of(const CheckContext& context, const GroupText& group,
                                          bool in_always) {
  const std::optional<int> index =
      group.kind == GroupKind::inside ? context.symbols.find_region(group.region.text) : std::nullopt;
  if (!index || group.is_incomplete) return std::nullopt;
  const RegionSymbol& symbol = context.symbols.regions[static_cast<std::size_t>(*index)];
  const Place parent = place_of(context, symbol.region.parent);
  if (symbol.is_bad || parent.frame.body >= 0 || !parent.is_known || parent.is_set) return std::nullopt;
  Confinement result;
  result.path = (in_always ? "always." : "") + group.name.text;
  result.span = group.name.span;
  result.moves_footprint = group.move.text == "footprint";
  if (!result.moves_footprint) {
    const std::optional<int> move = context.symbols.find_frame(group.move.text);
    if (!move || context.symbols.frames[static_cast<std::size_t>(*move)].is_bad) return std::nullopt;
    const Place place = place_of(context, *move);
    if (place.frame.body != 0 || !place.is_known || place.is_set) return std::nullopt;
    result.point = place.frame.pose.position;
  }
  for (const std::array<double, 2>& p : symbol.region.polygon)
    result.corners.push_back(parent.frame.pose * Vector3(p[0], p[1], 0.0));
  result.centre = parent.frame.pose * Vector3(symbol.region.centre[0], symbol.region.centre[1], 0.0);
  result.radius = symbol.region.radius;
  if (result.corners.empty() && !(result.radius > 0.0)) return std::nullopt;
  return result;
}

/// The only axis that is driven, ahead by one velocity or force, while the others are held; nullptr: there is
/// none such.
const PlannedAxis* driven_straight(const PlannedTask& plan, const Probe& probe) {
  const PlannedAxis* driven = nullptr;
  bool keeps_heading = false, is_held = probe.base_mobility() < 3;
  for (const PlannedAxis& axis : plan.axes) {
    if (!axis.driver || axis.move.body != 0) continue;
    if (axis.is_feature() || !axis.target || axis.is_soft || axis.is_spring) return nullptr;
    if (axis.turns()) {
      if (!axis.stands_still() && axis.driver != solver::Quantity::position) return nullptr;
      keeps_heading = true;
    } else if (axis.stands_still()) {
      is_held = true;
    } else {
      const bool pushes = axis.driver == solver::Quantity::force;
      if (driven != nullptr || (axis.driver != solver::Quantity::velocity && !pushes)) return nullptr;
      driven = &axis;
    }
  }
  return keeps_heading && is_held ? driven : nullptr;
}

/// Of what the base's origin may do. [m]
double width(const Confinement& confinement, const Robot& robot, const Vector3& along) {
  return farthest_along(confinement, along) + farthest_along(confinement, -along) +
         2.0 * std::max(0.0, most_outside(confinement, robot, Vector3::Zero()));
}

double largest_width(const Confinement& confinement, const Robot& robot) {
  constexpr int directions = 72;
  double most = 0.0;
  for (int i = 0; i < directions; ++i) {
    const double angle = std::numbers::pi * i / directions;
    most = std::max(most, width(confinement, robot, {std::cos(angle), std::sin(angle), 0.0}));
  }
  return most / std::cos(0.5 * std::numbers::pi / directions);
}

Vector3 place_at_start(const Probe& probe) {
  Vector3 place = Vector3::Zero();
  for (const solver::Axis axis : {solver::Axis::x, solver::Axis::y}) {
    PlannedAxis base;
    base.move = {0, {}, {}};
    base.in = {-1, {}, {}};
    base.in_world = true;
    base.axis = axis;
    place(static_cast<int>(axis)) = probe.position_at_start(base);
  }
  return place;
}

/// At the start, of the base's origin from the region's box. [m]
double away_at_start(const Confinement& confinement, const Vector3& at) {
  double most = 0.0;
  for (const Vector3& along : {Vector3(1, 0, 0), Vector3(-1, 0, 0), Vector3(0, 1, 0), Vector3(0, -1, 0)})
    most = std::max(most, at.dot(along) - farthest_along(confinement, along));
  return most;
}

/// Of the line through `at` along `along`, between the outermost edges that it meets. Infinite where it meets
/// none, or where the base's origin may leave the region. [m]
double chord(const Confinement& confinement, const Robot& robot, const Vector3& at, const Vector3& along) {
  if (most_outside(confinement, robot, Vector3::Zero()) > 1e-9) return solver::infinity;
  const Vector3 across(-along.y(), along.x(), 0.0);
  double low = solver::infinity, high = -solver::infinity;
  for (std::size_t i = 0; i < confinement.corners.size(); ++i) {
    const Vector3& a = confinement.corners[i];
    const Vector3& b = confinement.corners[(i + 1) % confinement.corners.size()];
    const double from = (a - at).dot(across), to = (b - at).dot(across);
    if ((from > 0.0) == (to > 0.0)) continue;
    const double t = (a + from / (from - to) * (b - a)).dot(along);
    low = std::min(low, t);
    high = std::max(high, t);
  }
  return high > low ? high - low : solver::infinity;
}

}  // namespace

std::vector<Confinement> confinements(const CheckContext& context, const PlannedTask& plan) {
  std::vector<Confinement> all;
  const auto add = [&](const std::vector<GroupText>& groups, bool in_always) {
    for (const GroupText& group : groups) {
      if (auto one = confinement_of(context, group, in_always)) all.push_back(std::move(*one));
    }
  };
  add(context.file.always_groups, true);
  if (plan.task != nullptr) add(plan.task->groups, false);
  return all;
}

double farthest_along(const Confinement& confinement, const Vector3& direction) {
  if (confinement.corners.empty()) return confinement.centre.dot(direction) + confinement.radius;
  double most = -solver::infinity;
  for (const Vector3& corner : confinement.corners) most = std::max(most, corner.dot(direction));
  return most;
}

double most_outside(const Confinement& confinement, const Robot& robot, const Vector3& point) {
  if (!confinement.moves_footprint) return (confinement.point - point).head<2>().norm();
  if (robot.footprint.size() < 3) return solver::infinity;
  const double to_edge = plane::distance_to_edges(robot.footprint, point);
  return plane::contains(robot.footprint, point) ? -to_edge : to_edge;
}

std::optional<solver::Range> left_of_position(const Confinement& confinement, const PlannedAxis& axis,
                                              const Robot& robot) {
  const bool is_asked = axis.in_world && axis.is_placed && !axis.is_set && !axis.is_on_path &&
                        axis.move.body == 0 && !axis.is_feature() &&
                        (axis.axis == solver::Axis::x || axis.axis == solver::Axis::y);
  if (!is_asked) return std::nullopt;
  const Vector3 along = axis.in.pose.rotation.col(axis.axis == solver::Axis::x ? 0 : 1);
  if (std::abs(along.z()) > 1e-9) return std::nullopt;
  const double outside = most_outside(confinement, robot, axis.move.pose.position);
  const double origin = axis.in.pose.position.dot(along);
  return solver::Range{-farthest_along(confinement, -along) - outside - origin,
                       farthest_along(confinement, along) + outside - origin};
}

double longest_way(const Confinement& confinement, const PlannedTask& plan, Probe& probe, bool is_first) {
  const PlannedAxis* driven = driven_straight(plan, probe);
  if (driven == nullptr) return solver::infinity;
  const Robot& robot = probe.robot();
  // From outside it comes back first, as far as a corner of the footprint.
  double outside = 0.0;
  for (const Vector3& corner : robot.footprint) outside = std::max(outside, corner.head<2>().norm());
  if (!is_first && driven->in.body >= 0) return outside + largest_width(confinement, robot);
  const Vector3 along = probe.direction(*driven);
  const double way = width(confinement, robot, along);
  if (!is_first) return outside + way;
  const Vector3 at = place_at_start(probe);
  return outside + away_at_start(confinement, at) + std::min(way, chord(confinement, robot, at, along));
}

}  // namespace zwang::lang
