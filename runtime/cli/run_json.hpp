/// The parts of a report that hang on the runner alone, as JSON: a log of `zwang drive` has them, too.
#pragma once

#include <string>
#include <vector>

#include "json_parts.hpp"
#include "zwang/lang/diagnostic.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::cli {

/// The name of a task; of `done` and `failed`, too.
std::string task_name(const runtime::Scheduler& scheduler, int task);

/// The other exits that would have fired on that tick, in the words of the task file.
std::vector<std::string> also_true(const runtime::Scheduler& scheduler,
                                   const runtime::Transition& transition);

/// The broken limits before the others, each in the order of the files.
std::vector<runtime::LimitReport> broken_first(std::vector<runtime::LimitReport> limits);

nlohmann::ordered_json json_transitions(const runtime::Runner& runner, const lang::Diagnostics& diagnostics);
nlohmann::ordered_json json_limits(const runtime::Runner& runner, const lang::Diagnostics& diagnostics);
nlohmann::ordered_json json_events(const runtime::Runner& runner);

}  // namespace zwang::cli
