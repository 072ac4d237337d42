/// Loading for a run that starts elsewhere than the scene says.
#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "zwang/export.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {

/// Where the robot starts, in the place of what the scene says.
struct Start {
  std::optional<std::array<double, 2>> at;  ///< [m] world
  std::optional<double> yaw;                ///< [rad]

  bool operator==(const Start&) const = default;
};

/// As `load`; whatever is asked about the start is asked there, and there the program's scene has it.
ZWANG_EXPORT std::optional<Program> load_from(const Start& start, const std::filesystem::path& path,
                                              const LoadOptions& options, Diagnostics& diagnostics);

}  // namespace zwang::lang
