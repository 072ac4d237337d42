/// A posture that keeps the arms of a drafted robot above its base.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "robot/urdf.hpp"

namespace zwang::lang {

struct FoldedArm {
  std::map<std::string, double> posture;  ///< [rad] or [m] by joint, where it is not 0
  double reach = 0.0;  ///< [m] from the base's origin to the farthest point beyond the outline; 0: none is
};

/// `joints`: those of the arms, which may move. `outline`: corners in `base`, counter-clockwise. [m]
FoldedArm fold_arm(const Urdf& urdf, const std::string& base, const std::vector<std::string>& joints,
                   const std::vector<Eigen::Vector2d>& outline);

/// The section `posture` of a robot file; empty where all joints stand at 0.
std::string posture_entry(const Urdf& urdf, const FoldedArm& folded);

}  // namespace zwang::lang
