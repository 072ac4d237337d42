// W606: a driver that asks for more than the motors make along its axis.
//
//   force f             f
//   acceleration c      m |c|
//   velocity v          m |v| / tau, from rest
//
// each within the axis's own force range and the acceleration ranges in force; against the largest force phi
// f that the solver finds within the torque limits.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_physics.hpp"
#include "physics/statics.hpp"

namespace zwang::lang {

double asked_force(const PlannedTask& plan, const PlannedAxis& axis, double mass) {
  const double target = *axis.target;
  const double most = acceleration_limit(plan, axis, target, true).most;
  double force = std::abs(target);
  if (axis.driver == solver::Quantity::acceleration) force = mass * std::min(std::abs(target), most);
  if (axis.driver == solver::Quantity::velocity) {
    force = mass * std::min(std::abs(target) / axis.time_constant, most);
  }
  if (axis.driver == solver::Quantity::force) return force;
  if (const auto& range = axis[solver::Quantity::force]) {
    force = std::min(force, target > 0.0 ? range->high : -range->low);
  }
  return force;
}

void ask_wheel_torque(const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) {
    const bool asks = axis.driver && axis.driver != solver::Quantity::position && !axis.is_soft &&
                      axis.target && *axis.target != 0.0 && axis.time_constant > 0.0 &&
                      !remarks.any_at(axis.driver_span());
    const AxisFigures* figures = asks ? probe.figures(axis) : nullptr;
    if (figures == nullptr || !figures->is_reachable) continue;
    bool ever = false, always = true;
    double worst = 0.0, worst_force = 0.0, worst_mass = 0.0;
    for (std::size_t i = 0; i < figures->masses.size(); ++i) {
      if (!std::isfinite(figures->masses[i]) || !(figures->forces[i] > 0.0)) continue;
      const double force = asked_force(plan, axis, figures->masses[i]);
      const bool is_beyond = force > figures->forces[i] * (1.0 + 1e-6);
      ever = ever || is_beyond;
      always = always && is_beyond;
      if (is_beyond && force / figures->forces[i] > worst) {
        worst = force / figures->forces[i];
        worst_force = figures->forces[i];
        worst_mass = figures->masses[i];
      }
    }
    if (!ever) continue;
    const bool is_force = axis.driver == solver::Quantity::force;
    const double time_constant =
        axis.driver == solver::Quantity::velocity ? worst_mass * std::abs(*axis.target) / worst_force : 0.0;
    remarks.add(wording::beyond_the_motors(axis.driver_span(), axis.path, axis.turns(), worst * worst_force,
                                           worst_force, is_force ? 0.0 : worst_mass, time_constant, always));
  }
}

}  // namespace zwang::lang
