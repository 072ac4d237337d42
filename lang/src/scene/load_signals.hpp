/// The parts of a scene file that unfold in time: scripted signals, measured ones, motions.
#pragma once

#include <vector>

#include "scene/load_guide.hpp"
#include "spec/shape.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::lang {

/// [s] The longest delay of a signal, of a pose that corrects the wheels, and of a robot's own state. No
/// part remembers more, and twenty ticks without a sample are a fault.
inline constexpr double longest_delay = 1.9, longest_fix_delay = 0.4, longest_state_delay = 15e-3;

/// Something that signals can speak of.
struct Seen {
  std::string name;  ///< empty: there are more, whose names could not be read
  bool has_dock = false;
  TravelOf travel = TravelOf::nothing;
};

/// `{name: {script: ..} | {pose_of: ..} | {distance_to: ..} | {latch: ..} | {force_of: ..} | {travel_of: ..}
/// | {wrench_at: ..}, + how it is measured}` `seen` are the objects and robots of the scene, in the order of
/// SceneSignal::object. Only the first robot feels what it touches.
std::vector<SceneSignal> parse_scene_signals(const Node& node, const std::vector<Seen>& seen, bool is_first,
                                             Diagnostics& diagnostics);
/// `[{time, at, yaw}, ..]`
std::vector<Waypoint> parse_motion(const Node& node, const std::string& what, Diagnostics& diagnostics);
/// `{at, reach, hook}`
std::optional<Dock> parse_dock(const Node& node, const std::string& what, Diagnostics& diagnostics);
/// `perfect`, `wheels`, noise, or how the wheels are corrected.
StateNoise parse_state_noise(const Node& node, Diagnostics& diagnostics);

}  // namespace zwang::lang
