/// Task constraints as motion and force, and the rows that they become.
///
/// A row is `a . Xdd = b + s` on spatial accelerations, with the multiplier nu in [lo, hi]: the row's
/// constraint force.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/solver/frame.hpp"

namespace zwang::solver {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double limit_horizon =
    0.010;  ///< h [s], within which limits act, of torques that come as often

/// An axis of a frame: along x, y, z, or about them.
enum class Axis { x, y, z, rx, ry, rz };

/// Which of an axis's four quantities a statement speaks of.
enum class Quantity { position, velocity, acceleration, force };

/// Both ends belong to it. The unit is that of the bounded quantity.
struct Range {
  double low = -infinity;
  double high = infinity;
};

/// The quantity that a statement measures between the frames `move` (F) and `in` (T).
enum class Measure {
  axis,       ///< the position or angle of F along or about one axis of T
  direction,  ///< a weighted sum of all six: a slanted axis, the normal of an edge, a coupling of two axes
  distance,   ///< from the origin of T to that of F
  angle,      ///< between one axis of F and one of T, 0 to pi
  bearing,    ///< of T's origin, from F's x axis towards its y axis, in F's x-y plane; it wraps, and makes no
              ///< row where T's origin is nearer to F's z axis than `nearest_bearing`
  speed,      ///< of F in the x-y plane of T; velocity ranges only, and no row below half of the highest
  path,  ///< the same along a piece of a path in T's x-y plane, a line or an arc that begins at T's origin
         ///< along T's x. x is the arc length of the nearest point; its velocity is that of F along the
         ///< tangent there. y is the distance of F to the left, rz F's heading from the tangent; z: as axis
  side,  ///< a direction in the x-y plane of T whose acceleration is that of the point F, also where T turns
  turn,  ///< s = w v of axes that F's body carries: v along `coefficients`, w about z. With it a base that
         ///< cannot move sideways accelerates sideways. Ranges of s [m/s^2] are `velocity`, and make no row
         ///< while |s| is below half of the highest
};

inline constexpr double nearest_bearing = 0.05;  ///< [m]

/// The value that drives an axis. [SI: m, rad, m/s, ..., N, N m]
struct Driver {
  Quantity quantity = Quantity::velocity;
  double target = 0.0;               ///< c, v, p or f
  double target_rate = 0.0;          ///< dp, or dv for a velocity driver
  double target_acceleration = 0.0;  ///< ddp
  double time_constant = 0.5;        ///< T [s]
  Range force;                       ///< bounds of the row's multiplier [N] or [N m]
  /// A position driver with a stiffness or a damping is a spring: a force row. Its force is
  /// f = k (p - s) + d (dp - ds), inside the range `force`. [N/m, N s/m] or [N m/rad, N m s/rad]
  double stiffness = 0.0;
  double damping = 0.0;

  bool makes_force() const {
    return quantity == Quantity::force ||
           (quantity == Quantity::position && (stiffness > 0.0 || damping > 0.0));
  }
};

/// A task's statement about one axis (or other measure) of a frame: at most one driver, and any ranges.
struct AxisConstraint {
  AttachedFrame move;  ///< F
  AttachedFrame in;    ///< T; its axes carry the statement. On the same body as `move` they only orient.
  Measure measure = Measure::axis;
  Axis axis = Axis::x;                   ///< of an angle: the one of F
  Axis other_axis = Axis::x;             ///< of an angle: the one of T
  std::array<double, 6> coefficients{};  ///< of a direction, a side or a turn, by x y z rx ry rz
  double curvature = 0.0;                ///< k of a path's piece [1/m], above 0 to the left; 0: a line
  double arc_length = 0.0;               ///< where the path's piece begins [m]
  std::optional<Driver> driver;
  std::optional<Range> position;      ///< [m] or [rad]
  std::optional<Range> velocity;      ///< [m/s] or [rad/s]
  std::optional<Range> acceleration;  ///< [m/s^2] or [rad/s^2]
  /// [N] or [N m], 0 inside. Beside a motion driver it narrows the driver's. Without a driver it limits what
  /// all rows of this level and below press with along the axis together: a row of the kind `sum`.
  std::optional<Range> force;
  /// w [kg] or [kg m^2]: motion rows become soft, the part w/(w + Lambda) of b is met, Lambda the effective
  /// mass along the axis.
  double weight = infinity;
  double braking = 1.0;  ///< a_brk of a position range [m/s^2] or [rad/s^2]
  /// v_ret of a position range [m/s] or [rad/s]: the speed of the way back into it. 0: it only holds back.
  double return_speed = infinity;
  int level = 1;

