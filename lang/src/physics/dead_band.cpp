// W647: a yield whose force range, or whose motors, do not hold its own dead band.
//
// A yield stands while |F| <= d, the dead band. It does so by nu = -F. A force range [f1, f2] allows that
// only while -F lies inside it. So the axis gives way from
//
//   F_held = min(-f1, f2, what the motors make)
//
// on, and nothing damps it there: Lambda dds = F - F_held.
#include <algorithm>

#include "diagnostic/wordings_forces.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

void ask_dead_band(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  // A drive that takes velocities follows dds alone.
  if (context.robot->drive.takes_velocity) return;
  for (const PlannedAxis& axis : plan.axes) {
    const auto& range = axis[solver::Quantity::force];
    if (!axis.is_yield || !axis.dead_band) continue;
    double held = range ? std::max(0.0, std::min(-range->low, range->high)) : solver::infinity;
    const AxisFigures* figures = probe.figures(axis);
    const bool is_of_motors = figures != nullptr && figures->is_reachable && figures->force < held;
    if (is_of_motors) held = figures->force;
    if (held >= *axis.dead_band) continue;
    remarks.add(wording::dead_band_not_held(
        is_of_motors ? axis.dead_band_span : axis.span(solver::Quantity::force), axis.path, axis.turns(),
        {*axis.dead_band, held, axis.dead_band_span, is_of_motors}));
  }
}

}  // namespace zwang::lang
