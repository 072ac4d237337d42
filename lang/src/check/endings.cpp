#include "check/endings.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::lang {

namespace {

/// Two exits that are certain at the same instant: the upper one fires. [s]
constexpr double tie = 1e-9;

bool is_elapsed(const Case& one) {
  return one.size() == 1 && one.begin()->second.node->op == Op::elapsed;
}

/// When an exit that waits for time alone fires; none: it waits for something else, too.
std::optional<double> certain(const CheckContext& context, const TaskText& task, const ExitText& exit,
                              const Condition& condition) {
  const auto cases = cases_of(context, condition, task.groups);
  if (!cases) return std::nullopt;
  for (const Case& one : *cases) {
    const bool waits = is_elapsed(one) && std::isinf(one.begin()->second.bounds.high);
    if (waits) return std::max(0.0, one.begin()->second.bounds.low) + dwell_of(context, exit);
  }
  return std::nullopt;
}

}  // namespace

double earliest(const CheckContext& context, const TaskText& task, const ExitText& exit,
                const Condition& condition) {
  const auto cases = cases_of(context, condition, task.groups);
  double least = cases && !cases->empty() ? std::numeric_limits<double>::infinity() : 0.0;
  for (const Case& one : cases.value_or(std::vector<Case>{})) {
    double after = 0.0;
    for (const auto& [key, demanded] : one) {
      if (demanded.node->op == Op::elapsed) after = std::max(after, demanded.bounds.low);
    }
    least = std::min(least, after);
  }
  return least + dwell_of(context, exit);
}

Ending ending_before(const CheckContext& context, const TaskText& task,
                     const std::vector<Condition>& conditions, std::size_t exit) {
  Ending ending;
  const bool has_timeout =
      task.timeout && !task.timeout->is_never && !is_set_later(context, task.timeout->after);
  if (has_timeout)
    ending = {present_value(context, task.timeout->after), "`timeout`", task.timeout->after.span};
  for (std::size_t i = 0; i < task.exits.size(); ++i) {
    // W507 tells of the same condition again.
    const bool is_same = exit < task.exits.size() && task.exits[i].when.text == task.exits[exit].when.text;
    if (is_same || conditions[i].nodes.empty()) continue;
    const std::optional<double> fires = certain(context, task, task.exits[i], conditions[i]);
    const double time = fires.value_or(ending.time) + (i > exit ? tie : 0.0);
    if (time < ending.time) ending = {time, "another exit", task.exits[i].when.span};
  }
  if (exit < task.exits.size()) ending.time -= dwell_of(context, task.exits[exit]);
  return ending;
}

}  // namespace zwang::lang
