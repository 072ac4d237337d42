/// Holds the joints of an arm while the protective stop is latched: without torque it would fall.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "zwang/solver/joint_loads.hpp"

namespace zwang::runtime {

/// The torque for each joint with a motor that carries no wheel. It bears the weight on the joint, and adds a
/// spring and a damper to the position at the onset of the stop:
///   tau = g(q) + I w^2 (q_hold - q) - 2 I w qd,   w = 20 rad/s
/// I is the inertia of all parts beyond the joint, about its axis, so the arm swings in like one mass. Does
/// not allocate, lock, throw or print after construction.
class ArmHold {
 public:
  explicit ArmHold(const solver::Model& model);

  struct HeldJoint {
    int joint = 0;
    std::size_t load = 0;  ///< what hangs on it: an index into the loads
    double posture = 0.0;  ///< q_hold
  };
  const std::vector<HeldJoint>& joints() const noexcept { return joints_; }
  /// As `take` or `hold` weighed it last.
  const solver::JointLoads::Load& load_of(const HeldJoint& held) const noexcept {
    return loads_.all()[held.load];
  }
  /// Takes the posture of a good sample: from now on it is the one to hold.
  void take(const solver::State& state) noexcept;
  /// Keeps the posture that was taken last; sets the entries of its own joints.
  void hold(const solver::State& state, Eigen::VectorXd& tau) noexcept;
  /// The same when nothing is known of the state now.
  void hold_blind(Eigen::VectorXd& tau) const noexcept;

  /// Takes the torques of its joints from elsewhere.
  void copy(const Eigen::VectorXd& from, Eigen::VectorXd& tau) const noexcept;

  static constexpr double frequency = 20.0;  ///< [rad/s]

 private:
  solver::JointLoads loads_;
  std::vector<HeldJoint> joints_;
};

}  // namespace zwang::runtime
