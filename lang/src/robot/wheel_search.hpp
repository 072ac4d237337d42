/// Finds the wheels of a URDF by their joints, names and shapes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "robot/urdf.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

struct FoundWheels {
  std::string base;                     ///< the link that floats
  std::vector<DraftWheel> wheels;       ///< with a motor
  std::vector<DraftWheel> idle;         ///< without one, and they hold: a car's front wheels, for example
  std::vector<DraftWheel> casters;      ///< without one, on swivels that follow
  std::vector<std::string> coupled;     ///< joints of `idle` that follow a driven wheel by a <mimic>
  std::vector<std::string> steering;    ///< swivels that a motor turns
  std::vector<std::string> supports;    ///< links of balls
  std::vector<std::string> others;      ///< moving joints that are neither wheels, nor swivels, nor casters
  std::vector<std::string> in_between;  ///< moving joints between base and wheels that do not steer
  std::vector<StuckWheel> stuck;        ///< joints that are called wheels, and are none of the draft
  /// [m] Corners in the base, counter-clockwise, of the convex hull of its collision shapes and the wheels.
  /// Empty: its body is a mesh.
  std::vector<Eigen::Vector2d> outline;
};

/// With motors and without, those that hold the base.
std::vector<DraftWheel> holding_wheels(const FoundWheels& found);

FoundWheels find_wheels(const Urdf& urdf);

/// False, and told, where no robot has such wheels (E858): a file in millimetres has wheels of 50 m.
bool has_wheels_in_metres(const FoundWheels& found, const Urdf& urdf, Diagnostics& diagnostics);

}  // namespace zwang::lang
