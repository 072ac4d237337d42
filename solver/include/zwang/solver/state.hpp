/// The solver's input about the robot at one instant.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/spatial.hpp"

namespace zwang::solver {

/// Sized once for a model; every vector keeps its size. At first all numbers are 0, and the base stands at
/// the world's origin.
struct ZWANG_EXPORT State {
  explicit State(const Model& model);

  Eigen::VectorXd q;   ///< [rad] or [m], one entry a joint
  Eigen::VectorXd qd;  ///< [rad/s] or [m/s], one entry a joint
  Pose base_pose;      ///< X_WB; `world` is its frame
  MotionVector
      base_twist;  ///< of the base, in base coordinates and at the base's origin; ignored on a fixed base
  std::vector<ForceVector>
      f_ext;  ///< [N m, N] external wrench, one entry a body, in body coordinates and about the body's origin
  Eigen::VectorXd tau_ff;  ///< [N m] or [N] feed-forward torque of each joint
};

}  // namespace zwang::solver
