/// Which joints of a URDF turn wheels, by name, shape or place.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "robot/placed_urdf.hpp"

namespace zwang::lang {

/// A ball that rolls every way: joints about two level axes or more, which cross in the middle of a sphere.
struct BallCaster {
  std::string link;
  double lowest = 0.0;              ///< [m] in the base
  std::vector<std::string> joints;  ///< from the ball up
  bool is_on_base = false;          ///< nothing else moves it
};

struct WheelCandidates {
  std::vector<const UrdfJoint*> wheels;     ///< in the order of the text
  std::map<const UrdfJoint*, double> rims;  ///< [m] radii of wheels whose rollers are joints
  std::vector<std::string> rollers;         ///< those joints
  std::vector<BallCaster> balls;
};

WheelCandidates wheel_candidates(const PlacedUrdf& placed);

}  // namespace zwang::lang
