/// What a drive is told for one control period.
#pragma once

#include <Eigen/Core>

namespace zwang::runtime {

/// One entry a joint. A drive that takes torques reads `torque`; its bounds are that torque, its velocity
/// is 0. A drive that takes velocities turns each wheel at `velocity` as far as a torque in [lower, upper]
/// lets it.
struct Command {
  Command() = default;
  explicit Command(Eigen::Index joints)
      : torque(Eigen::VectorXd::Zero(joints)), velocity(torque), lower(torque), upper(torque) {}

  Eigen::VectorXd torque;        ///< [N m] or [N]
  Eigen::VectorXd velocity;      ///< [rad/s] or [m/s]
  Eigen::VectorXd lower, upper;  ///< [N m] or [N]
};

}  // namespace zwang::runtime
