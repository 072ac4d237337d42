#include <algorithm>
#include <set>

#include "check/context.hpp"
#include "check/endings.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_never.hpp"
#include "zwang/lang/condition_function.hpp"

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

/// An exit's condition as the cases in which it is true, and as those in which it is false. None: it has a
/// parameter, which may take another value, or a threshold for its way back.
struct ExitCases {
  std::optional<std::vector<Case>> are_true, are_false;
};

ExitCases cases_of_exit(const CheckContext& context, const ExitText& exit, const Condition& condition,
                        const std::vector<GroupText>& groups) {
  const bool is_asked = !exit.release && exit.when.text.find('$') == std::string::npos;
  if (!is_asked) return {};
  return {cases_of(context, condition, groups), cases_of(context, condition, groups, true)};
}

/// Whether the first exit's condition is true wherever the second one's is: no case of the second one leaves
/// the first one false. Of times alone W511 tells.
bool covers(const ExitCases& first, const ExitCases& second) {
  if (!first.are_false || !second.are_true || first.are_false->empty() || second.are_true->empty())
    return false;
  const auto is_time = [](const Case& one) {
    return one.size() == 1 && one.begin()->second.node->op == Op::elapsed;
  };
  if (std::all_of(first.are_false->begin(), first.are_false->end(), is_time)) return false;
  return std::none_of(second.are_true->begin(), second.are_true->end(), [&](const Case& one) {
    return std::any_of(first.are_false->begin(), first.are_false->end(),
                       [&](const Case& other) { return both(one, other).has_value(); });
  });
}

/// A condition that an earlier one covers, with no shorter `for`, can never be the first to fire. Without
/// `conditions` only the same text counts: an exit of `always` waits while its target is active.
void check_hidden(CheckContext& context, const std::vector<ExitText>& exits,
                  const std::vector<Condition>& conditions, const std::vector<GroupText>& groups) {
  std::vector<ExitCases> cases(exits.size());
  for (std::size_t i = 0; i < conditions.size(); ++i)
    cases[i] = cases_of_exit(context, exits[i], conditions[i], groups);
  for (std::size_t i = 0; i < exits.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (dwell_of(context, exits[i]) < dwell_of(context, exits[j])) continue;
      const bool is_same = exits[i].when.text == exits[j].when.text;
      if (!is_same && !covers(cases[j], cases[i])) continue;
      context.diagnostics.add(wording::hidden_exit(exits[i].when.span, exits[j].when.span, is_same));
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

/// Empty, or what counts from the entry on and would have to be above 0 on entry.
std::string not_yet_counted(const CheckContext& context, const Case& one) {
  for (const auto& [key, demanded] : one) {
    const ExpressionNode& node = *demanded.node;
    const bool is_of_frame = node.op == Op::of_frame && function_of(node).adds_up;
    if (!is_of_frame && node.op != Op::elapsed) continue;
    if (!both(demanded.bounds, Bounds{0.0, 0.0}).is_empty()) continue;
    if (!is_of_frame) return "elapsed";
    const FrameSymbol& frame = context.symbols.frames[static_cast<std::size_t>(node.index)];
    return std::string(function_of(node).name) + "(" + frame.declaration.name + ")";
  }
  return "";
}

}  // namespace

void check_requirements(CheckContext& context, const std::vector<std::optional<Condition>>& requirements) {
  if (context.diagnostics.has_errors()) return;
  for (std::size_t i = 0; i < requirements.size(); ++i) {
    if (!requirements[i] || requirements[i]->nodes.empty()) continue;
    const TaskText& task = context.file.tasks[i];
    const auto cases = cases_of(context, *requirements[i], task.groups);
    if (!cases || is_decided(context, *requirements[i], task.groups)) continue;
    if (cases->empty()) {
      context.diagnostics.add(wording::contradicts_itself(task.require->span));
      continue;
    }
    std::string what;
    const bool is_never = std::all_of(cases->begin(), cases->end(), [&](const Case& one) {
      what = not_yet_counted(context, one);
      return !what.empty();
    });
    if (is_never) context.diagnostics.add(wording::never_on_entry(task.require->span, what));
  }
}

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
  for (std::size_t i = 0; i < context.file.tasks.size(); ++i)
    check_hidden(context, context.file.tasks[i].exits, conditions[i], context.file.tasks[i].groups);
  check_hidden(context, context.file.always_exits, {}, {});
  check_loops(context, conditions, always_conditions, reached);
  check_uses(context);
}

}  // namespace zwang::lang
