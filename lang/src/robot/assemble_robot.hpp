/// A robot file and its URDF, both checked, become the robot that a program holds.
#pragma once

#include "robot/robot_file.hpp"
#include "robot/urdf.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::lang {

/// Links outward from the base, the file's frames and its wheels. Throws std::invalid_argument, with the name
/// in backquotes, for a body that cannot exist.
solver::Model model_of(const RobotFile& file, const Urdf& urdf);
/// The model, and what the file says beside it. Throws as `model_of` does.
Robot assemble_robot(const RobotFile& file, const Urdf& urdf);

}  // namespace zwang::lang
