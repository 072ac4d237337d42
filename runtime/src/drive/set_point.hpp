/// The velocity commands to a drive.
#pragma once

#include <Eigen/Core>

#include "zwang/lang/robot.hpp"
#include "zwang/solver/constraint.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::runtime {

/// V = v + t a, of each wheel. A first-order loop of the time constant T_c that is led by T_c a follows a
/// ramp without a lag. A command takes half of the delay to arrive, and is half a cycle old on the mean:
///     t = T_c + delay/2 + 1/(2 rate).
/// Blocked, the loop asks for m a at least, whatever t is: it rests on its torque limit.
///
/// t is longer than some drivers' time constant, and an integral makes more of t a than a loop without one.
/// So V stays inside the velocity ranges in force, and does not pass what a velocity driver asks for: the
/// least change in kinetic energy, row by row. RowBounds keeps the accelerations.
class SetPoint {
 public:
  SetPoint(const lang::Drive& drive, const solver::Model& model);

  /// After `solver` has solved the rows of `set`; `motions` are those of its solution, `qd` the state's.
  /// Does not allocate, lock, throw or print.
  void put(const solver::Solver& solver, const solver::ConstraintSet& set, const solver::Solution& solution,
           const solver::FreeMotions& motions, const Eigen::VectorXd& qd, Eigen::VectorXd& velocity) noexcept;
  double lead() const noexcept { return lead_; }  ///< t [s]

  static constexpr int sweeps = 4;  ///< over rows that are not at right angles

 private:
  double lead_;
  Eigen::VectorXd p_;
  Eigen::VectorXd change_;  ///< of ydd
};

}  // namespace zwang::runtime
