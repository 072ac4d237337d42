#include "zwang/solver/constraint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "constraint/kinematics.hpp"

namespace zwang::solver {

namespace {

bool is_rotation(Axis axis) {
  return axis >= Axis::rx;
}
int direction_of(Axis axis) {
  return static_cast<int>(axis) % 3;
}

double wrap_to_pi(double angle) {
  return std::remainder(angle, 2.0 * std::numbers::pi);
}

/// The angle of the rotation R about its own axis `k` alone (the twist of a swing-twist decomposition).
double twist_angle(const Matrix3& R, int k) {
  const int i = (k + 1) % 3;
  const int j = (k + 2) % 3;
  return std::atan2(R(j, i) - R(i, j), R(i, i) + R(j, j));
}

/// Axes carried by the moved body itself only orient: motion counts relative to the world.
bool only_orients(const AttachedFrame& move, const AttachedFrame& in) {
  return in.body >= 0 && in.body == move.body;
}

/// The coordinate of F (motion `f`) along one axis of T (motion `t`), and its velocity products:
///   translation  s = e.(p_F - p_T)   a = (p_F x e, e)    rotation  s = angle about e   a = (e, 0)
///   ds = a.(V_k - V_c)               dds = a.(A_k - A_c) + gamma,   gamma = da/dt . (V_k - V_c)
/// where e turns with T. With the origin of the coordinates at p_F and T on body c,
///   translation  gamma = (v_F x e).(w_k - w_c) + (w_c x e).(v_F - v_c(p_F))
///   rotation     gamma = (w_c x e).w_k
/// Axes of the moved body itself give gamma = 0: the two products cancel.
Coordinate relative_coordinate(const FrameMotion& f, const FrameMotion& t, Axis axis, bool own_axes) {
  const int k = direction_of(axis);
  const Vector3 e = t.pose.rotation.col(k);
  Coordinate coordinate;
  if (own_axes) {
    coordinate.velocity = e.dot(is_rotation(axis) ? f.angular : f.linear);
    return coordinate;
  }
  if (is_rotation(axis)) {
    coordinate.position = twist_angle(t.pose.rotation.transpose() * f.pose.rotation, k);
    coordinate.velocity = e.dot(f.angular - t.angular);
    coordinate.acceleration_bias = t.angular.cross(e).dot(f.angular);
    return coordinate;
  }
  const Vector3 offset = f.pose.position - t.pose.position;
  const Vector3 v_c = t.linear + t.angular.cross(offset);
  coordinate.position = e.dot(offset);
  coordinate.velocity = e.dot(f.linear - v_c);
  coordinate.acceleration_bias =
      f.linear.cross(e).dot(f.angular - t.angular) + t.angular.cross(e).dot(f.linear - v_c);
  return coordinate;
}

/// The unit constraint force along the axis at p_F, in the coordinates of a body and about its origin.
ForceVector unit_constraint_force(const FrameMotion& f, const FrameMotion& t, Axis axis, const Pose& body) {
  const Vector3 e = body.rotation.transpose() * t.pose.rotation.col(direction_of(axis));
  if (is_rotation(axis)) return {e, Vector3::Zero()};
  const Vector3 p = body.rotation.transpose() * (f.pose.position - body.position);
  return {p.cross(e), e};
}

double driver_acceleration(const Driver& driver, const Coordinate& now, Axis axis) {
  const double w = 1.0 / driver.time_constant;
  switch (driver.quantity) {
    case Quantity::acceleration:
      return driver.target;
    case Quantity::velocity:
      return w * (driver.target - now.velocity) + driver.target_rate;
    case Quantity::position: {
      double error = driver.target - now.position;
      if (is_rotation(axis)) error = wrap_to_pi(error);
      return w * w * error + 2.0 * w * (driver.target_rate - now.velocity) + driver.target_acceleration;
    }
    case Quantity::force:
      break;
  }
  return 0.0;
}

/// The accelerations that a range allows now.
Range acceleration_range(const AxisConstraint& constraint, Quantity quantity, const Coordinate& now,
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

/// Later ones win where ranges contradict.
constexpr std::array ranges_in_rising_rank{Quantity::position, Quantity::velocity, Quantity::acceleration};

double mix(double before, double now, double progress) {
  return before + progress * (now - before);
}

}  // namespace

double braking_speed(double distance, double braking, double h) noexcept {
  const double a = 0.8 * braking;
  const double T = 4.0 * h;
  const double d0 = a * T * T;
  const double d = std::abs(distance);
  const double speed = d < d0 ? d / T : std::sqrt(2.0 * a * (d - 0.5 * d0));
  return std::copysign(speed, distance);
}

FrameMotion motion_of(const AttachedFrame& frame, const Model& model, const State& state) noexcept {
  if (frame.body < 0) {
    const Matrix3& R = frame.pose.rotation;
    return {frame.pose, R * frame.twist.angular, R * frame.twist.linear};
  }
  return motion_of_body(frame.body, model, state).at(frame.pose);
}

Coordinate coordinate_of(const AttachedFrame& move, const AttachedFrame& in, Axis axis, const Model& model,
                         const State& state) noexcept {
  return relative_coordinate(motion_of(move, model, state), motion_of(in, model, state), axis,
                             only_orients(move, in));
}

ConstraintSet::ConstraintSet(int constraint_capacity, int row_capacity) {
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
  coordinates_.clear();
  rows_.clear();
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    if (!fill_one(static_cast<int>(i), model, state)) return false;
  }
  return true;
}

bool ConstraintSet::fill_one(int index, const Model& model, const State& state) noexcept {
  const AxisConstraint& constraint = constraints_[static_cast<std::size_t>(index)];
  const FrameMotion f = motion_of(constraint.move, model, state);
  const FrameMotion t = motion_of(constraint.in, model, state);
  const bool own_axes = only_orients(constraint.move, constraint.in);
  const Coordinate now = relative_coordinate(f, t, constraint.axis, own_axes);
  coordinates_.push_back(now);
  if (constraint.leaving && constraint.alpha <= 0.0) return true;

  Row row;
  row.constraint = index;
  row.level = constraint.level;
  row.body = constraint.move.body;
  row.a = unit_constraint_force(f, t, constraint.axis, motion_of_body(row.body, model, state).pose);
  if (constraint.in.body >= 0 && !own_axes) {
    row.reference_body = constraint.in.body;
    row.a_reference =
        unit_constraint_force(f, t, constraint.axis, motion_of_body(row.reference_body, model, state).pose);
  }

  // One-sided rows enter at once, with a longer horizon while they are new, and leave softly.
  const double h =
      constraint.leaving ? horizon : std::max(horizon, (1.0 - constraint.alpha) * constraint.blend);
  const bool folds = constraint.driver && constraint.driver->quantity != Quantity::force;

  if (constraint.driver && constraint.alpha > 0.0) {
    const Driver& driver = *constraint.driver;
    row.quantity = driver.quantity;
    row.fade = constraint.alpha;
    row.lo = driver.force.low;
    row.hi = driver.force.high;
    double b = driver_acceleration(driver, now, constraint.axis);
    row.force = driver.target;
    if (constraint.before) {
      b = mix(driver_acceleration(*constraint.before, now, constraint.axis), b, constraint.progress);
      row.force = mix(constraint.before->target, driver.target, constraint.progress);
      row.lo = std::max(row.lo, constraint.before->force.low);
      row.hi = std::min(row.hi, constraint.before->force.high);
    }
    if (folds) {
      for (const Quantity quantity : ranges_in_rising_rank) {
        const Range range = acceleration_range(constraint, quantity, now, h);
        b = std::max(range.low, std::min(b, range.high));
      }
      row.kind = RowKind::driver;
      row.b = b - now.acceleration_bias;
    } else {
      row.kind = RowKind::force;
      row.b = 0.0;
    }
    if (!push(row)) return false;
  }
  if (folds) return true;

  row.force = 0.0;
  row.fade = constraint.leaving ? constraint.alpha : 1.0;
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
    if (std::isfinite(range.low)) {
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
