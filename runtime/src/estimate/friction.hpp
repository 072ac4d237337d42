/// Makes up for the friction of the joints, in part.
#pragma once

#include <vector>

#include "zwang/lang/robot.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// Torque that a joint's friction takes, times the fraction that the robot file says to `compensate`:
///   tau += compensate (coulomb qd / sqrt(qd^2 + taper^2) + viscous qd)
/// It tapers off where the direction of motion is uncertain, and stays below the friction itself, so that it
/// can never move a joint that stands. It comes on top of what the rows ask for, outside of their bounds.
/// Does not allocate, lock, throw or print after construction.
class FrictionFeedForward {
 public:
  explicit FrictionFeedForward(const lang::Robot& robot);
  /// `tau` as long as the state's joints [N m] or [N].
  void add_to(Eigen::VectorXd& tau, const solver::State& state) const noexcept;

  static constexpr double turn_taper = 0.2;    ///< [rad/s]
  static constexpr double slide_taper = 0.01;  ///< [m/s]

 private:
  struct Term {
    int joint = 0;
    lang::JointFriction friction;
    double taper = turn_taper;
  };
  std::vector<Term> terms_;
};

}  // namespace zwang::runtime
