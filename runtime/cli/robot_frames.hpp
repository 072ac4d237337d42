/// Where the frames of a robot sit and point, as `zwang robot inspect` prints them.
#pragma once

#include <string>
#include <vector>

#include "zwang/lang/robot.hpp"

namespace zwang::cli {

struct SeenFrame {
  std::string name;
  solver::Pose pose;  ///< in the base, at the start
};

/// The frames that tasks move or measure at.
std::vector<SeenFrame> frames_at_start(const lang::Robot& robot);
/// A line for each; empty without any.
std::string frames_text(const lang::Robot& robot);

}  // namespace zwang::cli
