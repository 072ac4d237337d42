/// Faults, as scene and scenario files write them.
#pragma once

#include <vector>

#include "tree/node.hpp"
#include "zwang/lang/diagnostic.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// `[{at: 2 s, wheel: left_wheel, torque: lost}, ..]`
std::vector<Fault> parse_faults(const Node& node, Diagnostics& diagnostics);

/// Whether the robots that they name are in the scene, and have these motors: E301. The scene's robots are
/// loaded.
void check_faults_of_partners(const std::vector<Fault>& faults, const Scene& scene, Diagnostics& diagnostics);
/// The same of the first robot.
void check_faults_of(const std::vector<Fault>& faults, const Robot& robot, Diagnostics& diagnostics);

}  // namespace zwang::lang
