// N603: the first hit. A bound holds what the robot presses with; the base's momentum it cannot hold. Against
// a spring of stiffness K, with the bound F pushing on, the energy 1/2 m v^2 + F x = 1/2 K x^2 gives the peak
//
//   P = K x = F + sqrt(F^2 + K m v^2)
//
// which is 2 F however slow. Said where P is above 2.5 F, with the speed at which it comes down to that:
//
//   v = sqrt(P (P - 2 F) / (K m))
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_physics.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

constexpr double gentle = 2.5;  // of the force range

/// How fast the axis may meet something that it does not know of: 0 where nothing says it. [m/s]
double speed_of(const PlannedTask& plan, const PlannedAxis& axis) {
  const std::optional<solver::Range>& range = axis[solver::Quantity::velocity];
  double most = plan.speed_limit(axis);
  if (axis.driver == solver::Quantity::velocity && axis.target) return std::min(most, std::abs(*axis.target));
  if (axis.driver == solver::Quantity::force && axis.target && range)
    most = std::min(most, *axis.target < 0.0 ? -range->low : range->high);
  return std::isfinite(most) ? most : 0.0;
}

double bound_of(const PlannedAxis& axis) {
  if (axis.driver == solver::Quantity::force) return std::abs(axis.target.value_or(0.0));
  const std::optional<solver::Range>& range = axis[solver::Quantity::force];
  return range ? std::max(range->high, -range->low) : 0.0;
}

}  // namespace

void ask_impact(const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) {
    if (!axis.driver || axis.turns() || axis.move.body != 0 || axis.is_spring) continue;
    const AxisFigures* figures = probe.figures(axis);
    if (figures == nullptr || !figures->is_reachable || !std::isfinite(figures->mass)) continue;
    const double F = bound_of(axis);
    const double v = speed_of(plan, axis);
    const double K = probe.robot().bumper_stiffness;
    const double peak = F + std::sqrt(F * F + K * figures->mass * v * v);
    if (!(F > 0.0) || peak <= gentle * F) continue;
    const double allowed = gentle * F;
    const double gentle_speed = std::sqrt(allowed * (allowed - 2.0 * F) / (K * figures->mass));
    remarks.add(wording::impact(axis.span(solver::Quantity::force), axis.path, {figures->mass, v, K, peak},
                                allowed, gentle_speed));
  }
}

}  // namespace zwang::lang
