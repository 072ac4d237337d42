/// The parts of a task file below `tasks`.
#pragma once

#include "spec/shape.hpp"
#include "spec/task_file.hpp"

namespace zwang::lang {

TaskText parse_task(const Entry& entry, Diagnostics& diagnostics);
/// `{name: group, ..}`
std::vector<GroupText> parse_groups(const Node& node, Diagnostics& diagnostics);
/// `[exit, ..]`
std::vector<ExitText> parse_exits(const Node& node, Diagnostics& diagnostics);
/// `at`, and `yaw` or `rpy`; empty where not given. [m, rad]
void parse_pose(MapReader& map, std::vector<double>& at, std::vector<double>& rpy, Diagnostics& diagnostics);

}  // namespace zwang::lang
