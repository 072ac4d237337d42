// W416: ranges in force that exclude each other, and drivers whose target lies outside of a range in force.
//
//   [l1, h1] and [l2, h2] of one quantity along one axis       h1 < l2 or h2 < l1: no value is in both
//   target t beside [l, h]                                     t < l or t > h: never reached
//   position beside velocities [l, h]                          l > 0 or h < 0: it never stands there
//
// Regions in force leave a range of each position (confined.hpp). Two points of one base are at most as far
// apart as they are on it, whatever its heading. No acceleration is above what the motors make, F / m.
//
// Two axes are one where their rows are alike, or opposite; positions also count from the same origin. In the
// task that starts the run, velocities count along axes of the world and of the base that are one at its
// heading. W402 tells of a driver beside a range of `always` with the same words for frames and axis.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "diagnostic/wordings_forces.hpp"
#include "diagnostic/wordings_never.hpp"
#include "physics/confined.hpp"
#include "physics/kept_heading.hpp"

namespace zwang::lang {

namespace {

using solver::Quantity;
using solver::Range;

constexpr std::array quantities{Quantity::position, Quantity::velocity, Quantity::acceleration};

bool is_alike(const solver::AttachedFrame& a, const solver::AttachedFrame& b) {
  return a.body == b.body && a.pose.rotation.isApprox(b.pose.rotation) &&
         (a.pose.position - b.pose.position).norm() < 1e-9;
}

/// How `limit` bounds the axis: as it is, turned around, or (nullopt) not at all.
std::optional<Range> seen_along(const PlannedAxis& axis, const PlannedAxis& limit, Quantity quantity,
                                Probe& probe) {
  const int sign = probe.alignment(axis, limit);
  if (sign == 0) return std::nullopt;
  const bool shares_origin = sign > 0 && axis.in_name == limit.in_name && is_alike(axis.move, limit.move) &&
                             is_alike(axis.in, limit.in);
  if (quantity == Quantity::position && !shares_origin) return std::nullopt;
  const Range& range = *limit[quantity];
  return sign > 0 ? range : Range{-range.high, -range.low};
}

bool may_exclude(const Range& a, const Range& b) {
  const auto excludes = [](const Range& one, double low, double high) {
    return one.high < low || one.low > high;
  };
  return excludes(a, b.low, b.high) || excludes(a, -b.high, -b.low);
}

wording::Bound bound_of(const PlannedAxis& axis, Quantity quantity, const Range& range) {
  return {axis.path, word_of(quantity),
          usual_unit(dimension_of(axis.turns() ? solver::Axis::rz : solver::Axis::x, quantity)), range.low,
          range.high};
}

bool is_of_always(const PlannedAxis& axis) {
  return axis.text != nullptr && axis.group.empty();
}

/// W402 is said of it.
bool is_told_already(const PlannedAxis& axis, const PlannedAxis& limit, Quantity quantity) {
  return is_of_always(limit) && !is_of_always(axis) && quantity != Quantity::position && !axis.is_feature() &&
         axis.move_name == limit.move_name && axis.in_name == limit.in_name && axis.axis == limit.axis;
}

/// Whether the two exclude each other.
bool compare_ranges(const PlannedTask& plan, const PlannedAxis& axis, const PlannedAxis& earlier,
                    Quantity quantity, bool is_start, Probe& probe, Remarks& remarks) {
  if (!axis[quantity] || !earlier[quantity] || !may_exclude(*axis[quantity], *earlier[quantity]))
    return false;
  std::optional<Range> other = seen_along(axis, earlier, quantity, probe);
  const bool is_fixed = is_start && quantity == Quantity::velocity && axis.is_placed && earlier.is_placed &&
                        !axis.is_set && !earlier.is_set && !axis.is_on_path && !earlier.is_on_path;
  const int sign = !other && is_fixed ? aligned_at_start(plan, axis, earlier, probe) : 0;
  const Range& seen = *earlier[quantity];
  if (sign != 0) other = sign > 0 ? seen : Range{-seen.high, -seen.low};
  const Range& own = *axis[quantity];
  if (!other || (own.low <= other->high && other->low <= own.high)) return false;
  // The robot file's limit is told at the task's range.
  const bool is_written = axis.text != nullptr;
  const PlannedAxis& at = is_written ? axis : earlier;
  const PlannedAxis& from = is_written ? earlier : axis;
  remarks.add(wording::excluding_ranges(at.span(quantity), bound_of(at, quantity, *at[quantity]),
                                        bound_of(from, quantity, *from[quantity]), from.span(quantity)));
  return true;
}

void compare_driver(const PlannedAxis& axis, const PlannedAxis& limit, Probe& probe, Remarks& remarks) {
  // A force range beside a motion driver is that driver's own; alone it bounds all rows from its level on.
  const bool presses = axis.driver == Quantity::force && !limit.driver && limit.level <= axis.level;
  const bool drives = (axis.drives_motion() || presses) && axis.target && axis.text != nullptr;
  if (!drives || &axis == &limit || !limit[*axis.driver] || is_told_already(axis, limit, *axis.driver))
    return;
  const double target = *axis.target;
  if (!may_exclude({target, target}, *limit[*axis.driver])) return;
  const std::optional<Range> range = seen_along(axis, limit, *axis.driver, probe);
  if (!range || (range->low <= target && target <= range->high)) return;
  remarks.add(wording::beyond_a_range(axis.driver_span(), bound_of(axis, *axis.driver, {target, target}),
                                      bound_of(limit, *axis.driver, *range), limit.span(*axis.driver)));
}

/// Where it arrives it is to stand: velocities without 0 drive it on.
void compare_rest(const PlannedAxis& axis, const PlannedAxis& limit, Probe& probe, Remarks& remarks) {
  const auto& range = limit[Quantity::velocity];
  const bool stays = axis.driver == Quantity::position && !axis.is_spring && axis.text != nullptr;
  if (!stays || !range || (range->low <= 0.0 && range->high >= 0.0)) return;
  const std::optional<Range> seen =
      &axis == &limit ? range : seen_along(axis, limit, Quantity::velocity, probe);
  if (seen)
    remarks.add(wording::never_stands(axis.driver_span(), axis.path,
                                      bound_of(limit, Quantity::velocity, *seen),
                                      limit.span(Quantity::velocity)));
}

/// Two forces along one motion: what is left of them.
void compare_pushes(const PlannedAxis& axis, const PlannedAxis& earlier, Probe& probe, Remarks& remarks) {
  const auto pushes = [](const PlannedAxis& one) {
    return one.driver == Quantity::force && one.target && *one.target != 0.0 && one.text != nullptr;
  };
  if (!pushes(axis) || !pushes(earlier)) return;
  const double other = *earlier.target * probe.alignment(axis, earlier);
  if (!(other * *axis.target < 0.0)) return;
  remarks.add(wording::push_against(axis.driver_span(), axis.path, earlier.path, axis.turns(),
                                    std::abs(*axis.target + other), earlier.driver_span()));
}

/// One cause, one message: where many ranges exclude each other, the first pair is told.
void ask_ranges(const PlannedTask& plan, Quantity quantity, bool is_start, Probe& probe, Remarks& remarks) {
  for (std::size_t i = 0; i < plan.axes.size() && !probe.is_exhausted(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (compare_ranges(plan, plan.axes[i], plan.axes[j], quantity, is_start, probe, remarks)) return;
    }
  }
}

/// A norm is no less than the velocity along any axis.
void compare_with_norm(const PlannedAxis& axis, const PlannedSpeed& speed, Remarks& remarks) {
  const auto& range = axis[Quantity::velocity];
  if (!range || axis.turns() || axis.move.body != speed.body || axis.is_feature() || axis.text == nullptr)
    return;
  if (std::max(range->low, -range->high) <= speed.most) return;
  remarks.add(wording::excluding_ranges(axis.span(Quantity::velocity),
                                        bound_of(axis, Quantity::velocity, *range),
                                        {speed.path, "velocity", "m/s", 0.0, speed.most}, speed.span));
}

bool drives_speed(const PlannedAxis& axis, const PlannedSpeed& speed) {
  return axis.driver == Quantity::velocity && axis.target && !axis.turns() && !axis.is_feature() &&
         axis.move.body == speed.body && axis.text != nullptr;
}

/// Drivers of x and y of one frame that are each within the norm, and not together.
void compare_two_with_norm(const PlannedAxis& x, const PlannedAxis& y, const PlannedSpeed& speed,
                           Remarks& remarks) {
  const bool is_a_pair = x.axis == solver::Axis::x && y.axis == solver::Axis::y && drives_speed(x, speed) &&
                         drives_speed(y, speed) && is_alike(x.in, y.in) && is_alike(x.move, y.move);
  if (!is_a_pair || std::max(std::abs(*x.target), std::abs(*y.target)) > speed.most) return;
  const double together = std::hypot(*x.target, *y.target);
  if (together <= speed.most * (1.0 + 1e-3)) return;
  remarks.add(wording::beyond_a_norm(y.driver_span(), x.path, y.path, together,
                                     {speed.path, "velocity", "m/s", 0.0, speed.most}, speed.span));
}

bool is_along_world(const PlannedAxis& axis) {
  return axis.in_world && axis.is_placed && !axis.is_set && !axis.is_on_path && axis.move.body >= 0 &&
         !axis.is_feature() && (axis.axis == solver::Axis::x || axis.axis == solver::Axis::y) &&
         axis[Quantity::position];
}

solver::Vector3 along_world(const PlannedAxis& axis) {
  return axis.in.pose.rotation.col(axis.axis == solver::Axis::x ? 0 : 1);
}

/// Positions of two points of one body along one axis of the world.
void compare_points(const PlannedAxis& axis, const PlannedAxis& earlier, Remarks& remarks) {
  if (!is_along_world(axis) || !is_along_world(earlier) || axis.move.body != earlier.move.body) return;
  const solver::Vector3 along = along_world(axis);
  const double cosine = along.dot(along_world(earlier));
  if (std::abs(std::abs(cosine) - 1.0) > 1e-9) return;
  const double apart = (axis.move.pose.position - earlier.move.pose.position).head<2>().norm();
  if (!(apart > 1e-9)) return;  // told as ranges of one axis
  Range other = *earlier[Quantity::position];
  if (cosine < 0.0) other = {-other.high, -other.low};
  const double shift = along.dot(earlier.in.pose.position - axis.in.pose.position);
  other = {other.low + shift - apart, other.high + shift + apart};
  const Range& own = *axis[Quantity::position];
  if (own.low <= other.high && other.low <= own.high) return;
  remarks.add(wording::excluding_ranges(
      axis.span(Quantity::position), bound_of(axis, Quantity::position, own),
      bound_of(earlier, Quantity::position, other), earlier.span(Quantity::position)));
}

void compare_with_region(const PlannedAxis& axis, const Confinement& region, const Robot& robot,
                         Remarks& remarks) {
  const auto& own = axis[Quantity::position];
  const bool drives = axis.driver == Quantity::position && axis.target && axis.text != nullptr;
  const std::optional<Range> left =
      own || drives ? left_of_position(region, axis, robot) : std::optional<Range>();
  if (left && drives && (*axis.target < left->low || *axis.target > left->high))
    remarks.add(wording::beyond_a_range(axis.driver_span(),
                                        bound_of(axis, Quantity::position, {*axis.target, *axis.target}),
                                        {region.path, "position", "m", left->low, left->high}, region.span));
  if (!left || !own || (own->low <= left->high && left->low <= own->high)) return;
  remarks.add(wording::excluding_ranges(axis.span(Quantity::position),
                                        bound_of(axis, Quantity::position, *own),
                                        {region.path, "position", "m", left->low, left->high}, region.span));
}

/// The directions stand for all: where one of them parts the two, they are apart.
void compare_regions(const Confinement& a, const Confinement& b, const Robot& robot, Remarks& remarks) {
  constexpr int directions = 72;
  const solver::Vector3 origin = solver::Vector3::Zero();
  const double outside = most_outside(a, robot, origin) + most_outside(b, robot, origin);
  double apart = 0.0;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / directions;
    const solver::Vector3 along(std::cos(angle), std::sin(angle), 0.0);
    apart = std::max(apart, -farthest_along(a, along) - farthest_along(b, -along) - outside);
  }
  if (apart > 1e-6) remarks.add(wording::excluding_regions(a.span, a.path, b.path, apart, b.span));
}

/// An acceleration that is to be kept above what the motors make.
void compare_with_motors(const PlannedAxis& axis, Probe& probe, Remarks& remarks) {
  const auto& range = axis[Quantity::acceleration];
  if (!range || axis.text == nullptr || axis.is_norm) return;
  const double least = std::max(range->low, -range->high);
  const AxisFigures* figures = least > 0.0 ? probe.figures(axis) : nullptr;
  if (figures == nullptr || !figures->is_reachable || axis.is_open()) return;
  double most = 0.0;
  for (std::size_t i = 0; i < figures->masses.size(); ++i) {
    if (figures->masses[i] > 0.0) most = std::max(most, figures->forces[i] / figures->masses[i]);
  }
  if (!(most > 0.0) || least <= most * (1.0 + 1e-6)) return;
  remarks.add(wording::beyond_the_motors(axis.span(Quantity::acceleration),
                                         bound_of(axis, Quantity::acceleration, *range), most));
}

void ask_places(const CheckContext& context, const PlannedTask& plan, const Robot& robot, Remarks& remarks) {
  const std::vector<Confinement> regions = confinements(context, plan);
  for (std::size_t i = 0; i < plan.axes.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) compare_points(plan.axes[i], plan.axes[j], remarks);
    for (const Confinement& region : regions) compare_with_region(plan.axes[i], region, robot, remarks);
  }
  for (std::size_t i = 0; i < regions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) compare_regions(regions[i], regions[j], robot, remarks);
  }
}

}  // namespace

