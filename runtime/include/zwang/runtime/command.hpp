/// The command to a drive for one control period.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace zwang::runtime {

/// One entry a joint. A drive that takes torques reads `torque`; its bounds are that torque, its velocity
/// is 0. A drive that takes velocities turns each wheel at `velocity` as far as a torque in [lower, upper]
/// lets it; one that takes twists reads `twist` alone.
struct Command {
  Command() = default;
  explicit Command(Eigen::Index joints)
      : torque(Eigen::VectorXd::Zero(joints)), velocity(torque), lower(torque), upper(torque) {}

  Eigen::VectorXd torque;        ///< [N m] or [N]
  Eigen::VectorXd velocity;      ///< [rad/s] or [m/s]
  Eigen::VectorXd lower, upper;  ///< [N m] or [N]; of a drive with limits of its own these
  /// The base's velocity that `velocity` stands for: x, y [m/s] and rz [rad/s], in its axes. 0 of a drive
  /// that takes no twist.
  Eigen::Vector3d twist = Eigen::Vector3d::Zero();
  /// The values of the task file's outputs, in the order of Program::outputs: SI, or 0 and 1.
  std::vector<double> outputs;
};

}  // namespace zwang::runtime