  /// Time within which a range acts on a coordinate outside it [s], if it is longer than the set's horizon. A
  /// new range has a longer time, so that a motion outside it has time to stop.
  double position_horizon = limit_horizon;
  double velocity_horizon = limit_horizon;

  /// Whether the measure is in radians by its kind: a direction may be, and does not know.
  bool is_angle() const { return measure == Measure::angle || wraps(); }
  /// An angle that starts anew at pi.
  bool wraps() const {
    const bool has_axis = measure == Measure::axis || measure == Measure::path;
    return measure == Measure::bearing || (has_axis && axis >= Axis::rx);
  }
};

/// The present motion along a measure. [m, m/s] or [rad, rad/s]
struct Coordinate {
  double position = 0.0;           ///< s; for axes carried by the moved body 0
  double velocity = 0.0;           ///< ds
  double acceleration_bias = 0.0;  ///< gamma: dds = a . (A_k - A_c) + gamma
};

/// The kind of a row.
enum class RowKind {
  driver,  ///< equality with a bounded multiplier
  upper,   ///< a . Xdd <= b, nu <= 0
  lower,   ///< a . Xdd >= b, nu >= 0
  force,   ///< a wrench a phi f, phi in [0, 1]
  sum,     ///< no force of its own: lo and hi bound what all rows of its level and below press with along a
};

/// Whether a row of this kind bounds a motion from one side.
constexpr bool is_limit(RowKind kind) noexcept {
  return kind == RowKind::upper || kind == RowKind::lower;
}

/// One row of the bounded problem, on spatial accelerations.
struct Row {
  RowKind kind = RowKind::driver;
  Quantity quantity = Quantity::velocity;  ///< of the statement that made the row
  /// Index of that constraint in its set, -1 for none. All rows of a constraint act along the same axis.
  int constraint = -1;
  int body = 0;  ///< of the model, on which `a` acts
  ForceVector
      a;  ///< unit constraint force on `body`, in its coordinates and about its origin: a column of A_N
  int reference_body = -1;  ///< the row measures motion relative to this body; -1 for the world
  ForceVector a_reference;  ///< the same constraint force in the reference body's coordinates
  double b = 0.0;           ///< [m/s^2] or [rad/s^2], an entry of b_N; velocity products already taken off
  double force = 0.0;       ///< f of a force row [N] or [N m]
  double lo = -infinity;  ///< bounds of nu [N] or [N m]; an infinite bound stands for what the motors can do
  double hi = infinity;
  double weight = infinity;  ///< w [kg] or [kg m^2] of a motion row, above 0; softness R = 1/w
  int level = 1;             ///< from 0 on; a lower number goes first
};

/// The constraints in force at one instant, and the coordinates and rows that `fill` computes from a state.
/// Sized once, std::invalid_argument for a size below 1: `fill` does not allocate, lock, throw or print.
class ZWANG_EXPORT ConstraintSet {
 public:
  /// `horizon`: h [s], within which limits act.
  explicit ConstraintSet(int constraint_capacity = 64, int row_capacity = 64, double horizon = limit_horizon);

  void clear() noexcept;
  bool add(const AxisConstraint& constraint) noexcept;  ///< false when full
  const std::vector<AxisConstraint>& constraints() const noexcept { return constraints_; }
  /// `i`: from 0 to the number of constraints less 1; not checked.
  AxisConstraint& operator[](int i) noexcept {
    carried_[static_cast<std::size_t>(i)].reset();
    return constraints_[static_cast<std::size_t>(i)];
  }

