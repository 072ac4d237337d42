/// Joints with a motor that no task uses are held in place: an arm while the base works, a steering.
#pragma once

#include <string>
#include <vector>

#include "zwang/lang/program.hpp"

namespace zwang::runtime {

/// A joint with a motor that turns no wheel. Between the two frames its angle is their `rz`, its travel their
/// `z`.
struct HeldJoint {
  std::string name;
  int body = 0;      ///< that the joint moves
  int moves = 0;     ///< frame on that body, z along the joint's axis
  int measured = 0;  ///< frame on its parent, the same one at q = 0
  bool slides = false;
};

/// Appends the frames of the robot's joints that may have to be held.
std::vector<HeldJoint> find_held_joints(std::vector<lang::FrameDeclaration>& frames,
                                        const solver::Model& model);

/// Adds a group `hold` for every joint that no driver of the task or of `always` moves.
void add_holds(lang::Task& task, const lang::Always& always, const std::vector<HeldJoint>& joints,
               const std::vector<lang::FrameDeclaration>& frames, const solver::Model& model);

}  // namespace zwang::runtime
