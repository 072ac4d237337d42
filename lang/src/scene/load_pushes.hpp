/// The hands of a scene file.
#pragma once

#include <vector>

#include "tree/node.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// `scene` has its objects and robots. The frames of robots are checked where the robots are known.
std::vector<ScenePush> parse_pushes(const Node& node, const Scene& scene, Diagnostics& diagnostics);

}  // namespace zwang::lang
