#include "check/endings.hpp"

#include <algorithm>
#include <cmath>
#include <set>

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

/// Whether an exit of the task, or what ends it, leads on to the other one.
bool leads_to(const CheckContext& context, const TaskText& task, const std::string& other) {
  const auto any = [&](const std::vector<ExitText>& exits) {
    return std::any_of(exits.begin(), exits.end(), [&](const ExitText& e) { return e.target.text == other; });
  };
  return any(task.exits) || any(context.file.always_exits) ||
         (task.timeout && task.timeout->target.text == other) ||
         (task.attempts && task.attempts->target.text == other);
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

bool is_entered_after(const CheckContext& context, const std::string& task, const std::string& earlier) {
  std::vector<std::string> open{earlier};
  std::set<std::string> reached;
  while (!open.empty()) {
    const std::string name = open.back();
    open.pop_back();
    const std::optional<int> from = context.symbols.find_task(name);
    if (!from) continue;
    const TaskText& text = context.file.tasks[static_cast<std::size_t>(*from)];
    if (leads_to(context, text, task)) return true;
    for (const TaskText& other : context.file.tasks) {
      if (leads_to(context, text, other.name.text) && reached.insert(other.name.text).second)
        open.push_back(other.name.text);
    }
  }
  return false;
}

bool is_entered_again(const CheckContext& context, const std::string& task) {
  return is_entered_after(context, task, task);
}

bool leads_back(const CheckContext& context) {
  return std::any_of(context.file.tasks.begin(), context.file.tasks.end(),
                     [&](const TaskText& task) { return leads_to(context, task, "back"); });
}

}  // namespace zwang::lang
