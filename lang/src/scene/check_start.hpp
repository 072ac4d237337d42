/// Whether what a scene puts on the floor can stand there together.
#pragma once

#include "zwang/lang/robot.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// E913: where robots start, `first` and those of the scene that are loaded, nothing that they could touch
/// may stand, and no other robot. Nor may objects overlap that can be pushed. W644: an object that a bumper
/// of unknown height may pass, and a bumper above all objects.
void check_start(const Scene& scene, const Robot& first, Diagnostics& diagnostics);
/// The E913 of objects alone, for bumpers as high as those of a robot file that says nothing.
void check_objects_at_start(const Scene& scene, Diagnostics& diagnostics);

}  // namespace zwang::lang
