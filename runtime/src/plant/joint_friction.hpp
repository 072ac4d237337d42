/// Dry and viscous friction of the joints, as the robot file gives it. Dry friction is an elastic bristle
/// that yields (as in floor_friction.hpp), so it sticks without creep. With stretch s, ds/dt = qd,
///     torque = -(k s + c qd), |torque| <= coulomb, |k s| <= coulomb by cutting s.
/// k = coulomb / presliding, and J w^2 at most. Where no presliding is given, k = J w^2. J is the joint's own
/// inertia, and w = 500 1/s, as a bristle has to be slow beside the simulation's step.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bristle.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::runtime {

class JointFriction {
 public:
  explicit JointFriction(const lang::Robot& robot);

  bool empty() const noexcept { return joints_.empty(); }
  /// Adds the friction's torques [N m] at the joint rates `qd`; moves the bristles by one step.
  void add_to(Eigen::VectorXd& torque, const Eigen::VectorXd& qd, double period) noexcept;

 private:
  struct RubbingJoint {
    Eigen::Index joint = 0;
    double viscous = 0.0;
    Bristle bristle;
  };
  std::vector<RubbingJoint> joints_;
};

}  // namespace zwang::runtime
