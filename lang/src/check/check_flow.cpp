#include <algorithm>
#include <set>

#include "check/context.hpp"
#include "check/endings.hpp"
#include "diagnostic/wordings.hpp"

namespace zwang::lang {

namespace {

std::vector<std::string> targets_of(const TaskText& task) {
  std::vector<std::string> targets;
  for (const ExitText& exit : task.exits) targets.push_back(exit.target.text);
  if (task.timeout && !task.timeout->is_never) targets.push_back(task.timeout->target.text);
  if (task.attempts) targets.push_back(task.attempts->target.text);
  return targets;
}

std::vector<std::string> targets_of_always(const CheckContext& context) {
  std::vector<std::string> targets;
  for (const ExitText& exit : context.file.always_exits) targets.push_back(exit.target.text);
  return targets;
}

/// Tasks that a run can come to from some of them on, these included.
std::set<std::string> reachable_tasks(const CheckContext& context, std::vector<std::string> open) {
  std::set<std::string> reached;
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
    if (task.is_bad || task.timeout || has_bad_exit || waits_for_time(conditions[i])) continue;
    context.diagnostics.add(wording::endless_task(task.name.span, task.name.text));
  }
}

/// The same condition again, with no shorter `for`, can never be the first to fire.
void check_hidden(CheckContext& context, const std::vector<ExitText>& exits) {
  for (std::size_t i = 0; i < exits.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (exits[i].when.text != exits[j].when.text ||
          dwell_of(context, exits[i]) < dwell_of(context, exits[j]))
        continue;
      context.diagnostics.add(wording::hidden_exit(exits[i].when.span, exits[j].when.span));
      break;
    }
  }
}

void check_uses(CheckContext& context) {
  for (const ParameterSymbol& symbol : context.symbols.parameters) {
    if (!symbol.is_used) {
      context.diagnostics.add(wording::unused(symbol.parameter.span, "parameter", symbol.parameter.name));
    }
  }
  for (const SignalSymbol& symbol : context.symbols.signals) {
    if (!symbol.is_used) {
      context.diagnostics.add(wording::unused(symbol.signal.span, "signal", symbol.signal.name));
    }
  }
  for (const OutputSymbol& symbol : context.symbols.outputs) {
    if (!symbol.is_used) {
      context.diagnostics.add(wording::unused(symbol.output.span, "output", symbol.output.name));
    }
  }
  for (const RegionSymbol& symbol : context.symbols.regions) {
    if (!symbol.is_used) {
      context.diagnostics.add(wording::unused(symbol.region.span, "region", symbol.region.name));
    }
  }
  for (const FeatureSymbol& symbol : context.symbols.features) {
    if (!symbol.is_used) {
      context.diagnostics.add(wording::unused(symbol.feature.span, "feature", symbol.feature.name));
    }
  }
  for (const FrameSymbol& symbol : context.symbols.frames) {
    if (symbol.is_declared && !symbol.is_used) {
      const char* kind = symbol.path >= 0 ? "path" : "frame";
      context.diagnostics.add(wording::unused(symbol.declaration.span, kind, symbol.declaration.name));
    }
  }
}

}  // namespace

std::vector<std::string> interrupting_tasks(const CheckContext& context) {
  const std::set<std::string> reached = reachable_tasks(context, targets_of_always(context));
  return {reached.begin(), reached.end()};
}

void check_flow(CheckContext& context, const std::vector<std::vector<Condition>>& conditions,
                const std::vector<Condition>& always_conditions) {
  check_ends(context, conditions);
  // An unreadable part may have used a name or led to a task. So a file with errors gets no further guesses.
  if (context.diagnostics.has_errors()) return;
  std::vector<std::string> entries = targets_of_always(context);
  entries.push_back(context.file.start.text);
  const std::set<std::string> reached = reachable_tasks(context, entries);
  for (const TaskText& task : context.file.tasks) {
    if (!reached.contains(task.name.text)) {
      context.diagnostics.add(wording::unreachable_task(task.name.span, task.name.text));
    }
  }
  for (const TaskText& task : context.file.tasks) check_hidden(context, task.exits);
  check_hidden(context, context.file.always_exits);
  check_loops(context, conditions, always_conditions, reached);
  check_uses(context);
}

}  // namespace zwang::lang
