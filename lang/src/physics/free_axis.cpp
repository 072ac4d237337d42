// W609: an axis that is left free, so that what touches the base may move it, and that the wheels hold.
//
//   1 / A Mc A' = infinite    at the start, where nobody steers
//
// Wheels that steer hold the base along another arc at another angle. So nothing is said where a row drives
// what they hold at the start: it steers.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_physics.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

/// False past the budget, too.
bool is_held_at_the_start(const PlannedAxis& axis, Probe& probe) {
  const AxisFigures* figures = probe.figures(axis);
  return figures != nullptr && std::isinf(figures->mass);
}

bool steers(const PlannedAxis& axis, Probe& probe) {
  const bool asks = axis.drives_motion() && !axis.stands_still();
  return asks && axis.move.body == 0 && is_held_at_the_start(axis, probe);
}

}  // namespace

void ask_free(const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  if (plan.free.empty()) return;
  const bool is_steered = std::any_of(plan.axes.begin(), plan.axes.end(),
                                      [&](const PlannedAxis& axis) { return steers(axis, probe); });
  if (is_steered) return;
  for (const PlannedAxis& axis : plan.free) {
    const bool is_asked =
        axis.move.body == 0 && axis.is_placed && !axis.is_feature() && !probe.is_out_of_plane(axis);
    if (!is_asked || remarks.any_at(axis.text->name.span) || !is_held_at_the_start(axis, probe)) continue;
    const AxisFigures& figures = *probe.figures(axis);
    remarks.add(wording::free_and_held(axis.text->name.span, axis.text->name.text, !figures.is_held));
  }
}

}  // namespace zwang::lang
