/// The task files of a scene's other robots.
#pragma once

#include <filesystem>

#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// Loads the task file of each robot of `scene`, which was read from `path`. The task files lie below `root`.
/// A scene that a task file names is not loaded. `budget` is that of `check`. False on an error.
bool load_robots_of(Scene& scene, const std::filesystem::path& path, const std::filesystem::path& root,
                    double& budget, Diagnostics& diagnostics);

}  // namespace zwang::lang
