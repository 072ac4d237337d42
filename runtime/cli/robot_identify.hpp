/// The verb `robot identify`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verbs.hpp"

namespace zwang::cli {

struct RobotIdentifyArguments {
  std::vector<std::string> logs;
  std::optional<std::string> mass;    ///< as text
  std::optional<std::string> added;   ///< the load in the last log, as text
  std::optional<std::string> update;  ///< the robot file to write; none: the logged one
  bool dry_run = false;
  Format format = Format::human;
};
int robot_identify(const RobotIdentifyArguments& arguments);

}  // namespace zwang::cli
