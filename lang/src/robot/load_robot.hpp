/// Robot files below a root folder.
#pragma once

#include <filesystem>
#include <optional>

#include "robot/urdf.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::lang {

/// As `load_robot`; `cause` is where the task file named the robot.
std::optional<Robot> load_robot_below(const std::filesystem::path& path, const std::filesystem::path& root,
                                      const Span& cause, Diagnostics& diagnostics);

/// From the text of a robot file and a URDF that was read already.
std::optional<Robot> build_robot(const std::string& robot_file, Urdf urdf, Diagnostics& diagnostics);

}  // namespace zwang::lang
