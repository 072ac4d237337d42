#include "zwang/solver/constraint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "constraint/measure.hpp"

namespace zwang::solver {

namespace {

double wrap_to_pi(double angle) {
  return std::remainder(angle, 2.0 * std::numbers::pi);
}

/// The unit constraint force of a measurement at F's origin, in the coordinates of a body and about its
/// origin.
ForceVector on_body(const Measurement& along, const Vector3& origin, const Pose& body) {
  const Vector3 force = body.rotation.transpose() * along.force;
  const Vector3 arm = body.rotation.transpose() * (origin - body.position);
  return {body.rotation.transpose() * along.moment + arm.cross(force), force};
}

double position_error(double target, const Coordinate& now, const AxisConstraint& constraint) {
  const bool wraps = constraint.measure == Measure::axis && is_rotation(constraint.axis);
  return wraps ? wrap_to_pi(target - now.position) : target - now.position;
}

double driver_acceleration(const Driver& driver, const Coordinate& now, const AxisConstraint& constraint) {
  const double w = 1.0 / driver.time_constant;
  switch (driver.quantity) {
    case Quantity::acceleration:
      return driver.target;
    case Quantity::velocity:
      return w * (driver.target - now.velocity) + driver.target_rate;
    case Quantity::position:
      return w * w * position_error(driver.target, now, constraint) +
             2.0 * w * (driver.target_rate - now.velocity) + driver.target_acceleration;
    case Quantity::force:
      break;
  }
  return 0.0;
}

/// f of a force driver or a spring, inside the force ranges.
double driver_force(const Driver& driver, const Coordinate& now, const AxisConstraint& constraint) {
  double f = driver.target;
  if (driver.quantity == Quantity::position) {
    f = driver.stiffness * position_error(driver.target, now, constraint) +
        driver.damping * (driver.target_rate - now.velocity);
  }
  f = std::max(driver.force.low, std::min(f, driver.force.high));
  if (constraint.force) f = std::max(constraint.force->low, std::min(f, constraint.force->high));
  return f;
}

/// The accelerations with which a range is kept, or met again within h.
Range acceleration_range_within(const AxisConstraint& constraint, Quantity quantity, const Coordinate& now,
                                double h) {
  Range range;
  if (quantity == Quantity::acceleration && constraint.acceleration) return *constraint.acceleration;
  if (quantity == Quantity::velocity && constraint.velocity) {
    range.low = (constraint.velocity->low - now.velocity) / h;
    range.high = (constraint.velocity->high - now.velocity) / h;
  }
  if (quantity == Quantity::position && constraint.position) {
    const double to_high = constraint.position->high - now.position;
    const double to_low = now.position - constraint.position->low;
    range.high = (braking_speed(to_high, constraint.braking, h) - now.velocity) / h;
    range.low = (-braking_speed(to_low, constraint.braking, h) - now.velocity) / h;
  }
  return range;
}

/// The accelerations that a range allows now. One that is new, h longer than the horizon, has time to stop
/// what is beyond it; what is inside it holds back no more than later: max(e/h, e/h0) of what is left, e >= 0
/// or not.
Range acceleration_range(const AxisConstraint& constraint, Quantity quantity, const Coordinate& now,
                         double h) {
  constexpr double h0 = ConstraintSet::horizon;
  const Range in_time = acceleration_range_within(constraint, quantity, now, h);
  if (h <= h0) return in_time;
  const Range at_once = acceleration_range_within(constraint, quantity, now, h0);
  return {std::min(in_time.low, at_once.low), std::max(in_time.high, at_once.high)};
}

/// Later ones win where ranges contradict.
constexpr std::array ranges_in_rising_rank{Quantity::position, Quantity::velocity, Quantity::acceleration};

double mix(double before, double now, double progress) {
  return before + progress * (now - before);
}

}  // namespace

double braking_speed(double distance, double braking, double h) noexcept {
  const double a = braking_share * braking;
  const double T = 4.0 * h;
  const double d0 = a * T * T;
  const double d = std::abs(distance);
  const double speed = d < d0 ? d / T : std::sqrt(2.0 * a * (d - 0.5 * d0));
  return std::copysign(speed, distance);
}

Coordinate coordinate_of(const AxisConstraint& constraint, const Model& model, const State& state) noexcept {
  return measure(constraint, motion_of(constraint.move, model, state), motion_of(constraint.in, model, state))
      .now;
}

Coordinate coordinate_of(const AxisConstraint& constraint, BodyMotions& motions) noexcept {
  FrameMotion move, in;
  return measure(constraint, motions.of(constraint.move, move), motions.of(constraint.in, in)).now;
}

Coordinate coordinate_of(const AttachedFrame& move, const AttachedFrame& in, Axis axis, const Model& model,
                         const State& state) noexcept {
  AxisConstraint constraint;
  constraint.move = move;
  constraint.in = in;
  constraint.axis = axis;
  return coordinate_of(constraint, model, state);
}

ConstraintSet::ConstraintSet(int constraint_capacity, int row_capacity)
    : motions_(2 * static_cast<std::size_t>(std::max(constraint_capacity, 0))) {
  if (constraint_capacity < 1 || row_capacity < 1) {
    throw std::invalid_argument("constraint set: capacities must be at least 1");
  }
  constraints_.reserve(static_cast<std::size_t>(constraint_capacity));
  coordinates_.reserve(static_cast<std::size_t>(constraint_capacity));
  rows_.reserve(static_cast<std::size_t>(row_capacity));
}

void ConstraintSet::clear() noexcept {
  constraints_.clear();
  coordinates_.clear();
  rows_.clear();
}

bool ConstraintSet::add(const AxisConstraint& constraint) noexcept {
  if (constraints_.size() == constraints_.capacity()) return false;
  constraints_.push_back(constraint);
  return true;
}

bool ConstraintSet::push(const Row& row) noexcept {
  if (rows_.size() == rows_.capacity()) return false;
  rows_.push_back(row);
  return true;
}

bool ConstraintSet::fill(const Model& model, const State& state) noexcept {
  motions_.start(model, state);
  return fill(motions_);
}

bool ConstraintSet::fill(BodyMotions& motions) noexcept {
  coordinates_.clear();
  rows_.clear();
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    if (!fill_one(static_cast<int>(i), motions)) return false;
  }
  return true;
}

