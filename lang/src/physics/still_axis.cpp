// W610: a driver that a range keeps from moving anything. A range counts as zero where what it leaves is
// nothing to see:
//
//   acceleration      < 1e-5 m/s^2, rad/s^2: 0.6 mm/s after a minute
//   force             < that times the effective mass; of the axis, or of the sum of all rows
//   velocity          < 1e-6 m/s, rad/s, beside a position, a force or an acceleration; of a speed, too
#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnostic/wordings_physics.hpp"
#include "physics/kept_heading.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

constexpr double least_acceleration = 1e-5;
constexpr double least_velocity = 1e-6;

double towards(const solver::Range& range, double sign) {
  return sign > 0.0 ? range.high : -range.low;
}

/// 1 or -1: on which side the target lies. 0: a position that may lie on either side. In the task that starts
/// the run, the place at the start tells.
double side_of(const CheckContext& context, const PlannedTask& plan, const PlannedAxis& axis,
               const Probe& probe) {
  constexpr double there = 1e-3;                                  // [m] or [rad]
  constexpr double other_way = 175.0 / 180.0 * std::numbers::pi;  // beyond it either way is as short [rad]
  if (axis.is_yield) return 0.0;
  if (axis.driver != solver::Quantity::position) return *axis.target < 0.0 ? -1.0 : 1.0;
  const bool starts_here = plan.task->name.text == context.file.start.text && axis.is_placed &&
                           !axis.is_set && !axis.is_on_path && (axis.in_world || axis.move.body != 0);
  if (!starts_here) return 0.0;
  double way = *axis.target - probe.position_at_start(axis);
  if (axis.turns()) way = std::remainder(way, 2.0 * std::numbers::pi);
  const bool is_either = axis.turns() && std::abs(way) > other_way;
  return std::abs(way) < there || is_either ? 0.0 : way < 0.0 ? -1.0 : 1.0;
}

double most_of(const solver::Range& range, double side) {
  return side == 0.0 ? std::max(range.high, -range.low) : towards(range, side);
}

/// A range on an axis at an angle to it leaves the rest of it free.
bool lies_along(const PlannedAxis& limit, const PlannedAxis& axis) {
  return &limit == &axis ||
         (limit.axis == axis.axis && limit.measure == axis.measure && limit.in.body == axis.in.body &&
          limit.in.pose.rotation.isApprox(axis.in.pose.rotation));
}

/// The range that forbids, and whose it is.
struct Forbidding {
  solver::Quantity quantity = solver::Quantity::acceleration;
  std::string path;  ///< empty: the axis's own range
  Span span;
};

Forbidding by(const PlannedAxis& limit, const PlannedAxis& axis, solver::Quantity quantity) {
  return {quantity, &limit == &axis ? "" : limit.path, limit.span(quantity)};
}

std::optional<Forbidding> by_acceleration(const PlannedTask& plan, const PlannedAxis& axis, double side) {
  AccelerationLimit limit = acceleration_limit(plan, axis, side < 0.0 ? -1.0 : 1.0, true);
  if (side == 0.0) {
    const AccelerationLimit back = acceleration_limit(plan, axis, -1.0, true);
    if (back.most > limit.most) limit = back;
  }
  const bool forbids =
      limit.from != nullptr && limit.most < least_acceleration && lies_along(*limit.from, axis);
  return forbids ? std::optional(by(*limit.from, axis, solver::Quantity::acceleration)) : std::nullopt;
}

/// As `Probe::alignment`. In the task that starts the run, with the heading that it keeps, axes of the world
/// and of the base may be one, too.
int aligned(const PlannedTask& plan, const PlannedAxis& axis, const PlannedAxis& other, double side,
            Probe& probe) {
  const int always = probe.alignment(axis, other);
  const bool may_be = always == 0 && side != 0.0 && axis.driver == solver::Quantity::position;
  return may_be ? aligned_at_start(plan, axis, other, probe) : always;
}

/// W416 tells of a velocity driver.
std::optional<Forbidding> by_velocity(const PlannedTask& plan, const PlannedAxis& axis, double side,
                                      Probe& probe) {
  if (axis.driver == solver::Quantity::velocity || axis.is_spring) return std::nullopt;
  for (const PlannedAxis& other : plan.axes) {
    const auto& range = other[solver::Quantity::velocity];
    const int along = !range ? 0 : &other == &axis ? 1 : aligned(plan, axis, other, side, probe);
    if (along == 0) continue;
    const solver::Range seen = along > 0 ? *range : solver::Range{-range->high, -range->low};
    if (most_of(seen, side) < least_velocity) return by(other, axis, solver::Quantity::velocity);
  }
  for (const PlannedSpeed& speed : plan.speeds) {
    if (speed.body == axis.move.body && !axis.turns() && !axis.is_feature() && speed.most < least_velocity)
      return Forbidding{solver::Quantity::velocity, speed.path, speed.span};
  }
  return std::nullopt;
}

std::optional<Forbidding> by_force(const PlannedTask& plan, const PlannedAxis& axis, double side,
                                   Probe& probe) {
  const AxisFigures* figures = probe.figures(axis);
  const double least =
      least_acceleration * (figures != nullptr && std::isfinite(figures->mass) ? figures->mass : 1.0);
  const auto& own = axis[solver::Quantity::force];
  if (own && axis.driver != solver::Quantity::force && most_of(*own, side) < least)
    return by(axis, axis, solver::Quantity::force);
  ForceLimit sum = sum_limit(plan, axis, side < 0.0 ? -1.0 : 1.0);
  if (side == 0.0) {
    const ForceLimit back = sum_limit(plan, axis, -1.0);
    if (back.most > sum.most) sum = back;
  }
  const bool forbids = sum.from != nullptr && sum.most < least && lies_along(*sum.from, axis);
  return forbids ? std::optional(by(*sum.from, axis, solver::Quantity::force)) : std::nullopt;
}

std::optional<Forbidding> forbidding(const CheckContext& context, const PlannedTask& plan,
                                     const PlannedAxis& axis, Probe& probe) {
  const double side = side_of(context, plan, axis, probe);
  if (auto found = by_acceleration(plan, axis, side)) return found;
  if (auto found = by_velocity(plan, axis, side, probe)) return found;
  return by_force(plan, axis, side, probe);
}

}  // namespace

void ask_still(const CheckContext& context, PlannedTask& plan, Probe& probe, Remarks& remarks) {
  for (PlannedAxis& axis : plan.axes) {
    const bool moves = axis.is_yield || (axis.driver && axis.target &&
                                         (*axis.target != 0.0 || axis.driver == solver::Quantity::position));
    const bool is_asked =
        moves && axis.text != nullptr && axis.is_placed && !remarks.any_at(axis.driver_span());
    const std::optional<Forbidding> found =
        is_asked ? forbidding(context, plan, axis, probe) : std::optional<Forbidding>();
    if (!found) continue;
    remarks.add(wording::stands_still(axis.driver_span(), axis.path, found->path, word_of(found->quantity),
                                      found->span));
    axis.driver.reset();
  }
}

}  // namespace zwang::lang
