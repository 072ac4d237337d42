// E601, W601: a force driver that an acceleration range keeps from pressing.
//
// The solver knows no contact: it predicts the acceleration f / m that the force would give in the open and
// holds it below a_max. Blocked, the robot presses with m times the acceleration that is left:
//
//   pressed = min(f, m a_max)         m = 1 / A Mc A', the effective mass along the axis
//
// taken from the solver with the force row and all acceleration ranges in force, so that ranges on other axes
// count with their direction. Along an axis of the world the base may press harder once it has turned than at
// the start pose.
//
// A drive that is sent torque limits keeps the range of velocities, too, within its horizon t. So it presses
// with m v_max / t at most.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_physics.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

constexpr double tolerance = 1e-6;  // relative
/// Masses and time constants are known no better: behind a late drive so much of the force is enough.
constexpr double enough_of_force = 0.95;

bool falls_short(const Pressed& pressed, double force) {
  return pressed.force < std::abs(force) * (1.0 - tolerance);
}

struct Pressing {
  Pressed least{.force = solver::infinity};  ///< of the configurations in which the motors do not give out
  Pressed most;                              ///< of all of them
  bool by_motors = false;                    ///< in all it is the motors that give out: W606 says that
};

Pressing pressing(const PlannedTask& plan, const PlannedAxis& axis, double force, Probe& probe) {
  const auto is_less = [](const Pressed& a, const Pressed& b) { return a.force < b.force; };
  Pressing result;
  const std::vector<Pressed> all = probe.pressed(axis, force, plan.axes);
  for (const Pressed& one : all) {
    result.most = std::max(result.most, one, is_less);
    if (one.force < one.motors * (1.0 - 1e-3)) result.least = std::min(result.least, one, is_less);
  }
  result.by_motors = !std::isfinite(result.least.force);
  if (axis.is_headed_anyhow() && !result.by_motors && falls_short(result.most, force)) {
    for (const Pressed& one : probe.pressed_whatever_way(axis, force, plan.axes))
      result.most = std::max(result.most, one, is_less);
    if (!axis.is_placed) result.least = result.most;
  }
  // Towards a side that the wheels hold the mass grows without bound, and m a_max with it.
  const AxisFigures* figures = probe.figures(axis);
  if (all.empty() || (figures != nullptr && figures->is_held_from_some_side))
    result.most.force = solver::infinity;
  return result;
}

/// Of a point beside the middle, whose mass is less while nothing holds the heading, that of the base itself.
double most_mass(const PlannedAxis& axis, const AxisFigures& figures, Probe& probe) {
  PlannedAxis of_base = axis;
  if (axis.move.body == 0) of_base.move.pose = {};
  const AxisFigures* whole = probe.figures(of_base);
  return std::max(figures.most_mass, whole != nullptr ? whole->most_mass : 0.0);
}

/// Behind a drive that is sent torque limits, the axis's own range of velocities bounds its force.
void ask_speed_of_press(const PlannedAxis& axis, const AxisFigures& figures, Probe& probe, Remarks& remarks) {
  const Drive& drive = probe.robot().drive;
  const auto& range = axis[solver::Quantity::velocity];
  if (!range || !drive.takes_velocity || drive.has_virtual_robot()) return;
  const double mass = most_mass(axis, figures, probe);
  if (!std::isfinite(mass)) return;
  const double speed = *axis.target < 0.0 ? -range->low : range->high;
  const double most = mass * speed / drive.horizon();
  if (most >= enough_of_force * std::abs(*axis.target)) return;
  remarks.add(wording::too_slow_to_press(axis.driver_span(),
                                         {axis.path, axis.turns(), std::abs(*axis.target), most, mass},
                                         drive.horizon(), axis.span(solver::Quantity::velocity)));
}

bool limits_acceleration(const PlannedTask& plan) {
  return std::any_of(plan.axes.begin(), plan.axes.end(), [](const PlannedAxis& axis) {
    return axis[solver::Quantity::acceleration].has_value();
  });
}

}  // namespace

void ask_press(const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) {
    if (axis.driver != solver::Quantity::force || !axis.target || *axis.target == 0.0) continue;
    const AxisFigures* figures = probe.figures(axis);
    if (figures == nullptr || !figures->is_reachable || !std::isfinite(figures->mass)) continue;
    const Pressing now = pressing(plan, axis, *axis.target, probe);
    if (now.by_motors) continue;
    ask_speed_of_press(axis, *figures, probe, remarks);
    if (!limits_acceleration(plan)) continue;  // what is short then goes to a row that no motor can follow
    const AccelerationLimit limit = acceleration_limit(plan, axis, *axis.target < 0.0 ? -1.0 : 1.0, true);
    const Span limited = limit.from != nullptr ? limit.from->span(solver::Quantity::acceleration) : Span{};
    const auto cap = [&](double wanted, const Pressed& pressed) {
      return wording::Cap{axis.path,     axis.turns(), std::abs(wanted),
                          pressed.force, pressed.mass, pressed.motors};
    };
    if (falls_short(now.most, *axis.target)) {
      remarks.add(wording::cannot_press(axis.driver_span(), cap(*axis.target, now.most), limited));
      continue;
    }
    if (falls_short(now.least, *axis.target)) {
      remarks.add(
          wording::cannot_press_everywhere(axis.driver_span(), cap(*axis.target, now.least), limited));
      continue;
    }
    const double farthest = axis.farthest_target.value_or(*axis.target);
    const Pressing end = pressing(plan, axis, farthest, probe);
    if (!end.by_motors && falls_short(end.most, farthest))
      remarks.add(wording::cannot_press_at_range_end(axis.driver_span(), cap(farthest, end.most), limited));
  }
}

}  // namespace zwang::lang
