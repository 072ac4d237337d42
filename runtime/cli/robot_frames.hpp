/// Where the frames of a robot sit and point, as `zwang robot inspect` prints them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "zwang/lang/robot.hpp"

namespace zwang::cli {

/// A line for each frame that tasks move or measure at, seen from the base at the start; empty without any.
std::string frames_text(const lang::Robot& robot);
nlohmann::ordered_json frames_json(const lang::Robot& robot);

}  // namespace zwang::cli
