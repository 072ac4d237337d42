/// URDFs drawn by number: a drive, its layout, and the habits of those who export such files. The
/// drawing notes the truth about each robot.
#pragma once

#include <map>
#include <set>
#include <string>

#include "zwang/lang/task_draft.hpp"

namespace zwang::lang::test {

/// Where a robot that is no good is refused.
enum class RefusedAt { nowhere, urdf, robot_file };

struct GeneratedUrdf {
  std::string about;  ///< the drive and the habits, for messages
  std::string text;
  std::string base;                      ///< the link that floats
  std::map<std::string, double> wheels;  ///< [m] the radius of each wheel on the ground, by its joint
  std::set<std::string> motors;          ///< joints
  std::set<std::string> held;            ///< joints that do not move
  std::set<std::string> supports;        ///< links that stand on the ground and hold nothing
  std::string kind;                      ///< of wheels, where a URDF does not tell it: `skid` or `mecanum`
  double mass = 0.0;                     ///< [kg]
  double size = 1.0;                     ///< of the robot, 1 for half a metre of width
  bool radius_is_drawn = true;           ///< false: wheels are meshes
  Freedoms freedoms = Freedoms::all;
  RefusedAt refused_at = RefusedAt::nowhere;
  std::string reason;      ///< of the refusal: a code
  std::string held_wheel;  ///< a joint: the URDF holds its wheels, and the draft lets them turn
};

GeneratedUrdf generated_urdf(int number);

}  // namespace zwang::lang::test
