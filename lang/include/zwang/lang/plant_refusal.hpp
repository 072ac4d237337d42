/// The refusal of a simulated plant as a diagnostic, at its place in the files.
#pragma once

#include <string>

#include "zwang/export.hpp"
#include "zwang/lang/diagnostic.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// E915, at the object, robot or joint that `reason` names in back ticks. Without a name: where the robot
/// file begins to name joints. `scene` may be nullptr.
ZWANG_EXPORT void tell_plant_refusal(const std::string& reason, const Robot& robot, const Scene* scene,
                                     Diagnostics& diagnostics);

}  // namespace zwang::lang
