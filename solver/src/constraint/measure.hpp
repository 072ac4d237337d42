/// The measure of a constraint between two frames, as numbers: the coordinate, and the unit force along it.
#pragma once

#include "linear/pairs.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::solver {

inline bool is_rotation(Axis axis) {
  return axis >= Axis::rx;
}

/// Of x, y and z the one along or about which.
inline int direction_of(Axis axis) {
  return static_cast<int>(axis) % 3;
}

/// The unit constraint force acts on F at its origin. The opposite force acts on T's body at the same point.
/// Both are in world axes: a . (V_k - V_c) = ds and a . (A_k - A_c) + gamma = dds.
struct Measurement {
  Coordinate now;
  Vector3 moment = Vector3::Zero();
  Vector3 force = Vector3::Zero();
  bool is_degenerate = false;  ///< a bearing of what is too near: it makes no row
};

/// Frames on one body: `in` only orients and motion counts relative to the world.
inline bool only_orients(const AttachedFrame& move, const AttachedFrame& in) noexcept {
  return in.body >= 0 && in.body == move.body;
}

static_assert(sizeof(Pose) == 12 * sizeof(double) && sizeof(MotionVector) == 6 * sizeof(double));

/// The twist of a frame on a body is ignored.
inline bool is_same(const AttachedFrame& one, const AttachedFrame& other) noexcept {
  return one.body == other.body && are_same<12>(one.pose.rotation.data(), other.pose.rotation.data()) &&
         (one.body >= 0 || are_same<6>(one.twist.angular.data(), other.twist.angular.data()));
}

/// Whether two constraints measure the same axis of the same frames.
inline bool is_same_axis(const AxisConstraint& one, const AxisConstraint& other) noexcept {
  return one.axis == other.axis && is_same(one.move, other.move) && is_same(one.in, other.in);
}

/// Whether the constraint measures along axes that the moved body carries. Motion then counts relative to the
/// world, and the unit force a is constant in the body. So ds = a . V and dds = a . A + gamma, with gamma 0
/// except for a `side`.
inline bool is_carried(const AxisConstraint& constraint) noexcept {
  const bool has_axes = constraint.measure != Measure::distance && constraint.measure != Measure::angle &&
                        constraint.measure != Measure::bearing;
  return has_axes && only_orients(constraint.move, constraint.in);
}

/// That force, in the body's coordinates and about its origin. V is the body's twist there; a speed of 0 has
/// no direction and no force.
ForceVector carried_force(const AxisConstraint& constraint, const MotionVector& V) noexcept;

/// gamma of a `side` along the axis e that the body carries, with the velocity v_p of the point: e . (w x
/// v_p). `a`: the carried force.
double carried_bias(const AxisConstraint& constraint, const ForceVector& a, const MotionVector& V) noexcept;

/// Where the moved body does not carry them. `f` and `t` are the motions of the frames `move` and `in`.
Measurement measure(const AxisConstraint& constraint, const FrameMotion& f, const FrameMotion& t) noexcept;

/// The position of `f` along or about one axis of `t`, by their poses.
double measure_position(Axis axis, const Pose& f, const Pose& t) noexcept;

}  // namespace zwang::solver
