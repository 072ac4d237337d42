/// Dry and viscous friction of the joints, as the robot file gives it. Dry friction is an elastic bristle
/// that yields (as in floor_friction.hpp): with stretch s, ds/dt = qd,
///     torque = -(k s + c qd), |torque| <= coulomb, |k s| <= coulomb by cutting s,
/// so that it sticks without creep. k = coulomb / presliding, but J w^2 at most, and that where no presliding
/// is given: J the joint's own inertia, w = 500 1/s, as a bristle has to be slow beside the simulation's
/// step.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "zwang/lang/robot.hpp"

namespace zwang::runtime {

class JointFriction {
 public:
  explicit JointFriction(const lang::Robot& robot);

  bool empty() const noexcept { return joints_.empty(); }
  /// Adds the friction's torques [N m] at the joint rates `qd`; moves the bristles by one step.
  void add_to(Eigen::VectorXd& torque, const Eigen::VectorXd& qd, double period) noexcept;

 private:
  struct Bristle {
    Eigen::Index joint = 0;
    double coulomb = 0.0, viscous = 0.0;
    double longest = 0.0;    ///< stretch that slides [rad]
    double stiffness = 0.0;  ///< k [N m/rad]
    double damping = 0.0;    ///< c [N m s/rad]
    double stretch = 0.0;    ///< [rad]
  };
  std::vector<Bristle> joints_;
};

}  // namespace zwang::runtime
