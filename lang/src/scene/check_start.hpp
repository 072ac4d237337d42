/// Whether what a scene puts on the floor can stand there together.
#pragma once

#include "zwang/lang/robot.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// E913: where robots start, `first` and those of the scene that are loaded, nothing that they could touch
/// may stand, and no other robot. W644: an object that a bumper of unknown height may pass.
void check_start(const Scene& scene, const Robot& first, Diagnostics& diagnostics);

}  // namespace zwang::lang
