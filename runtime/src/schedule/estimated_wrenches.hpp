/// The contact wrenches on frames of the robot, estimated from joints and torques.
#pragma once

#include <vector>

#include "schedule/frame_table.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::runtime {

/// One contact is taken for all that pushes, at the frame that is asked for. With J the motion of the frame
/// along the free motions y, and p what pushes the robot along them,
///
///   J' w = p        w = (J J')^-1 J p
///
/// the least w where several would do: what the floor bears, and what no motor of a short arm feels, is 0.
/// Low-passed with 20 ms. Does not allocate, lock, throw or print after `ask`.
class EstimatedWrenches {
 public:
  explicit EstimatedWrenches(const solver::Model& model);

  /// Some condition or driver asks for this frame.
  void ask(int frame);
  bool empty() const noexcept { return asked_.empty(); }
  /// Of frames on other links than the base. `dt` [s] since the last estimate.
  void estimate(const solver::FreeMotions& motions, const Eigen::VectorXd& p, const solver::State& state,
                const FrameTable& frames, double dt) noexcept;
  /// Of frames on the base: from what presses on it at its origin, in its axes: x, y [N], rz [N m].
  void take_base_force(const solver::Vector3& force, const FrameTable& frames) noexcept;

  /// At the frame's origin, in its axes [N] or [N m]; NaN: not known.
  double part(int frame, lang::WrenchPart part) const noexcept;

  static constexpr double time_constant = 0.015;  ///< [s] behind a mean over 10 ms

 private:
  struct Asked {
    int frame = 0;
    bool is_known = false;
    solver::ForceVector wrench;
  };
  solver::ForceVector wrench_on(int frame, const solver::FreeMotions& motions, const Eigen::VectorXd& p,
                                const FrameTable& frames) noexcept;

  const solver::Model& model_;
  std::vector<Asked> asked_;
  solver::State moving_;  ///< the robot along one free motion
  solver::BodyMotions bodies_;
  Eigen::Matrix<double, Eigen::Dynamic, 6> J_turned_;  ///< J': a row a free motion
};

}  // namespace zwang::runtime
