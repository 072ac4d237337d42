/// Task files that are loaded together.
#pragma once

#include <filesystem>
#include <optional>

#include "zwang/lang/program.hpp"

namespace zwang::lang {

/// As `load`. `budget` is that of `check`: what loading this file leaves of it.
std::optional<Program> load_within(double& budget, const std::filesystem::path& path,
                                   const LoadOptions& options, Diagnostics& diagnostics);

}  // namespace zwang::lang
