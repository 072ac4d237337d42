// W610: a driver that a range keeps from moving anything. A range counts as zero where what it leaves is
// nothing to see:
//
//   acceleration      < 1e-5 m/s^2, rad/s^2: 0.6 mm/s after a minute
//   force             < that times the effective mass
//   velocity          < 1e-6 m/s, rad/s, beside a position to go to
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_physics.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

constexpr double least_acceleration = 1e-5;
constexpr double least_velocity = 1e-6;

double towards(const solver::Range& range, double sign) {
  return sign > 0.0 ? range.high : -range.low;
}

/// A position may lie on either side.
double most_of(const PlannedAxis& axis, const solver::Range& range) {
  if (axis.driver == solver::Quantity::position) return std::max(range.high, -range.low);
  return towards(range, *axis.target);
}

/// A range on an axis at an angle to it leaves the rest of it free.
bool lies_along(const PlannedAxis& limit, const PlannedAxis& axis) {
  return &limit == &axis ||
         (limit.axis == axis.axis && limit.measure == axis.measure && limit.in.body == axis.in.body &&
          limit.in.pose.rotation.isApprox(axis.in.pose.rotation));
}

/// The range that forbids, and whose it is; nullptr: none does.
struct Forbidding {
  solver::Quantity quantity = solver::Quantity::acceleration;
  const PlannedAxis* axis = nullptr;
};

Forbidding forbidding(const PlannedTask& plan, const PlannedAxis& axis, Probe& probe) {
  const bool goes_somewhere = axis.driver == solver::Quantity::position;
  const double sign = *axis.target < 0.0 ? -1.0 : 1.0;
  AccelerationLimit limit = acceleration_limit(plan, axis, sign, true);
  if (goes_somewhere) {
    const AccelerationLimit back = acceleration_limit(plan, axis, -sign, true);
    if (back.most > limit.most) limit = back;
  }
  if (limit.from != nullptr && limit.most < least_acceleration && lies_along(*limit.from, axis))
    return {solver::Quantity::acceleration, limit.from};
  const auto& velocity = axis[solver::Quantity::velocity];
  if (goes_somewhere && velocity && most_of(axis, *velocity) < least_velocity)
    return {solver::Quantity::velocity, &axis};
  const auto& force = axis[solver::Quantity::force];
  if (!force || axis.driver == solver::Quantity::force) return {};
  const AxisFigures* figures = probe.figures(axis);
  const double mass = figures != nullptr && std::isfinite(figures->mass) ? figures->mass : 1.0;
  if (most_of(axis, *force) < least_acceleration * mass) return {solver::Quantity::force, &axis};
  return {};
}

}  // namespace

void ask_still(PlannedTask& plan, Probe& probe, Remarks& remarks) {
  for (PlannedAxis& axis : plan.axes) {
    const bool is_asked = axis.driver && axis.target && axis.text != nullptr &&
                          (*axis.target != 0.0 || axis.driver == solver::Quantity::position) &&
                          axis.is_placed && !remarks.any_at(axis.driver_span());
    const Forbidding by = is_asked ? forbidding(plan, axis, probe) : Forbidding{};
    if (by.axis == nullptr) continue;
    remarks.add(wording::stands_still(axis.driver_span(), axis.path, by.axis == &axis ? "" : by.axis->path,
                                      word_of(by.quantity), by.axis->span(by.quantity)));
    axis.driver.reset();
  }
}

}  // namespace zwang::lang
