/// The parts of a scene file that unfold in time: scripted signals, measured ones, motions.
#pragma once

#include <vector>

#include "spec/shape.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// `{name: {script: ..} | {pose_of: ..} | {distance_to: ..} | {latch: ..}, + how it is measured}`
std::vector<SceneSignal> parse_scene_signals(const Node& node, const std::vector<SceneObject>& objects,
                                             Diagnostics& diagnostics);
/// `[{time, at, yaw}, ..]`
std::vector<Waypoint> parse_motion(const Node& node, const std::string& what, Diagnostics& diagnostics);
/// `{at, reach, hook}`
std::optional<Dock> parse_dock(const Node& node, const std::string& what, Diagnostics& diagnostics);
/// `perfect`, or noise.
StateNoise parse_state_noise(const Node& node, Diagnostics& diagnostics);

}  // namespace zwang::lang
