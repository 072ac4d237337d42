/// The links that carry a base and hold nothing: balls, stiff casters, skids.
#pragma once

#include "robot/robot_file.hpp"
#include "robot/urdf.hpp"

namespace zwang::lang {

/// E302, E802: supports that the URDF does not have, or that a joint moves.
void check_supports(const RobotFile& file, const Urdf& urdf, Diagnostics& diagnostics);

/// A frame of the base, straight above the place where a support touches the floor.
struct SupportFrame {
  std::string name;  ///< the link's own frame, or a new one in the middle of what is round of it
  std::string link;
  solver::Vector3 at = solver::Vector3::Zero();  ///< [m] in the link
  bool is_new() const { return name != link; }
};
/// One for each link, however often the file names it.
std::vector<SupportFrame> support_frames(const RobotFile& file, const Urdf& urdf);

}  // namespace zwang::lang
