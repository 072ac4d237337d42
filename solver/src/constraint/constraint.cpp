#include "zwang/solver/constraint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "constraint/measure.hpp"

namespace zwang::solver {

namespace {

constexpr std::size_t most_measured = 12;  // axes to look at before one is measured again

double wrap_to_pi(double angle) {
  return std::remainder(angle, 2.0 * std::numbers::pi);
}

/// The unit constraint force of a measurement at F's origin, in the coordinates of a body and about its
/// origin.
ForceVector on_body(const Measurement& along, const Vector3& origin, const Pose& body) {
  const Vector3 moment = along.moment + (origin - body.position).cross(along.force);
  return {body.rotation.transpose() * moment, body.rotation.transpose() * along.force};
}

double position_error(double target, const Coordinate& now, const AxisConstraint& constraint) {
  return constraint.wraps() ? wrap_to_pi(target - now.position) : target - now.position;
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

bool has_range(const AxisConstraint& constraint, Quantity quantity) {
  switch (quantity) {
    case Quantity::position:
      return constraint.position.has_value();
    case Quantity::velocity:
      return constraint.velocity.has_value();
    case Quantity::acceleration:
      return constraint.acceleration.has_value();
    case Quantity::force:
      break;
  }
  return false;
}

bool contains(const Range& range, double value) {
  return range.low <= value && value <= range.high;
}

/// The largest acceleration towards a position bound, at the distance d before it and the speed v:
///   d >= 0   (v_brk(d) - v) / h
///   d < 0    an outward motion stops within h, -v / h; the way back starts with a_brk at most
double acceleration_towards(double d, double v, const AxisConstraint& constraint, double h) {
  const double on_curve = (approach_speed(d, constraint, h) - v) / h;
  return d >= 0.0 ? on_curve : std::min(-v / h, std::max(on_curve, -constraint.braking));
}

/// The accelerations with which a range that the constraint has is kept, or met again within h.
Range acceleration_range_within(const AxisConstraint& constraint, Quantity quantity, const Coordinate& now,
                                double h) {
  if (quantity == Quantity::acceleration) return *constraint.acceleration;
  if (quantity == Quantity::velocity) {
    return {(constraint.velocity->low - now.velocity) / h, (constraint.velocity->high - now.velocity) / h};
  }
  const double to_high = constraint.position->high - now.position;
  const double to_low = now.position - constraint.position->low;
  return {-acceleration_towards(to_low, -now.velocity, constraint, h),
          acceleration_towards(to_high, now.velocity, constraint, h)};
}

/// The accelerations that a range allows now. A new range has a longer horizon h, within which a motion
/// outside it stops. Inside, it holds back no more than later: max(e/h, e/h0) of the remaining e, whatever
/// the sign of e.
Range acceleration_range(const AxisConstraint& constraint, Quantity quantity, const Coordinate& now,
                         double h0) {
  const double h = quantity == Quantity::position ? constraint.position_horizon : constraint.velocity_horizon;
  const Range at_once = acceleration_range_within(constraint, quantity, now, h0);
  if (h <= h0) return at_once;
  const Range in_time = acceleration_range_within(constraint, quantity, now, h);
  return {std::min(in_time.low, at_once.low), std::max(in_time.high, at_once.high)};
}

/// Later ones win where ranges contradict.
constexpr std::array ranges_in_rising_rank{Quantity::position, Quantity::velocity, Quantity::acceleration};

/// `a`: its carried force.
Coordinate carried_coordinate(const AxisConstraint& constraint, const ForceVector& a, const MotionVector& V) {
  // s = w v is linear in each of w and v, so that a . V counts it twice.
  const double counted = constraint.measure == Measure::turn ? 0.5 : 1.0;
  return {.velocity = counted * dot(a, V), .acceleration_bias = carried_bias(constraint, a, V)};
}

/// Of a speed and of a turn: below half of the highest value no row is in force.
bool is_slow(const AxisConstraint& constraint, const Coordinate& now) {
  if (constraint.measure != Measure::speed && constraint.measure != Measure::turn) return false;
  return !(constraint.velocity && std::abs(now.velocity) >= 0.5 * constraint.velocity->high);
}

/// Puts into `row` the bodies that a constraint's unit force acts on, and the force.
/// False where it acts on none: nothing but the world is in it.
bool put_force(const AxisConstraint& constraint, const Measurement& along, const Vector3& origin,
               BodyMotions& motions, Row& row) {
  const auto unit_force = [&](int body) { return on_body(along, origin, motions.of(body).pose); };
  const bool is_relative = constraint.in.body >= 0 && !only_orients(constraint.move, constraint.in);
  if (constraint.move.body >= 0) {
    row.body = constraint.move.body;
    row.a = unit_force(row.body);
    if (is_relative) {
      row.reference_body = constraint.in.body;
      row.a_reference = unit_force(row.reference_body);
    }
  } else if (is_relative) {  // F belongs to the world: only T's body can follow
    row.body = constraint.in.body;
    row.a = -unit_force(row.body);
  }
  return constraint.move.body >= 0 || is_relative;
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

double approach_speed(double distance, const AxisConstraint& constraint, double h) noexcept {
  return std::max(braking_speed(distance, constraint.braking, h), -constraint.return_speed);
}

/// For v >= d0/T: v^2 = 2 a (d - d0/2).
double braking_distance(double speed, double braking, double h) noexcept {
  const double a = braking_share * braking;
  const double T = 4.0 * h;
  const double d0 = a * T * T;
  const double v = std::abs(speed);
  const double distance = v * T < d0 ? v * T : 0.5 * (v * v / a + d0);
  return std::copysign(distance, speed);
}

Coordinate coordinate_of(const AxisConstraint& constraint, const Model& model, const State& state) noexcept {
  if (is_carried(constraint)) {
    const FrameMotion body = motion_of({constraint.move.body, {}, {}}, model, state);
    const MotionVector V = body.own_twist();
    return carried_coordinate(constraint, carried_force(constraint, V), V);
  }
  return measure(constraint, motion_of(constraint.move, model, state), motion_of(constraint.in, model, state))
      .now;
}

Coordinate coordinate_of(const AxisConstraint& constraint, BodyMotions& motions) noexcept {
  if (is_carried(constraint)) {
    const MotionVector V = motions.twist_of(constraint.move.body);
    return carried_coordinate(constraint, carried_force(constraint, V), V);
  }
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

double position_of(const AttachedFrame& move, const AttachedFrame& in, Axis axis,
                   BodyMotions& motions) noexcept {
  if (only_orients(move, in)) return 0.0;
  Pose f, t;
  return measure_position(axis, motions.pose_of(move, f), motions.pose_of(in, t));
}

ConstraintSet::ConstraintSet(int constraint_capacity, int row_capacity, double horizon)
    : horizon_(horizon), motions_(2 * static_cast<std::size_t>(std::max(constraint_capacity, 0))) {
  if (constraint_capacity < 1 || row_capacity < 1) {
    throw std::invalid_argument("constraint set: capacities must be at least 1");
  }
  constraints_.reserve(static_cast<std::size_t>(constraint_capacity));
  carried_.reserve(static_cast<std::size_t>(constraint_capacity));
  measured_.reserve(most_measured);
  coordinates_.reserve(static_cast<std::size_t>(constraint_capacity));
  rows_.reserve(static_cast<std::size_t>(row_capacity));
}

void ConstraintSet::clear() noexcept {
  constraints_.clear();
  carried_.clear();
  coordinates_.clear();
  rows_.clear();
}

bool ConstraintSet::add(const AxisConstraint& constraint) noexcept {
  if (constraints_.size() == constraints_.capacity()) return false;
  constraints_.push_back(constraint);
  carried_.emplace_back();
  return true;
}

Row* ConstraintSet::push(const Row& row) noexcept {
  if (rows_.size() == rows_.capacity()) return nullptr;
  rows_.push_back(row);
  return &rows_.back();
}

bool ConstraintSet::fill(const Model& model, const State& state) noexcept {
  motions_.start(model, state);
  return fill(motions_);
}

/// A range beside a motion driver is kept by clamping the driver's target, while nothing else drives its
/// axis. A coordinate outside of a position range is driven back into it. Then the ranges are rows of their
/// own, too.
bool ConstraintSet::fill(BodyMotions& motions) noexcept {
  folds_ = true;
  if (!fill_all(motions)) return false;
  folds_ = !(is_driven_back_ && has_folded_);
  return folds_ || fill_all(motions);
}

bool ConstraintSet::fill_all(BodyMotions& motions) noexcept {
  coordinates_.clear();
  rows_.clear();
  measured_.clear();
  is_driven_back_ = false;
  has_folded_ = false;
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    if (!fill_one(static_cast<int>(i), motions)) return false;
  }
  return true;
}

bool ConstraintSet::fill_one(int index, BodyMotions& motions) noexcept {
  const AxisConstraint& constraint = constraints_[static_cast<std::size_t>(index)];
  Row along;
  bool acts = true;
  Coordinate& now = coordinates_.emplace_back();
  if (is_carried(constraint)) {
    along.body = constraint.move.body;
    const MotionVector V = motions.twist_of(along.body);
    along.a = carried_force_of(index, V);
    now = carried_coordinate(constraint, along.a, V);
  } else {
    acts = measure_between_frames(constraint, now, along, motions);
  }
  if (is_slow(constraint, now)) return true;
  if (!acts) return true;
  along.constraint = index;
  along.level = constraint.level;
  along.weight = constraint.weight;

  if (constraint.driver && !push_driver(constraint, now, along)) return false;
  if (constraint.driver && !constraint.driver->makes_force() && folds_) {
    has_folded_ = has_folded_ || constraint.position || constraint.velocity || constraint.acceleration;
    return true;
  }
  if (constraint.force && !constraint.driver) {
    Row* sum = push(along);
    if (sum == nullptr) return false;
    sum->kind = RowKind::sum;
    sum->quantity = Quantity::force;
    sum->lo = constraint.force->low;
    sum->hi = constraint.force->high;
  }
  return push_ranges(constraint, now, along);
}

/// Constant in the body, but along a motion.
const ForceVector& ConstraintSet::carried_force_of(int index, const MotionVector& V) noexcept {
  const AxisConstraint& constraint = constraints_[static_cast<std::size_t>(index)];
  std::optional<ForceVector>& force = carried_[static_cast<std::size_t>(index)];
  const bool is_along_motion = constraint.measure == Measure::speed || constraint.measure == Measure::turn;
  if (!force || is_along_motion) force = carried_force(constraint, V);
  return *force;
}

/// The coordinate, and the force along it. Groups of ranges mostly measure the same few axes: each axis is
/// measured once. False where no force acts.
bool ConstraintSet::measure_between_frames(const AxisConstraint& constraint, Coordinate& now, Row& along,
                                           BodyMotions& motions) noexcept {
  const bool is_axis = constraint.measure == Measure::axis;
  for (std::size_t k = 0; k < measured_.size() && is_axis; ++k) {
    const Measured& m = measured_[k];
    if (!is_same_axis(constraint, constraints_[static_cast<std::size_t>(m.constraint)])) continue;
    now = coordinates_[static_cast<std::size_t>(m.constraint)];
    along.body = m.body;
    along.reference_body = m.reference_body;
    along.a = m.a;
    along.a_reference = m.a_reference;
    return m.acts;
  }
  FrameMotion move, in;
  const FrameMotion& f = motions.of(constraint.move, move);
  const Measurement measured = measure(constraint, f, motions.of(constraint.in, in));
  now = measured.now;
  const bool acts =
      !measured.is_degenerate && put_force(constraint, measured, f.pose.position, motions, along);
  if (is_axis && measured_.size() < measured_.capacity()) {
    measured_.push_back({static_cast<int>(coordinates_.size()) - 1, along.body, along.reference_body, along.a,
                         along.a_reference, acts});
  }
  return acts;
}

/// The row of the driver, the ranges of its axis folded into a motion driver.
bool ConstraintSet::push_driver(const AxisConstraint& constraint, const Coordinate& now,
                                const Row& along) noexcept {
  Row* row = push(along);
  if (row == nullptr) return false;
  const Driver& driver = *constraint.driver;
  row->quantity = driver.quantity;
  row->lo = driver.force.low;
  row->hi = driver.force.high;
  if (constraint.force) {
    row->lo = std::max(row->lo, constraint.force->low);
    row->hi = std::min(row->hi, constraint.force->high);
  }
  if (driver.makes_force()) {
    row->kind = RowKind::force;
    row->force = driver_force(driver, now, constraint);
    return true;
  }
  double b = driver_acceleration(driver, now, constraint);
  for (const Quantity quantity : ranges_in_rising_rank) {
    if (!has_range(constraint, quantity)) continue;
    const Range range = acceleration_range(constraint, quantity, now, horizon_);
    b = std::max(range.low, std::min(b, range.high));
  }
  row->kind = RowKind::driver;
  row->b = b - now.acceleration_bias;
  return true;
}

/// Two one-sided rows a range.
bool ConstraintSet::push_ranges(const AxisConstraint& constraint, const Coordinate& now,
                                const Row& along) noexcept {
  const auto push_end = [&](Quantity quantity, RowKind kind, double b, double lo, double hi) {
    Row* row = push(along);
    if (row == nullptr) return false;
    row->quantity = quantity;
    row->kind = kind;
    row->b = b - now.acceleration_bias;
    row->lo = lo;
    row->hi = hi;
    return true;
  };
  is_driven_back_ = is_driven_back_ || (constraint.position && !contains(*constraint.position, now.position));
  for (const Quantity quantity : ranges_in_rising_rank) {
    if (!has_range(constraint, quantity)) continue;
    const Range range = acceleration_range(constraint, quantity, now, horizon_);
    if (std::isfinite(range.high) && !push_end(quantity, RowKind::upper, range.high, -infinity, 0.0))
      return false;
    const bool has_low = std::isfinite(range.low) && constraint.measure != Measure::speed;
    if (has_low && !push_end(quantity, RowKind::lower, range.low, 0.0, infinity)) return false;
  }
  return true;
}

}  // namespace zwang::solver
