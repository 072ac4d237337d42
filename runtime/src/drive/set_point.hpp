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
/// A loop that is told V hears of no speed that it should lose. So its integral adds an acceleration S with
///     S' = a/T_i,
/// and a driver of the time constant T swings: v'' + v'/T + (v - target)/(T T_i) = 0. Speeds that are older
/// by d ask for the same ramp with  V = v(now - d) + (t + d) a.  A base that speeds up more than asked is
/// told less by them. Samples are delay + 1/rate old as they act. A low pass adds what that lacks of T_c.
///
/// t is longer than some drivers' time constant, and an integral makes more of t a than a loop without one.
/// So V stays inside the velocity ranges in force, and does not pass what a velocity driver asks for: the
/// least change in kinetic energy, row by row. RowBounds keeps the accelerations.
class SetPoint {
 public:
  /// `period`: from one call of `put` to the next [s].
  SetPoint(const lang::Drive& drive, const solver::Model& model, double period);

  /// After `solver` has solved the rows of `set`; `motions` are those of its solution, `qd` the state's.
  /// Does not allocate, lock, throw or print.
  void put(const solver::Solver& solver, const solver::ConstraintSet& set, const solver::Solution& solution,
           const solver::FreeMotions& motions, const Eigen::VectorXd& qd, Eigen::VectorXd& velocity) noexcept;
  double lead() const noexcept { return lead_; }  ///< t [s]

  static constexpr int sweeps = 4;  ///< over rows that are not at right angles

 private:
  double lead_;
  double part_;            ///< of the way from `older_` to the present rates, in one call; 1: all of it
  Eigen::VectorXd older_;  ///< [rad/s] rates of the joints
  bool has_older_ = false;
  Eigen::VectorXd p_;
  Eigen::VectorXd change_;  ///< of ydd
};

}  // namespace zwang::runtime