void ask_contradiction(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  const bool is_start = plan.task != nullptr && plan.task->name.text == context.file.start.text;
  for (const solver::Quantity quantity : quantities) ask_ranges(plan, quantity, is_start, probe, remarks);
  ask_places(context, plan, probe.robot(), remarks);
  for (const PlannedAxis& axis : plan.axes) compare_with_motors(axis, probe, remarks);
  for (const PlannedAxis& axis : plan.axes) {
    if (probe.is_exhausted()) return;
    for (const PlannedAxis& limit : plan.axes) {
      compare_driver(axis, limit, probe, remarks);
      compare_rest(axis, limit, probe, remarks);
      if (&limit < &axis) compare_pushes(axis, limit, probe, remarks);
    }
    for (const PlannedSpeed& speed : plan.speeds) {
      compare_with_norm(axis, speed, remarks);
      for (const PlannedAxis& other : plan.axes) compare_two_with_norm(other, axis, speed, remarks);
      const bool is_asked = axis.driver == solver::Quantity::velocity && axis.target && !axis.turns() &&
                            axis.move.body == speed.body && !speed.path.starts_with("always.");
      if (!is_asked || std::abs(*axis.target) <= speed.most) continue;
      remarks.add(wording::beyond_a_range(
          axis.driver_span(), bound_of(axis, solver::Quantity::velocity, {*axis.target, *axis.target}),
          {speed.path, "velocity", "m/s", 0.0, speed.most}, speed.span));
    }
  }
}

}  // namespace zwang::lang
