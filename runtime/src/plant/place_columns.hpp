#pragma once

#include <string>
#include <vector>

#include "zwang/runtime/recorder.hpp"

namespace zwang::runtime {

/// `truth.NAME.x`, `.y` and `.yaw` of an object or a robot.
void add_place_columns(const std::string& name, std::vector<Column>& columns);

}  // namespace zwang::runtime
