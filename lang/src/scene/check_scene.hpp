/// Checks of names in scenes and scenarios that belong to a robot which another file chooses.
#pragma once

#include <vector>

#include "zwang/lang/robot.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// Hooks, sensors, hands, wheels that fail, real rollers, where the robots start: E301, E907, E911, E913.
/// `robot` is the first one.
void check_scene_for(const Scene& scene, const Robot& robot, Diagnostics& diagnostics);
/// The joints of the first robot's faults.
void check_faults_for(const std::vector<Fault>& faults, const Robot& robot, Diagnostics& diagnostics);
/// The joints of the faults of the scene's other robots, which are loaded. Each named robot has to be in the
/// scene.
void check_faults_of_partners(const std::vector<Fault>& faults, const Scene& scene, Diagnostics& diagnostics);
/// The objects of the faults by which an object leaves: E301.
void check_leaving_objects(const std::vector<Fault>& faults, const Scene& scene, Diagnostics& diagnostics);
/// The frames of the other robots that sensors and hands name: E301.
void check_partners(const Scene& scene, Diagnostics& diagnostics);

}  // namespace zwang::lang
