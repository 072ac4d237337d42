/// A scene file together with the robot that it is meant for.
#pragma once

#include <filesystem>
#include <optional>

#include "zwang/export.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// As `load_scene`, and checks what the scene names of the first robot, which the file `robot` describes:
/// hooks, wheels that fail, rollers.
ZWANG_EXPORT std::optional<Scene> load_scene_for(const std::filesystem::path& robot,
                                                 const std::filesystem::path& path, Diagnostics& diagnostics);

}  // namespace zwang::lang
