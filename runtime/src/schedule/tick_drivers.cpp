// Step 8 of the tick: drivers; among them those that give way to a force, and those that add up their error.
//
// A driver that yields asks for
//
//   dds = (F~ - D ds)/M - F/Lambda,        F~: what F has beyond the dead band
//
// F itself moves the robot by F/Lambda, so that (F~ - D ds)/M is what comes of both. Lambda is the effective
// mass along the axis, of the last tick. The virtual robot of a drive that takes velocities feels no F.
//
// A driver with `build_up: t` adds q to its target: dq = (v - ds)/t, of a position (p - s)/t. While its row
// does not get what it asks, or a range holds it, q goes nowhere but back. Beyond v, `added_to` lets q fade.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "schedule/parts.hpp"

namespace zwang::runtime {

namespace {

using solver::Quantity;
using solver::Range;

/// The part of `force` beyond the dead band around 0.
double beyond(double force, double dead_band) {
  return std::copysign(std::max(0.0, std::abs(force) - dead_band), force);
}

/// The acceleration that the driver asks for without any range.
double asked_by(const solver::Driver& driver, double error, const solver::Coordinate& now) {
  const double w = 1.0 / driver.time_constant;
  return driver.quantity == Quantity::velocity ? w * error : w * w * error - 2.0 * w * now.velocity;
}

}  // namespace

/// The driver of the task. If its axes or its value are not known, it is a driver that stands still with the
/// same force, or one that lets go.
solver::Driver Scheduler::Parts::driver_of(ActiveAxis& a) const noexcept {
  const lang::AxisStatements& s = *a.says;
  solver::Driver driver;
  driver.quantity = *s.driver;
  driver.time_constant = s.time_constant.evaluate(parameters);
  if (s.stiffness) driver.stiffness = s.stiffness->evaluate(parameters);
  if (s.damping) driver.damping = s.damping->evaluate(parameters);
  if (s.force) driver.force = value(*s.force);
  if (s.yield && !a.lost) {
    yield(a, driver);
    return driver;
  }
  const bool is_force = driver.quantity == Quantity::force;
  const bool has_axis = was_seen(a.group->in) && was_seen(a.group->move);
  if (a.lost && !(is_force && has_axis && s.target.signal < 0)) {
    if (!is_force) driver.quantity = Quantity::velocity;
    driver.stiffness = driver.damping = 0.0;
    driver.target = 0.0;
    return driver;
  }
  driver.target = s.target.evaluate(parameters);
  if (s.target.signal >= 0) driver.target = signals.value(s.target.signal);
  if (s.here) driver.target = a.here;
  a.added = s.build_up ? added_to(driver, a) : 0.0;
  driver.target += a.added;
  return driver;
}

/// q of a velocity v fades out as the speed ds goes beyond v the way that q pushes, and is gone at v + e:
///   phi q,   phi = 1 - (ds - v) / e,   e = max(10 % of v, 5 mm/s).
/// At v + e the driver brakes, whatever is in tow: what was added up to start a load does not overshoot by
/// more than e.
double Scheduler::Parts::added_to(const solver::Driver& driver, const ActiveAxis& a) const noexcept {
  constexpr double share = 0.1, rolls = 5e-3, turns = 0.05;  // [1], [m/s], [rad/s]
  if (driver.quantity != Quantity::velocity) return a.built_up;
  const bool is_angle = wanted[a.wanted].constraint.is_angle();
  const double most = std::max(share * std::abs(driver.target), is_angle ? turns : rolls);
  const double beyond_target = coordinate_of(*a.group, *a.says, &a).velocity - driver.target;
  return std::clamp(1.0 - std::copysign(beyond_target, beyond_target * a.built_up) / most, 0.0, 1.0) *
         a.built_up;
}

/// F [N] or [N m]; NaN: not known.
double Scheduler::Parts::pushed_with(const ActiveAxis& a) const noexcept {
  const lang::Condition& force = a.says->yield->force;
  evaluate(force, a.origin.task, *this, pushing);
  return pushing[force.nodes.size() - 1];
}

void Scheduler::Parts::yield(const ActiveAxis& a, solver::Driver& driver) const noexcept {
  const lang::Yield& says = *a.says->yield;
  const double force = pushed_with(a);
  if (std::isnan(force)) {
    driver.quantity = Quantity::velocity;
    driver.target = 0.0;
    return;
  }
  const double speed = coordinate_of(*a.group, *a.says, &a).velocity;
  const double mass = says.mass.evaluate(parameters);
  const double damping = says.damping.evaluate(parameters);
  driver.target = (beyond(force, says.dead_band.evaluate(parameters)) - damping * speed) / mass;
  if (feels_pushes) driver.target -= force * a.inverse_mass;
}

/// Whether a row of the base yields at all; then `pushes` is set. A base that goes against the force at
/// `against` or faster, as before a hit, gets none of it.
bool Scheduler::Parts::find_pushes() noexcept {
  constexpr double against = 0.01, turns_against = 0.05;  // [m/s], [rad/s]
  pushes.setZero();
  if (!feels_pushes) return false;
  bool yields = false;
  const solver::Vector3 velocity{state->base_twist.linear.x(), state->base_twist.linear.y(),
                                 state->base_twist.angular.z()};
  for (const ActiveAxis& a : axes) {
    const int i = a.says->yield ? base_direction(*a.group, *a.says) : -1;
    if (i < 0 || i == both_axes) continue;
    yields = true;
    const double push = pushed_with(a) * a.inverse_mass;
    const double with = std::copysign(1.0, push) * velocity(i) / (i == 2 ? turns_against : against);
    if (std::isfinite(push)) pushes(i) += std::clamp(1.0 + with, 0.0, 1.0) * push;
  }
  return yields;
}

/// A range of accelerations is the base's, and a person who pushes it has a share of them. The motors may
/// hold against that share on top. They may not push beyond the range along with it.
Range Scheduler::Parts::with_what_pushes(Range acceleration, int base_axis) const noexcept {
  if (base_axis < 0 || base_axis == both_axes) return acceleration;
  const double push = pushes(base_axis);
  return {acceleration.low - std::max(0.0, push), acceleration.high - std::min(0.0, push)};
}

/// The driver's error with what was built up: v + q - ds, or p + q - s.
double Scheduler::Parts::error_of(const ActiveAxis& a, const solver::Driver& driver,
                                  const solver::Coordinate& motion) const noexcept {
  if (driver.quantity == Quantity::velocity) return driver.target - motion.velocity;
  const double error = driver.target - motion.position;
  return wanted[a.wanted].constraint.wraps() ? std::remainder(error, 2.0 * std::numbers::pi) : error;
}

/// The speed at which the driver would settle is that of motion: v of a velocity, e / (2 T) of a position
/// that is off by e. A force or a spring pulls, and asks for none.
bool Scheduler::Parts::asks_for_motion_of(const ActiveAxis& a) const noexcept {
  constexpr double rolls = 0.01, turns = 0.1;  // [m/s], [rad/s]
  const solver::AxisConstraint& constraint = wanted[a.wanted].constraint;
  if (a.row < 0 || !constraint.driver || constraint.driver->makes_force()) return false;
  const solver::Driver& driver = *constraint.driver;
  double speed = driver.target;
  if (driver.quantity == Quantity::position) {
    const solver::ConstraintSet& set = blend->sets()[0].constraints;
    const solver::Row& row = set.rows()[static_cast<std::size_t>(a.row)];
    const solver::Coordinate& motion = set.coordinates()[static_cast<std::size_t>(row.constraint)];
    speed = error_of(a, driver, motion) / (2.0 * driver.time_constant);
  }
  const bool has_speed = driver.quantity == Quantity::velocity || driver.quantity == Quantity::position;
  return has_speed && std::abs(speed) > (constraint.is_angle() ? turns : rolls);
}

void Scheduler::Parts::build_up(ActiveAxis& a) noexcept {
  constexpr double same = 1e-9;
  const auto& constraint = wanted[a.wanted].constraint;
  if (a.row < 0 || a.lost || !constraint.driver) return;
  const solver::Driver& driver = *constraint.driver;
  const solver::ConstraintSet& set = blend->sets()[0].constraints;
  const solver::Row& row = set.rows()[static_cast<std::size_t>(a.row)];
  const solver::Coordinate& motion = set.coordinates()[static_cast<std::size_t>(row.constraint)];
  const double whole = error_of(a, driver, motion);
  const double asked = asked_by(driver, whole, motion);
  const bool is_held = std::abs(row.b + motion.acceleration_bias - asked) > same * (1.0 + std::abs(asked));
  const double error = whole - a.added;
  if ((is_held || !a.is_met) && error * a.built_up >= 0.0) return;
  a.built_up += error * period / a.says->build_up->evaluate(parameters);
  // What has faded is too much: it goes as quickly as the driver settles.
  a.built_up -= (a.built_up - a.added) * std::min(1.0, period / driver.time_constant);
}

}  // namespace zwang::runtime
