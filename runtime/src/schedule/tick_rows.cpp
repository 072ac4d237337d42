// Step 7 of the tick: the constraints of the active task, of `always`, and of what fades.
#include <algorithm>
#include <cmath>

#include "schedule/parts.hpp"

namespace zwang::runtime {

namespace {

using lang::AxisStatements;
using solver::Axis;
using solver::Quantity;
using solver::Range;

bool is_rotation(Axis axis) {
  return axis >= Axis::rx;
}

bool says_something(const AxisStatements& axis) {
  return axis.driver || axis.position || axis.velocity || axis.acceleration;
}

}  // namespace

solver::AttachedFrame Scheduler::Parts::axes_frame(const lang::Group& group,
                                                   const ActiveAxis* a) const noexcept {
  if (a != nullptr && a->entry_axes) return *a->entry_axes;
  return frames.attached(group.in);
}

Range Scheduler::Parts::value(const lang::ValueRange& range) const noexcept {
  return {range.low.evaluate(parameters), range.high.evaluate(parameters)};
}

/// a_brk of a position range: what the axis's own acceleration range allows, else the robot's; never more
/// than the force range can do to the robot's mass.
double Scheduler::Parts::braking_of(const AxisStatements& a, const solver::AxisConstraint& c) const noexcept {
  const bool turns = is_rotation(a.axis);
  double braking = turns ? stop.deceleration / radius : stop.deceleration;
  if (c.acceleration) {
    braking = std::min(-c.acceleration->low, c.acceleration->high);
  } else {
    for (const lang::BaseLimit& limit : limits) {
      if (limit.quantity == Quantity::acceleration && is_rotation(limit.axis) == turns) {
        braking = std::min({braking, -limit.range.low, limit.range.high});
      }
    }
  }
  if (!turns && a.force) {
    const Range force = value(*a.force);
    braking = std::min({braking, -force.low / model.total_mass(), force.high / model.total_mass()});
  }
  return std::max(braking, 1e-3);
}

/// The driver as the task has it; where its axes or its value are not known, one that stands still with the
/// same force, or one that lets go.
solver::Driver Scheduler::Parts::driver_of(const ActiveAxis& a) const noexcept {
  const AxisStatements& s = statements(a);
  solver::Driver driver;
  driver.quantity = *s.driver;
  driver.time_constant = s.time_constant.evaluate(parameters);
  if (s.force) driver.force = value(*s.force);
  const bool pushes = driver.quantity == Quantity::force;
  if (a.lost && !(pushes && s.target.signal < 0)) {
    if (!pushes) driver.quantity = Quantity::velocity;
    driver.target = 0.0;
    return driver;
  }
  driver.target = s.target.evaluate(parameters);
  if (s.target.signal >= 0) driver.target = signals.value(s.target.signal);
  if (s.here) driver.target = a.here;
  return driver;
}

Wanted Scheduler::Parts::wanted_of(const ActiveAxis& a) const noexcept {
  const AxisStatements& s = statements(a);
  const lang::Group& g = group(a.origin);
  Wanted w;
  w.origin = a.origin;
  w.always = a.origin.task == tasks.always();
  w.move = {g.move, frames.settings_of(g.move)};
  if (!a.entry_axes) w.in = {g.in, frames.settings_of(g.in)};
  solver::AxisConstraint& c = w.constraint;
  c.move = frames.attached(g.move);
  c.in = axes_frame(g, &a);
  c.axis = s.axis;
  c.level = s.level;
  if (s.acceleration) c.acceleration = value(*s.acceleration);
  if (s.driver) c.driver = driver_of(a);
  // In axes that nobody knows, a range of places or of speeds allows no motion.
  const bool blind = !is_known(g.in);
  if (s.position && !blind) c.position = value(*s.position);
  if (s.velocity && !blind) c.velocity = value(*s.velocity);
  const bool stands_by_driver = s.driver && *s.driver != Quantity::force;
  if (blind && (s.position || s.velocity) && !stands_by_driver) c.velocity = Range{0.0, 0.0};
  if (c.position) c.braking = braking_of(s, c);
  return w;
}

/// The constraints of `always` and of the active task, with the present values of the parameters.
void Scheduler::Parts::want() noexcept {
  wanted.clear();
  for (const ActiveAxis& a : axes) {
    if (says_something(statements(a))) wanted.push_back(wanted_of(a));
  }
}

void Scheduler::Parts::start_blend() noexcept {
  for (ActiveAxis& a : axes) {
    const int value_signal = statements(a).target.signal;
    a.lost = !is_known(group(a.origin).in) || (value_signal >= 0 && !signals.known(value_signal));
  }
  want();
  switched = now;
  blend_time = active().blend.evaluate(parameters);
  blend->start(wanted, blend_time);
}

/// A signal that is lost or found changes what drives an axis. That is a switch like any other.
void Scheduler::Parts::track_losses() noexcept {
  bool changed = false;
  for (ActiveAxis& a : axes) {
    const int value_signal = statements(a).target.signal;
    const bool lost = !is_known(group(a.origin).in) || (value_signal >= 0 && !signals.known(value_signal));
    changed = changed || lost != a.lost;
    if (!lost) capture_here(a);
  }
  if (changed) start_blend();
}

void Scheduler::Parts::put_constraints() noexcept {
  want();
  // The tick of the switch already goes one tick's way, so that no alpha is ever 0.
  double progress = blend_time > 0.0 ? (now - switched + period) / blend_time : 1.0;
  if ((1.0 - progress) * blend_time < clock_rounding * period) progress = 1.0;
  blend->put(wanted, progress, *set, in_force);
}

/// What the solver made of the rows, for the guards of the next tick.
void Scheduler::Parts::read(const solver::Solution& solution) noexcept {
  const std::vector<solver::Row>& rows = set->rows();
  for (ActiveAxis& a : axes) {
    if (!statements(a).driver) a.reading = {};
  }
  const std::size_t count = std::min(rows.size(), solution.rows.size());
  for (std::size_t i = 0; i < count; ++i) {
    const int c = rows[i].constraint;
    if (c < 0 || static_cast<std::size_t>(c) >= in_force.size()) continue;
    const InForce& source = in_force[static_cast<std::size_t>(c)];
    if (!source.active) continue;
    const bool is_driver = rows[i].kind == solver::RowKind::driver || rows[i].kind == solver::RowKind::force;
    for (ActiveAxis& a : axes) {
      if (a.origin != source.origin) continue;
      if (is_driver) {
        a.reading = {solution.rows[i].nu, solution.rows[i].residual, solution.rows[i].saturated};
      } else if (!statements(a).driver &&
                 std::abs(solution.rows[i].residual) > std::abs(a.reading.residual)) {
        a.reading.residual = solution.rows[i].residual;
      }
    }
  }
}

}  // namespace zwang::runtime