bool ConstraintSet::fill_one(int index, BodyMotions& motions) noexcept {
  const AxisConstraint& constraint = constraints_[static_cast<std::size_t>(index)];
  FrameMotion move, in;
  const FrameMotion& f = motions.of(constraint.move, move);
  const FrameMotion& t = motions.of(constraint.in, in);
  const Measurement along = measure(constraint, f, t);
  const Coordinate& now = along.now;
  coordinates_.push_back(now);
  const bool gone = constraint.leaving && constraint.alpha <= 0.0;
  const bool at_rest = constraint.measure == Measure::speed &&
                       !(constraint.velocity && now.velocity >= 0.5 * constraint.velocity->high);
  if (gone || at_rest) return true;

  Row row;
  row.constraint = index;
  row.level = constraint.level;
  row.weight = constraint.weight;
  const auto unit_force = [&](int body) { return on_body(along, f.pose.position, motions.of(body).pose); };
  const bool relative = constraint.in.body >= 0 && !only_orients(constraint.move, constraint.in);
  if (constraint.move.body >= 0) {
    row.body = constraint.move.body;
    row.a = unit_force(row.body);
    if (relative) {
      row.reference_body = constraint.in.body;
      row.a_reference = unit_force(row.reference_body);
    }
  } else if (relative) {  // F belongs to the world: only T's body can follow
    row.body = constraint.in.body;
    row.a = -unit_force(row.body);
  } else {
    return true;
  }

  // One-sided rows enter at once, with a longer horizon while they are new, and leave softly.
  const double h =
      constraint.leaving ? horizon : std::max(horizon, (1.0 - constraint.alpha) * constraint.blend);
  if (constraint.driver && constraint.alpha > 0.0 && !push_driver(constraint, now, h, row)) return false;
  const bool folds = constraint.driver && !constraint.driver->makes_force();
  if (folds) return true;
  row.fade = constraint.leaving ? constraint.alpha : 1.0;
  if (constraint.force && !constraint.driver) {
    Row sum = row;
    sum.kind = RowKind::sum;
    sum.quantity = Quantity::force;
    sum.lo = constraint.force->low;
    sum.hi = constraint.force->high;
    if (!push(sum)) return false;
  }
  return push_ranges(constraint, now, h, row);
}

/// The row of the driver, the ranges of its axis folded into a motion driver.
bool ConstraintSet::push_driver(const AxisConstraint& constraint, const Coordinate& now, double h,
                                Row row) noexcept {
  const Driver& driver = *constraint.driver;
  const Driver& before = constraint.before ? *constraint.before : driver;
  const double progress = constraint.before ? constraint.progress : 1.0;
  row.quantity = driver.quantity;
  row.fade = constraint.alpha;
  row.lo = std::max(driver.force.low, before.force.low);
  row.hi = std::min(driver.force.high, before.force.high);
  if (constraint.force) {
    row.lo = std::max(row.lo, constraint.force->low);
    row.hi = std::min(row.hi, constraint.force->high);
  }
  if (driver.makes_force()) {
    row.kind = RowKind::force;
    row.force = mix(driver_force(before, now, constraint), driver_force(driver, now, constraint), progress);
    return push(row);
  }
  double b = mix(driver_acceleration(before, now, constraint), driver_acceleration(driver, now, constraint),
                 progress);
  for (const Quantity quantity : ranges_in_rising_rank) {
    const Range range = acceleration_range(constraint, quantity, now, h);
    b = std::max(range.low, std::min(b, range.high));
  }
  row.kind = RowKind::driver;
  row.b = b - now.acceleration_bias;
  return push(row);
}

/// Two one-sided rows a range.
bool ConstraintSet::push_ranges(const AxisConstraint& constraint, const Coordinate& now, double h,
                                Row row) noexcept {
  for (const Quantity quantity : ranges_in_rising_rank) {
    const Range range = acceleration_range(constraint, quantity, now, h);
    row.quantity = quantity;
    if (std::isfinite(range.high)) {
      row.kind = RowKind::upper;
      row.b = range.high - now.acceleration_bias;
      row.lo = -infinity;
      row.hi = 0.0;
      if (!push(row)) return false;
    }
    if (std::isfinite(range.low) && constraint.measure != Measure::speed) {
      row.kind = RowKind::lower;
      row.b = range.low - now.acceleration_bias;
      row.lo = 0.0;
      row.hi = infinity;
      if (!push(row)) return false;
    }
  }
  return true;
}

}  // namespace zwang::solver
