/// Scene files below a root folder.
#pragma once

#include <filesystem>
#include <optional>

#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// As `load_scene`; `cause` is where the task file named the scene, and what the scene names lies below
/// `root`. `budget` is that of `check`.
std::optional<Scene> load_scene_from(const std::filesystem::path& path, const std::filesystem::path& root,
                                     const Span& cause, double& budget, Diagnostics& diagnostics);

/// Of a source that was read already.
std::optional<Scene> read_scene(int source, Diagnostics& diagnostics);

}  // namespace zwang::lang
