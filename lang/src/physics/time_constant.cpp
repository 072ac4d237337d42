// W604: a time constant that is too short, a spring that is too stiff.
//
// A critically damped approach comes in at the v of the velocity range, or of the planar speed. It brakes
// hardest one time constant after the range let go, with
//
//   a = v / (e tau)        e = 2.718...
//
// The acceleration range, or the force range over the effective mass, must allow that. So must a force range
// of an axis without a driver, which bounds the sum of all rows. Else the base overshoots.
//
// Whatever drives, the ticks of the robot file's `control_period` dt must follow it. One tick passes
// between sensing and torque, so a velocity error decays as z^2 - z + dt/tau = 0, without oscillation from
// tau = 4 dt on. A position driver damps with 2/tau instead of 1/tau, so its bound is tau = 8 dt.
//
// A spring of stiffness k and damping d on the mass m damps with d/m, without oscillation up to d = m / (4
// dt). With the same tick between sensing and torque it follows
//
//   z^3 - 2 z^2 + (1 + a + b) z - a = 0,   a = d dt/m,   b = k dt^2/m
//
// By Jury's criterion that decays as long as b < a (1 - a):
//
//   k dt < d (1 - d dt/m)
#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnostic/wordings_forces.hpp"
#include "diagnostic/wordings_physics.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

void ask_tick(const PlannedAxis& axis, double dt, Remarks& remarks) {
  if (axis.driver == solver::Quantity::acceleration) return;
  const double least = (axis.driver == solver::Quantity::position ? 8.0 : 4.0) * dt;
  if (axis.time_constant >= least) return;
  remarks.add(
      wording::faster_than_the_tick(axis.time_constant_span, axis.path, axis.time_constant, dt, least));
}

/// Let z = 1/T. The characteristic equation has real roots:
///   velocity   s^2 + z s + z/t = 0                  from t = 4 T on
///   position   s^3 + 2 z s^2 + z^2 s + z^2/t = 0    from t = 6.75 T on
void ask_build_up(const PlannedAxis& axis, Remarks& remarks) {
  // An acceleration has no error to add up: E104.
  if (!axis.build_up || axis.driver == solver::Quantity::acceleration) return;
  const double least = (axis.driver == solver::Quantity::position ? 8.0 : 4.0) * axis.time_constant;
  if (*axis.build_up < least)
    remarks.add(wording::builds_up_too_fast(axis.build_up_span, axis.path, axis.time_constant, least));
}

void ask_braking(const PlannedTask& plan, const PlannedAxis& axis, Probe& probe, Remarks& remarks) {
  const double v = plan.speed_limit(axis);
  if (axis.driver != solver::Quantity::position || !std::isfinite(v)) return;
  const AxisFigures* figures = probe.figures(axis);
  if (figures == nullptr || !std::isfinite(figures->mass)) return;
  const double peak = v / (std::numbers::e * axis.time_constant);
  const AccelerationLimit forward = acceleration_limit(plan, axis, 1.0, true);
  const AccelerationLimit backward = acceleration_limit(plan, axis, -1.0, true);
  double allowed = std::min(forward.most, backward.most);
  bool by_force = false;
  if (const auto& force = axis[solver::Quantity::force]) {
    const double by_range = std::min(force->high, -force->low) / figures->mass;
    by_force = by_range < allowed;
    allowed = std::min(allowed, by_range);
  }
  const ForceLimit ahead = sum_limit(plan, axis, 1.0), back = sum_limit(plan, axis, -1.0);
  const ForceLimit& sum = ahead.most < back.most ? ahead : back;
  const bool by_sum = sum.most / figures->mass < allowed;
  if (by_sum) allowed = sum.most / figures->mass;
  // A range that allows nothing at all holds the axis on purpose.
  if (peak <= allowed || !(allowed > 0.0)) return;
  remarks.add(wording::brakes_too_hard(
      axis.time_constant_span, axis.path, axis.turns(),
      {v, axis.time_constant, peak, allowed, figures->mass, by_force || by_sum, by_sum ? sum.from->path : ""},
      v / (std::numbers::e * allowed)));
}

void ask_spring(const PlannedAxis& axis, Probe& probe, Remarks& remarks) {
  if (!axis.stiffness || !axis.damping) return;
  const AxisFigures* figures = probe.figures(axis);
  if (figures == nullptr || !std::isfinite(figures->least_mass) || !(figures->least_mass > 0.0)) return;
  const double k = *axis.stiffness, d = *axis.damping, m = figures->least_mass;
  const double dt = probe.robot().control_period;
  const double most_damping = m / (4.0 * dt);
  if (d > most_damping) {
    remarks.add(wording::damped_too_hard(axis.damping_span, axis.path, axis.turns(), m, dt, most_damping));
    return;
  }
  const double most_stiffness = d * (1.0 - d * dt / m) / dt;
  if (k >= most_stiffness)
    remarks.add(wording::too_stiff(axis.stiffness_span, axis.path, axis.turns(), m, dt, most_stiffness));
}

}  // namespace

void ask_time_constant(const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) {
    if (axis.is_spring) ask_spring(axis, probe, remarks);
    if (!axis.drives_motion() || !(axis.time_constant > 0.0)) continue;
    ask_build_up(axis, remarks);
    ask_tick(axis, probe.robot().control_period, remarks);
    ask_braking(plan, axis, probe, remarks);
  }
}

}  // namespace zwang::lang
