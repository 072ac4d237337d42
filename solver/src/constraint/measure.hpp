/// What a constraint measures between two frames, as numbers: the coordinate, and the unit force along it.
#pragma once

#include "zwang/solver/constraint.hpp"

namespace zwang::solver {

inline bool is_rotation(Axis axis) {
  return axis >= Axis::rx;
}

/// The unit constraint force acts on F at its origin and the opposite one on T's body at the same point, both
/// in world axes: a . (V_k - V_c) = ds and a . (A_k - A_c) + gamma = dds.
struct Measurement {
  Coordinate now;
  Vector3 moment = Vector3::Zero();
  Vector3 force = Vector3::Zero();
};

/// Frames on one body: `in` only orients and motion counts relative to the world.
bool only_orients(const AttachedFrame& move, const AttachedFrame& in) noexcept;

/// `f` and `t` are the motions of the constraint's frames `move` and `in`.
Measurement measure(const AxisConstraint& constraint, const FrameMotion& f, const FrameMotion& t) noexcept;

}  // namespace zwang::solver
