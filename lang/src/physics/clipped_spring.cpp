// W601 of a spring. Drawn farther than s, it pushes no harder than a limit allows: an acceleration limit, or
// a force range that bounds the sum of all rows.
//
//   k s = min(m a_max, F_sum)      s: where it is clipped
//
// A force range says as much itself. It is told where s is less than a spring is meant to be drawn. That is
// the way to a place to go to. Else it is the way that somebody pushes a base aside: 0.2 m or 20 deg.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnostic/wordings_never.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

constexpr double pushed_aside = 0.2;                              // [m]
constexpr double turned_aside = 20.0 * std::numbers::pi / 180.0;  // [rad]

double drawn(const PlannedAxis& axis, const Probe& probe) {
  const double aside = axis.turns() ? turned_aside : pushed_aside;
  if (!axis.target || !axis.is_placed || axis.is_set) return aside;
  return std::max(aside, std::abs(*axis.target - probe.position_at_start(axis)));
}

}  // namespace

void ask_springs(const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) {
    if (!axis.is_spring || !axis.stiffness || !(*axis.stiffness > 0.0)) continue;
    const AxisFigures* figures = probe.figures(axis);
    if (figures == nullptr || !figures->is_reachable || !std::isfinite(figures->mass)) continue;
    const AccelerationLimit ahead = acceleration_limit(plan, axis, 1.0, true);
    const AccelerationLimit back = acceleration_limit(plan, axis, -1.0, true);
    const AccelerationLimit& limit = ahead.most < back.most ? ahead : back;
    const ForceLimit sum_ahead = sum_limit(plan, axis, 1.0), sum_back = sum_limit(plan, axis, -1.0);
    const ForceLimit& sum = sum_ahead.most < sum_back.most ? sum_ahead : sum_back;
    const double most = std::min(figures->mass * limit.most, sum.most);
    if (!std::isfinite(most)) continue;
    const bool by_sum = sum.most < figures->mass * limit.most;
    double asked = *axis.stiffness * drawn(axis, probe);
    if (const auto& range = axis[solver::Quantity::force])
      asked = std::min(asked, std::max(range->high, -range->low));
    if (asked <= most * (1.0 + 1e-6)) continue;
    remarks.add(wording::clipped_spring(
        axis.stiffness_span, {axis.path, axis.turns(), asked, most, figures->mass}, most / *axis.stiffness,
        by_sum ? sum.from->span(solver::Quantity::force) : limit.from->span(solver::Quantity::acceleration),
        by_sum ? sum.from->path : ""));
  }
}

}  // namespace zwang::lang
