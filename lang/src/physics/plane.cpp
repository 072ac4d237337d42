// W615: a way ahead at v while the base turns at w is a circle, and its point accelerates with w v:
//
//   w v > a       a: of `plane`; the norm then slows the way down
//
// W641: ranges of x and of y that are meant as one norm. Both together allow sqrt(2) as much as either.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_norms.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

using solver::Axis;
using solver::Quantity;

constexpr double norm_rounding = 1.0 + 1e-9;

/// Along axes that turn with the base: a velocity there goes on around a circle.
bool is_on_base(const PlannedAxis& axis) {
  return axis.text != nullptr && !axis.is_feature() && axis.move.body == 0 && axis.in.body == 0;
}

bool drives_speed(const PlannedAxis& axis) {
  return is_on_base(axis) && axis.driver == Quantity::velocity && axis.target && !axis.is_soft;
}

/// The velocity that is driven of the point, ahead and across. [m/s]
double driven_speed(const PlannedTask& plan, const solver::AttachedFrame& point) {
  double square = 0.0;
  for (const PlannedAxis& axis : plan.axes) {
    const bool is_way = drives_speed(axis) && (axis.axis == Axis::x || axis.axis == Axis::y) &&
                        (axis.move.pose.position - point.pose.position).norm() < 1e-9;
    if (is_way) square += *axis.target * *axis.target;
  }
  return std::sqrt(square);
}

const PlannedAxis* driven_turn(const PlannedTask& plan) {
  for (const PlannedAxis& axis : plan.axes) {
    if (drives_speed(axis) && axis.axis == Axis::rz) return &axis;
  }
  return nullptr;
}

void ask_circle(const PlannedTask& plan, Remarks& remarks) {
  const PlannedAxis* turn = driven_turn(plan);
  if (turn == nullptr) return;
  for (const PlannedNorm& norm : plan.norms) {
    const double speed = driven_speed(plan, norm.move), rate = std::abs(*turn->target);
    if (norm.move.body != 0 || !(norm.most > 0.0) || speed * rate <= norm.most * norm_rounding) continue;
    remarks.add(
        wording::circle_beyond_norm(turn->driver_span(), {speed, rate, norm.most, norm.path}, norm.span));
  }
}

/// Ranges of the same size to both sides, that nothing else on the axis asks for. A force range beside a
/// driver is that row's own: who presses into a corner means both.
bool is_half_of_a_norm(const PlannedAxis& axis, Quantity quantity) {
  const std::optional<solver::Range>& range = axis[quantity];
  if (axis.text == nullptr || axis.is_norm || axis.is_feature() || !range) return false;
  return !(quantity == Quantity::force && axis.driver) && std::isfinite(range->high) && range->high > 0.0 &&
         range->low == -range->high;
}

void ask_box(const PlannedTask& plan, Quantity quantity, Remarks& remarks) {
  for (const PlannedAxis& x : plan.axes) {
    if (x.axis != Axis::x || !is_half_of_a_norm(x, quantity)) continue;
    for (const PlannedAxis& y : plan.axes) {
      const bool is_pair = y.axis == Axis::y && is_half_of_a_norm(y, quantity) &&
                           x.move_name == y.move_name && x.in_name == y.in_name && x.level == y.level &&
                           x[quantity]->high == y[quantity]->high;
      if (is_pair)
        remarks.add(wording::box_for_norm(x.span(quantity),
                                          {x.path, y.path, quantity == Quantity::force, x[quantity]->high},
                                          y.span(quantity)));
    }
  }
}

/// Nothing goes across there.
bool moves_both_ways(const PlannedTask& plan, Probe& probe) {
  for (const Axis axis : {Axis::x, Axis::y}) {
    PlannedAxis base;
    base.move = base.in = {0, {}, {}};
    base.axis = axis;
    const AxisFigures* figures = probe.figures(base);
    if (figures == nullptr || !figures->is_reachable) return false;
  }
  return !plan.axes.empty();
}

}  // namespace

void ask_plane(const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  ask_circle(plan, remarks);
  if (!moves_both_ways(plan, probe)) return;
  for (const solver::Quantity quantity : {solver::Quantity::acceleration, solver::Quantity::force})
    ask_box(plan, quantity, remarks);
}

}  // namespace zwang::lang
