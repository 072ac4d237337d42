/// Holds the joints of an arm while the protective stop is latched: without torque it would fall.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// Of each joint with a motor that carries no wheel: the torque that bears what hangs on it, and a spring and
/// a damper to where it was when the stop latched:
///   tau = g(q) + I w^2 (q_hold - q) - 2 I w qd,   w = 20 rad/s
/// I is the inertia about the joint of everything beyond it, so that the arm swings in like one mass.
/// Does not allocate, lock, throw or print after construction.
class ArmHold {
 public:
  explicit ArmHold(const solver::Model& model);

  bool empty() const noexcept { return joints_.empty(); }
  /// Takes the posture of a good sample: from now on it is the one to hold.
  void take(const solver::State& state) noexcept;
  /// Keeps the posture that was taken last; sets the entries of its own joints.
  void hold(const solver::State& state, Eigen::VectorXd& tau) noexcept;
  /// The same when nothing is known of the state now.
  void hold_blind(Eigen::VectorXd& tau) const noexcept;

  static constexpr double frequency = 20.0;  ///< [rad/s]

 private:
  struct HeldJoint {
    int joint = 0;
    double weight = 0.0;   ///< g [N m] or [N]
    double inertia = 0.0;  ///< I [kg m^2] or [kg]
    double posture = 0.0;  ///< q_hold
  };
  void weigh(const solver::State& state) noexcept;

  const solver::Model model_;
  std::vector<HeldJoint> joints_;
  std::vector<solver::Pose> poses_;             ///< of each body in the base
  std::vector<solver::RigidInertia> subtrees_;  ///< of each body and what hangs on it, in the base's axes
};

}  // namespace zwang::runtime
