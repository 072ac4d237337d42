/// A URDF stays as its maker wrote it: the robot file says which joints stand still and which links are not
/// there.
#pragma once

#include "robot/robot_file.hpp"
#include "robot/urdf.hpp"

namespace zwang::lang {

/// The joint stands still from now on, at 0 or at the end of its travel that is nearest to it.
void hold(UrdfJoint& joint);

/// Joints of `fixed` stand at 0, or at the end of their travel that is nearest to it. Complains of names in
/// `fixed` and `ignore` that are unknown, and of parts that the file leaves out and uses.
void adapt_urdf(const RobotFile& file, Urdf& urdf, Diagnostics& diagnostics);

}  // namespace zwang::lang
