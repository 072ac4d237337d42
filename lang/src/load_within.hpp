/// Task files that are loaded together.
#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "zwang/lang/program.hpp"

namespace zwang::lang {

/// Where the robot starts, in the place of what the scene says.
struct Start {
  std::optional<std::array<double, 2>> at;  ///< [m] world
  std::optional<double> yaw;                ///< [rad]

  bool operator==(const Start&) const = default;
};
void put_start(const Start& start, Scene& scene);

/// As `load`. `budget` is that of `check`: what loading this file leaves of it.
std::optional<Program> load_within(double& budget, const std::filesystem::path& path,
                                   const LoadOptions& options, const Start& start, Diagnostics& diagnostics);

}  // namespace zwang::lang
