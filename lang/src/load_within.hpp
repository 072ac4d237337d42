/// Task files that are loaded together.
#pragma once

#include <filesystem>
#include <optional>

#include "zwang/lang/start.hpp"

namespace zwang::lang {

void put_start(const Start& start, Scene& scene);

/// As `load`. `budget` is that of `check`: what loading this file leaves of it.
std::optional<Program> load_within(double& budget, const std::filesystem::path& path,
                                   const LoadOptions& options, const Start& start, Diagnostics& diagnostics);

}  // namespace zwang::lang
