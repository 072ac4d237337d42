// N605: a force range bounds its own row only. Other rows may add a force along the same direction e:
//
//   sum over rows j of F_j |e . e_j|      F_j: their force, their force range, else the motors' largest force
//
// The sum is taken at the start pose. If a force range alone on that direction bounds the sum, there is no
// note.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_physics.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

constexpr double least_share = 0.05;  // of a row along the limited direction

double share(const PlannedAxis& a, const PlannedAxis& b, const Probe& probe) {
  const bool is_alike = a.move.body == b.move.body && a.turns() == b.turns();
  return is_alike ? std::abs(probe.direction(a).dot(probe.direction(b))) : 0.0;
}

bool bounds_the_sum(const PlannedAxis& axis) {
  return axis[solver::Quantity::force] && (!axis.driver || axis.is_spring);
}

double most_force(const PlannedAxis& axis, Probe& probe) {
  if (axis.driver == solver::Quantity::force && axis.target) return std::abs(*axis.target);
  if (const auto& range = axis[solver::Quantity::force]) return std::max(range->high, -range->low);
  const AxisFigures* figures = probe.figures(axis);
  return figures != nullptr ? figures->force : 0.0;
}

}  // namespace

void ask_force_budget(const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) {
    if (!axis.drives_motion() || !axis[solver::Quantity::force]) continue;
    double added = 0.0;
    std::string others;
    bool is_bounded = false;
    for (const PlannedAxis& other : plan.axes) {
      const double part = &other == &axis ? 0.0 : share(axis, other, probe);
      is_bounded = is_bounded || (bounds_the_sum(other) && part > 0.99);
      if (!other.driver || part < least_share) continue;
      const double force = part * most_force(other, probe);
      if (force <= 0.0) continue;
      added += force;
      others += (others.empty() ? "`" : ", `") + other.path + "`";
    }
    if (others.empty() || is_bounded) continue;
    const solver::Range& own = *axis[solver::Quantity::force];
    remarks.add(wording::force_budget(axis.span(solver::Quantity::force), axis.path, axis.turns(),
                                      std::max(own.high, -own.low), others, added));
  }
}

}  // namespace zwang::lang
