// W647: a yield whose force range does not hold its own dead band.
//
// A yield stands while |F| <= d, the dead band. It does so by nu = -F. A force range [f1, f2] allows that
// only while -F lies inside it. So the axis gives way from
//
//   F_held = min(-f1, f2)
//
// on, and nothing damps it there: Lambda dds = F - F_held.
#include <algorithm>

#include "diagnostic/wordings_forces.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

void ask_dead_band(const CheckContext& context, const PlannedTask& plan, Remarks& remarks) {
  // A drive that takes velocities follows dds alone.
  if (context.robot->drive.takes_velocity) return;
  for (const PlannedAxis& axis : plan.axes) {
    const auto& range = axis[solver::Quantity::force];
    if (!axis.is_yield || !axis.dead_band || !range) continue;
    const double held = std::max(0.0, std::min(-range->low, range->high));
    if (held >= *axis.dead_band) continue;
    remarks.add(wording::dead_band_not_held(axis.span(solver::Quantity::force), axis.path, axis.turns(),
                                            {*axis.dead_band, held, axis.dead_band_span}));
  }
}

}  // namespace zwang::lang
