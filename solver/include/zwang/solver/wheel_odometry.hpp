/// What the wheels say of the motion of the base.
#pragma once

#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::solver {

struct WheelTwist {
  MotionVector
      twist;     ///< planar, of the base, in base coordinates and at its origin; 0 along what no wheel tells
  int rank = 0;  ///< planar freedoms that the wheels tell of: 3 for most, 2 where all slide sideways
  double slip = 0.0;  ///< [m/s] root mean square of what the held directions contradict each other by
};

/// The planar twist (vx, vy, wz) that makes the slip along all held directions of all wheels smallest in
/// the sum of squares; the one of least norm where the wheels leave it open. Reads q and qd of the state
/// only. Does not allocate, lock, throw or print.
WheelTwist twist_from_wheels(const Model& model, const State& state) noexcept;

}  // namespace zwang::solver
