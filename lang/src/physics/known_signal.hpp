/// What is known of outputs, and of the signals that a scene gives.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "physics/known.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

Known known_output(const CheckContext& context, int index);
Known known_signal(const std::string& name, const std::optional<Scene>& scene, const Robot& robot);

/// All values to which the file sets an output.
std::vector<const ValueText*> values_set(const CheckContext& context, const std::string& output);

}  // namespace zwang::lang
