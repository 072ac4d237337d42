#include <algorithm>
#include <set>

#include "check/context.hpp"
#include "diagnostic/wordings.hpp"

namespace zwang::lang {

namespace {

std::vector<std::string> targets_of(const TaskText& task) {
  std::vector<std::string> targets;
  for (const ExitText& exit : task.exits) targets.push_back(exit.target.text);
  if (task.timeout && !task.timeout->is_never) targets.push_back(task.timeout->target.text);
  return targets;
}

/// Tasks that a run can come to, from the start on.
std::set<std::string> reachable_tasks(const CheckContext& context) {
  std::set<std::string> reached;
  std::vector<std::string> open{context.file.start.text};
  while (!open.empty()) {
    const std::string name = open.back();
    open.pop_back();
    const std::optional<int> index = context.symbols.find_task(name);
    if (!index || !reached.insert(name).second) continue;
    const auto targets = targets_of(context.file.tasks[static_cast<std::size_t>(*index)]);
    open.insert(open.end(), targets.begin(), targets.end());
  }
  return reached;
}

bool waits_for_time(const std::vector<Condition>& conditions) {
  return std::any_of(conditions.begin(), conditions.end(), [](const Condition& condition) {
    return std::any_of(condition.nodes.begin(), condition.nodes.end(),
                       [](const ExpressionNode& node) { return node.op == Op::elapsed; });
  });
}

void check_ends(CheckContext& context, const std::vector<std::vector<Condition>>& conditions) {
  for (std::size_t i = 0; i < context.file.tasks.size(); ++i) {
    const TaskText& task = context.file.tasks[i];
    // A condition that could not be read has no nodes: what it waits for is not known.
    const bool has_bad_exit = std::any_of(conditions[i].begin(), conditions[i].end(),
                                          [](const Condition& condition) { return condition.nodes.empty(); });
    if (task.timeout || has_bad_exit || waits_for_time(conditions[i])) continue;
    context.diagnostics.add(wording::endless_task(task.name.span, task.name.text));
  }
}

void check_uses(CheckContext& context) {
  for (const ParameterSymbol& symbol : context.symbols.parameters) {
    if (!symbol.is_used) {
      context.diagnostics.add(wording::unused(symbol.parameter.span, "parameter", symbol.parameter.name));
    }
  }
  for (const FrameSymbol& symbol : context.symbols.frames) {
    if (symbol.is_declared && !symbol.is_used) {
      context.diagnostics.add(wording::unused(symbol.declaration.span, "frame", symbol.declaration.name));
    }
  }
}

}  // namespace

void check_flow(CheckContext& context, const std::vector<std::vector<Condition>>& conditions) {
  check_ends(context, conditions);
  // What an unreadable part may have used or led to is not known: no guesses on top of errors.
  if (context.diagnostics.has_errors()) return;
  const std::set<std::string> reached = reachable_tasks(context);
  for (const TaskText& task : context.file.tasks) {
    if (!reached.contains(task.name.text)) {
      context.diagnostics.add(wording::unreachable_task(task.name.span, task.name.text));
    }
  }
  check_uses(context);
}

}  // namespace zwang::lang
