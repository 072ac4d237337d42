/// How fast the wheels of a base slide over the floor, by the plant's truth.
#pragma once

#include <vector>

#include "zwang/solver/frame.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// A wheel slides with the speed of its lowest point along the directions that it holds. For a mecanum wheel
/// that is e . v, with e the axis of its roller at the floor. For a plain wheel it is the norm of both
/// directions. The part beyond a tenth of the rim's speed counts, low-passed with 50 ms, as in the guard's
/// slip event. Does not allocate, lock, throw or print after construction.
class FloorSlip {
 public:
  FloorSlip(const solver::Model& model, double period);

  /// Once a step, at its end.
  void look(const solver::Model& model, const solver::State& state) noexcept;
  double speed() const noexcept { return speed_; }  ///< [m/s] of the worst wheel

  static constexpr double share = 0.1;           ///< of the rim's speed
  static constexpr double time_constant = 0.05;  ///< [s]

 private:
  double part_;                ///< of a step that the low-pass takes over
  std::vector<double> slips_;  ///< [m/s] by wheel
  solver::BodyMotions motions_;
  double speed_ = 0.0;
};

}  // namespace zwang::runtime
