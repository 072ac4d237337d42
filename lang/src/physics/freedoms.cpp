// E406: more equality rows at one level than there are freedoms. W407: rows that say the same thing twice.
// E404: axes that can be driven one by one and not together.
//
//   n     rows that demand motion at the level
//   m     freedoms that the ground leaves the base (or the whole robot, once a row moves another body)
//   r     their rank on the ground, in general position
//   r_k   their rank as coordinates of free bodies
//
//   n > m  E406          r_k < n  W407          r < r_k = n  E404: the wheels tie them together
//
// W407 also tells of a row whose motion a row of a level above takes whole.
//
// On a base of two freedoms the last one is asked of x and y of a point first. Three rows there are too many,
// but fewer of them would not help.
#include <algorithm>
#include <map>

#include "diagnostic/wordings_physics.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

using Rows = std::vector<const PlannedAxis*>;

/// Of a base with fewer than three freedoms, what `velocity: 0` holds depends on its heading: it may always
/// be what the wheels hold anyway.
bool counts(const PlannedAxis& axis, const Probe& probe) {
  return axis.drives_motion() && !axis.is_soft &&
         (!axis.stands_still() || axis.move.body != 0 || probe.base_mobility() == 3);
}

/// The first row that adds nothing to those before it; nullptr when all do. Rows that depend on each other
/// still do with more of them: the first one is found by halving.
template <typename Rank>
const PlannedAxis* first_dependent(const Rows& rows, const Rank& rank) {
  const auto are_dependent = [&](std::size_t count) {
    return rank({rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(count)}) < static_cast<int>(count);
  };
  if (!are_dependent(rows.size())) return nullptr;
  std::size_t independent = 0, dependent = rows.size();
  while (dependent - independent > 1) {
    const std::size_t middle = (independent + dependent) / 2;
    (are_dependent(middle) ? dependent : independent) = middle;
  }
  return rows[dependent - 1];
}

/// The earlier row that alone makes `row` redundant; nullptr when it takes several.
const PlannedAxis* twin_of(const PlannedAxis* row, const Rows& rows, Probe& probe) {
  for (const PlannedAxis* other : rows) {
    if (other == row) return nullptr;
    if (probe.kinematic_rank({other, row}) < 2) return other;
  }
  return nullptr;
}

/// On a base of two freedoms x and y of one point may be tied, whatever else is driven: another point is
/// wanted then, and not fewer rows.
const PlannedAxis* tied_shift(const Rows& rows, Probe& probe) {
  if (probe.base_mobility() != 2) return nullptr;
  Rows shifts;
  for (const PlannedAxis* row : rows) {
    if (row->move.body == 0 && !row->turns()) shifts.push_back(row);
  }
  const auto grounded = [&](const Rows& some) { return probe.rank(some); };
  const PlannedAxis* row = shifts.size() == 2 ? first_dependent(shifts, grounded) : nullptr;
  return row != nullptr && probe.kinematic_rank(shifts) == 2 ? row : nullptr;
}

void ask_level(int level, const Rows& rows, Probe& probe, Remarks& remarks) {
  const auto n = static_cast<int>(rows.size());
  const bool is_base_only =
      std::all_of(rows.begin(), rows.end(), [](const PlannedAxis* row) { return row->move.body == 0; });
  const int freedoms = is_base_only ? probe.base_mobility() : probe.mobility();
  const auto say_tied = [&](const PlannedAxis& row) {
    remarks.add(wording::tied_axes(row.driver_span(), row.path, row.move_name, freedoms,
                                   is_base_only ? probe.frame_ahead() : ""));
  };
  if (const PlannedAxis* row = tied_shift(rows, probe)) return say_tied(*row);
  if (n > freedoms) {
    const PlannedAxis& first_too_many = *rows[static_cast<std::size_t>(freedoms)];
    remarks.add(wording::too_many_rows(first_too_many.driver_span(), n, level, freedoms, is_base_only,
                                       is_base_only ? probe.frame_ahead() : ""));
    return;
  }
  if (n < 2) return;
  const auto kinematic = [&](const Rows& some) { return probe.kinematic_rank(some); };
  if (const PlannedAxis* row = first_dependent(rows, kinematic)) {
    const PlannedAxis* twin = twin_of(row, rows, probe);
    remarks.add(wording::redundant_row(row->driver_span(), row->path, twin != nullptr ? twin->path : "",
                                       twin != nullptr ? twin->driver_span() : Span{}));
    return;
  }
  const auto grounded = [&](const Rows& some) { return probe.rank(some); };
  if (const PlannedAxis* row = first_dependent(rows, grounded)) say_tied(*row);
}

/// Strict, without a bound of its own: what it drives, it takes whole.
bool takes_all(const PlannedAxis& axis) {
  return axis.drives_motion() && !axis.is_soft && !axis.is_yield && !axis[solver::Quantity::force];
}

/// A row above drives the very motion that the axis asks for.
void ask_above(const PlannedTask& plan, const PlannedAxis& axis, Probe& probe, Remarks& remarks) {
  // A row that only stands still holds what those above leave.
  if (!axis.drives_motion() || axis.text == nullptr || axis.stands_still() || !axis.target) return;
  if (remarks.any_at(axis.driver_span())) return;
  for (const PlannedAxis& above : plan.axes) {
    if (above.level >= axis.level || !takes_all(above)) continue;
    const int along = probe.alignment(axis, above);
    const bool is_alike =
        above.driver == axis.driver && above.target && *above.target * along == *axis.target;
    if (along == 0 || is_alike) continue;
    remarks.add(
        wording::taken_above(axis.driver_span(), axis.path, above.path, above.level, above.driver_span()));
    return;
  }
}

}  // namespace

void ask_freedoms(const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  std::map<int, Rows> levels;
  for (const PlannedAxis& axis : plan.axes) {
    if (!axis.driver || !counts(axis, probe)) continue;
    const AxisFigures* figures = probe.figures(axis);
    // An axis that cannot move and is not asked to move is not counted as a row.
    if (figures != nullptr && figures->is_reachable) levels[axis.level].push_back(&axis);
  }
  for (const auto& [level, rows] : levels) ask_level(level, rows, probe, remarks);
  for (const PlannedAxis& axis : plan.axes) ask_above(plan, axis, probe, remarks);
}

}  // namespace zwang::lang