  /// Computes every coordinate and row. The state is sized for the model. False when the rows exceed the
  /// capacity: the rows are then a part.
  bool fill(const Model& model, const State& state) noexcept;
  /// The same at the state that `motions` knows the bodies of.
  bool fill(BodyMotions& motions) noexcept;
  /// One for each constraint, in their order, as filled last.
  const std::vector<Coordinate>& coordinates() const noexcept { return coordinates_; }
  /// In the order of the constraints, as filled last: for Solver::solve.
  const std::vector<Row>& rows() const noexcept { return rows_; }

 private:
  bool fill_all(BodyMotions& motions) noexcept;
  bool fill_one(int index, BodyMotions& motions) noexcept;
  bool push_driver(const AxisConstraint& constraint, const Coordinate& now, const Row& along) noexcept;
  bool push_ranges(const AxisConstraint& constraint, const Coordinate& now, const Row& along) noexcept;
  Row* push(const Row& row) noexcept;  ///< null when full
  bool measure_between_frames(const AxisConstraint& constraint, Coordinate& now, Row& along,
                              BodyMotions& motions) noexcept;
  const ForceVector& carried_force_of(int index, const MotionVector& V) noexcept;

  double horizon_;
  std::vector<AxisConstraint> constraints_;
  std::vector<Coordinate> coordinates_;
  std::vector<Row> rows_;
  /// By constraint: the force along axes that the moved body carries, since the constraint was written.
  std::vector<std::optional<ForceVector>> carried_;
  /// An axis between two frames, as it was measured in the present `fill`.
  struct Measured {
    int constraint = 0;  ///< the first one that measures it
    int body = 0, reference_body = -1;
    ForceVector a, a_reference;
    bool acts = false;
  };
  std::vector<Measured> measured_;
  bool folds_ = true;
  bool has_folded_ = false;      ///< a motion driver has ranges beside it
  bool is_driven_back_ = false;  ///< a coordinate is outside of a position range
  BodyMotions motions_;
};

/// The motion of `move` along `axis` of `in` at the state. Does not allocate, lock, throw or print.
ZWANG_EXPORT Coordinate coordinate_of(const AttachedFrame& move, const AttachedFrame& in, Axis axis,
                                      const Model& model, const State& state) noexcept;

/// The present motion along the measure of a constraint.
ZWANG_EXPORT Coordinate coordinate_of(const AxisConstraint& constraint, const Model& model,
                                      const State& state) noexcept;
/// The same at the state that `motions` knows the bodies of.
ZWANG_EXPORT Coordinate coordinate_of(const AxisConstraint& constraint, BodyMotions& motions) noexcept;

/// Of `move` along `axis` of `in`, nothing but the position. [m] or [rad]
ZWANG_EXPORT double position_of(const AttachedFrame& move, const AttachedFrame& in, Axis axis,
                                BodyMotions& motions) noexcept;

/// The share of a range's acceleration that the braking curve uses. A base that weighs 30 % more than its
/// model slows down by a when it is asked for 1.3 a. It then uses 1.3 x 0.72 = 0.94 of the range. The rest is
/// for the last millimetres, where the base is late by 1.3 a h. With 1/1.3 = 0.77 it would pass its bound.
inline constexpr double braking_share = 0.72;

/// The braking curve of position limits and boundaries: the fastest approach speed at a distance d. The
/// deceleration to a stop at 0 stays within `braking`. The curve is odd in d:
///   v = d/T for d < d0, else sqrt(2 a (d - d0/2))
///   a = braking_share braking,   T = 4 h,   d0 = a T^2   [m, m/s^2 -> m/s]
ZWANG_EXPORT double braking_speed(double distance, double braking, double horizon) noexcept;
/// The braking curve of a constraint's position range, inside and outside it. Outside, v = -min(|v|, v_ret).
ZWANG_EXPORT double approach_speed(double distance, const AxisConstraint& constraint,
                                   double horizon) noexcept;
/// The distance at which that speed is the one that the curve allows. [m/s, m/s^2 -> m]
ZWANG_EXPORT double braking_distance(double speed, double braking, double horizon) noexcept;

}  // namespace zwang::solver
