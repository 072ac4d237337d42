// E601, W601: a force driver that an acceleration range keeps from pressing.
//
// The solver knows no contact: it predicts the acceleration f / m that the force would give in the open and
// holds it below a_max. Blocked, the robot presses with m times the acceleration that is left:
//
//   pressed = min(f, m a_max)         m = 1 / A Mc A', the effective mass along the axis
//
// taken from the solver with the force row and all acceleration ranges in force, so that ranges on other axes
// count with their direction.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_physics.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

constexpr double tolerance = 1e-6;  // relative

struct Pressing {
  double least =
      solver::infinity;    ///< over the configurations in which the motors do not give out [N] or [N m]
  double most = 0.0;       ///< over all of them
  bool by_motors = false;  ///< in all it is the motors that give out: W606 says that
};

Pressing pressing(const PlannedTask& plan, const PlannedAxis& axis, double force, Probe& probe) {
  Pressing result;
  const std::vector<Pressed> all = probe.pressed(axis, force, plan.axes);
  for (const Pressed& one : all) {
    const double along = force < 0.0 ? -one.force : one.force;
    result.most = std::max(result.most, along);
    if (along < one.motors * (1.0 - 1e-3)) result.least = std::min(result.least, along);
  }
  result.by_motors = !std::isfinite(result.least);
  // Towards a side that the wheels hold the mass grows without bound, and m a_max with it.
  const AxisFigures* figures = probe.figures(axis);
  if (all.empty() || (figures != nullptr && figures->is_held_from_some_side)) result.most = solver::infinity;
  return result;
}

}  // namespace

void ask_press(const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) {
    if (axis.driver != solver::Quantity::force || !axis.target || *axis.target == 0.0) continue;
    const AxisFigures* figures = probe.figures(axis);
    if (figures == nullptr || !figures->is_reachable || !std::isfinite(figures->mass)) continue;
    const double wanted = std::abs(*axis.target);
    const Pressing now = pressing(plan, axis, *axis.target, probe);
    if (now.by_motors) continue;
    const AccelerationLimit limit = acceleration_limit(plan, axis, *axis.target < 0.0 ? -1.0 : 1.0, true);
    const Span limited = limit.from != nullptr ? limit.from->span(solver::Quantity::acceleration) : Span{};
    // Of the configuration that presses so, where they differ.
    const auto mass_at = [&](double pressed) {
      const double mass = pressed / limit.most;
      const bool is_of_one =
          mass >= figures->least_mass * (1.0 - 1e-3) && mass <= figures->most_mass * (1.0 + 1e-3);
      return is_of_one ? mass : figures->mass;
    };
    const wording::Cap cap{axis.path, axis.turns(), wanted, now.most, mass_at(now.most)};
    if (now.most < wanted * (1.0 - tolerance)) {
      remarks.add(wording::cannot_press(axis.driver_span(), cap, limited));
      continue;
    }
    if (now.least < wanted * (1.0 - tolerance)) {
      remarks.add(wording::cannot_press_everywhere(
          axis.driver_span(), {axis.path, axis.turns(), wanted, now.least, mass_at(now.least)}, limited));
      continue;
    }
    const double farthest = axis.farthest_target.value_or(*axis.target);
    const Pressing end = pressing(plan, axis, farthest, probe);
    if (end.by_motors || end.most >= std::abs(farthest) * (1.0 - tolerance)) continue;
    remarks.add(wording::cannot_press_at_range_end(
        axis.driver_span(), {axis.path, axis.turns(), std::abs(farthest), end.most, figures->mass}, limited));
  }
}

}  // namespace zwang::lang
