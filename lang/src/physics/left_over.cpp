// W646: a freedom of a base of three that a task of features leaves to nothing.
//
// A distance is one row, and so is a bearing. A base of three freedoms can circle a target with both of them
// met. No row asks for that motion and none stops it: what a noisy target sets going, goes on. Axes that are
// not written show in a group with axes. In a group on a feature there are none to miss.
#include <algorithm>

#include "diagnostic/wordings_never.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

/// A row of the base, of whatever quantity: it says what is to happen along its axis.
bool speaks_of_the_base(const PlannedAxis& axis) {
  return axis.driver && axis.move.body == 0 && axis.text != nullptr;
}

bool is_round_a_point(const PlannedAxis& axis) {
  return speaks_of_the_base(axis) && axis.drives_motion() &&
         (axis.measure == solver::Measure::distance || axis.measure == solver::Measure::bearing);
}

}  // namespace

void ask_left_over(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  // A group that could not be read may be the one that holds the rest. On a base of two freedoms a distance
  // and a bearing take both.
  if (probe.base_mobility() < 3 || context.diagnostics.has_errors()) return;
  const auto first = std::find_if(plan.axes.begin(), plan.axes.end(), is_round_a_point);
  if (first == plan.axes.end()) return;
  // Two rows of one motion leave as much as one of them: only independent rows count.
  std::vector<const PlannedAxis*> rows;
  for (const PlannedAxis& axis : plan.axes) {
    if (speaks_of_the_base(axis)) rows.push_back(&axis);
  }
  for (const PlannedAxis& axis : plan.free) {
    if (axis.move.body == 0) rows.push_back(&axis);
  }
  const int left = probe.base_mobility() - probe.rank(rows);
  if (left <= 0 || remarks.any_at(first->driver_span())) return;
  remarks.add(wording::leaves_freedoms(first->driver_span(), first->path, left, probe.base_mobility()));
}

}  // namespace zwang::lang
