/// How `zwang plan` tells what it found of a task.
#pragma once

#include <string>
#include <vector>

#include "zwang/runtime/planner.hpp"

namespace zwang::cli {

using runtime::Configurations;
using runtime::PlannedAxis;
using runtime::PlannedRow;
using runtime::Spread;
using runtime::TaskPlan;

std::string human(const TaskPlan& plan, int mobility, const Configurations& configurations,
                  const lang::Diagnostics& diagnostics);
/// All tasks as one JSON object.
std::string json(const std::vector<TaskPlan>& plans, int mobility, const Configurations& configurations,
                 const lang::Diagnostics& diagnostics);

}  // namespace zwang::cli
