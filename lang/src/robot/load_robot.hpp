/// Robot files below a root folder.
#pragma once

#include <filesystem>
#include <optional>

#include "robot/robot_file.hpp"
#include "robot/urdf.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::lang {

/// As `load_robot`; `cause` is where the task file named the robot.
std::optional<Robot> load_robot_below(const std::filesystem::path& path, const std::filesystem::path& root,
                                      const Span& cause, Diagnostics& diagnostics);

/// Puts the two together. nullopt when there are more than `errors_before` errors.
std::optional<Robot> build_robot(const RobotFile& file, Urdf urdf, int errors_before,
                                 Diagnostics& diagnostics);

}  // namespace zwang::lang
