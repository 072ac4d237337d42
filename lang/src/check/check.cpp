#include "check/check.hpp"

#include <algorithm>
#include <set>

#include "check/check_feeling.hpp"
#include "check/check_sets.hpp"
#include "check/context.hpp"
#include "check/parameter_values.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_habits.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "words/nearest.hpp"

namespace zwang::lang {

bool is_frame_set(const TaskFile& file, const std::string& frame) {
  const auto is_set_by = [&](const std::vector<SetText>& sets) {
    for (const SetText& set : sets) {
      if (set.kind == SetKind::frame && set.name.text == frame) return true;
    }
    return false;
  };
  for (const ExitText& exit : file.always_exits) {
    if (is_set_by(exit.set)) return true;
  }
  for (const TaskText& task : file.tasks) {
    if (is_set_by(task.set_on_entry)) return true;
    for (const ExitText& exit : task.exits) {
      if (is_set_by(exit.set)) return true;
    }
  }
  return false;
}

namespace {

/// Bool signals and `elapsed` do not flicker; everything that is measured as a number does.
bool measures(const CheckContext& context, const Condition& condition) {
  for (const ExpressionNode& node : condition.nodes) {
    if (node.op == Op::coordinate || node.op == Op::of_frame || node.op == Op::feature ||
        node.op == Op::estimated_force || node.op == Op::estimated_wrench) {
      return true;
    }
    const bool is_number =
        node.op == Op::signal &&
        context.symbols.signals[static_cast<std::size_t>(node.index)].signal.type != SignalType::boolean;
    if (is_number) return true;
  }
  return false;
}

/// Whether an exit under `always` leads to where nobody can tell: perhaps to the task that goes `back`.
bool has_unknown_interruption(const CheckContext& context) {
  const auto& exits = context.file.always_exits;
  return std::any_of(exits.begin(), exits.end(), [&](const ExitText& exit) {
    const std::string& target = exit.target.text;
    return target != "done" && target != "failed" && target != "back" && !context.symbols.find_task(target);
  });
}

/// `task` is the one that the target stands in; nullptr under `always`.
void check_target(CheckContext& context, const Word& target, const TaskText* task) {
  if (!target.exists() || target.text == "done" || target.text == "failed") return;
  if (target.text == "back") {
    if (context.symbols.find_task("back")) return;  // the name of that task is the mistake (E105)
    const std::vector<std::string> interrupting = interrupting_tasks(context);
    const bool can_go_back = task == nullptr ? !interrupting.empty()
                                             : std::find(interrupting.begin(), interrupting.end(),
                                                         task->name.text) != interrupting.end();
    if (!can_go_back && !has_unknown_interruption(context))
      context.diagnostics.add(wording::back_without_interruption(target.span, task == nullptr));
    return;
  }
  if (context.symbols.find_task(target.text)) return;
  std::vector<std::string> known = context.symbols.tasks;
  known.insert(known.end(), {"done", "failed"});
  context.diagnostics.add(wording::unknown_target(target.span, target.text, known));
}

Condition check_exit(CheckContext& context, const ExitText& exit, const TaskText* task) {
  static const std::vector<GroupText> none;
  std::optional<Condition> condition;
  Dimension compared;
  if (!exit.when.is_bad) {
    condition = check_condition(context, exit.when, task != nullptr ? task->groups : none, &compared);
  }
  if (exit.dwell) check_time(context, *exit.dwell, "`for`", true);
  if (condition && !exit.dwell && !exit.is_incomplete && measures(context, *condition)) {
    context.diagnostics.add(wording::measured_without_for(exit.when.span));
  }
  if (condition) check_is_open(context, *condition, task != nullptr ? task->groups : none);
  if (condition && exit.release) check_release(context, exit, *condition, compared);
  check_target(context, exit.target, task);
  check_sets(context, exit.set);
  return condition.value_or(Condition{});
}

std::vector<Condition> check_task(CheckContext& context, const TaskText& task) {
  check_groups(context, task.groups);
  check_against_always(context, task);
  if (task.blend) check_time(context, *task.blend, "enter.blend", true);
  check_sets(context, task.set_on_entry);
  std::vector<Condition> conditions;
  for (const ExitText& exit : task.exits) conditions.push_back(check_exit(context, exit, &task));
  if (task.timeout && !task.timeout->is_never) {
    check_time(context, task.timeout->after, "timeout.after", false);
    check_target(context, task.timeout->target, &task);
  }
  if (task.attempts) check_target(context, task.attempts->target, &task);
  return conditions;
}

/// E303: a name that a template takes for something else. Names that nobody knows are told where they are
/// used.
void check_named_arguments(CheckContext& context) {
  const Symbols& symbols = context.symbols;
  const auto is_a = [&](const std::string& kind, const std::string& name) {
    if (kind == "frame") return symbols.find_frame(name).has_value();
    if (kind == "feature") return symbols.find_feature(name).has_value();
    if (kind == "region") return symbols.find_region(name).has_value();
    if (kind == "signal") return symbols.find_signal(name) || symbols.find_output(name);
    return symbols.find_task(name) || name == "done" || name == "failed" || name == "back";
  };
  if (context.diagnostics.has_errors()) return;
  std::set<std::string> told;  // a kind that is wrong in the template is so at each of its uses
  for (const NamedArgument& given : context.file.named_arguments) {
    if (is_a(given.kind, given.name.text) || told.contains(given.argument)) continue;
    for (const char* kind : {"frame", "feature", "region", "signal", "task"}) {
      if (!is_a(kind, given.name.text)) continue;
      context.diagnostics.add(wording::argument_of_another_kind(given.name.span, given.argument, given.kind,
                                                                given.name.text, kind));
      told.insert(given.argument);
      break;
    }
  }
}

/// A word that drives and is no signal: perhaps `here`, or a parameter without its `$`.
void complain_of_driver_name(CheckContext& context, const ValueText& value, const std::string& what) {
  if (context.symbols.find_parameter(value.name) != nullptr) {
    context.diagnostics.add(wording::parameter_without_dollar(value.span, value.name));
    return;
  }
  std::vector<std::string> known = context.symbols.signal_names();
  if (what.ends_with(".position")) known.push_back("here");
  context.diagnostics.add(wording::unknown_driver(value.span, value.name, nearest(value.name, known),
                                                  what.ends_with(".position")));
}

}  // namespace

bool check_driver_value(CheckContext& context, const ValueText& value, const Dimension& expected,
                        const std::string& what) {
  const std::optional<int> index =
      value.kind == ValueKind::name ? context.symbols.find_signal(value.name) : std::nullopt;
  if (value.kind != ValueKind::name) return check_value(context, value, expected, what);
  if (!index) {
    complain_of_driver_name(context, value, what);
    return false;
  }
  SignalSymbol& symbol = context.symbols.signals[static_cast<std::size_t>(*index)];
  symbol.is_used = true;
  if (symbol.is_bad) return false;
  if (symbol.signal.type == SignalType::number && symbol.dimension == expected) return true;
  if (symbol.signal.type != SignalType::number) {
    context.diagnostics.add(wording::not_a_number_signal(value.span, value.name, symbol.signal.span));
  } else {
    context.diagnostics.add(wording::wrong_parameter_dimension(value.span, what, expected, value.name,
                                                               symbol.dimension, symbol.signal.span));
  }
  return false;
}

namespace {

/// A parameter that was declared without a unit is wrong there, once, and not wherever it is used.
bool complain_of_bare_parameter(CheckContext& context, ParameterSymbol& symbol, const Dimension& expected) {
  for (const ParameterText& text : context.file.parameters) {
    const bool is_it = text.name.text == symbol.parameter.name && text.value.kind == ValueKind::quantity;
    if (!is_it || text.value.quantity.has_unit) continue;
    symbol.is_bad = true;
    context.diagnostics.add(wording::needs_unit(text.value.span, "parameter `" + text.name.text + "`",
                                                text.value.quantity.number, expected));
    return true;
  }
  return false;
}

}  // namespace

bool check_value(CheckContext& context, const ValueText& value, const Dimension& expected,
                 const std::string& what) {
  if (value.kind == ValueKind::quantity || value.kind == ValueKind::bad) {
    return require_quantity(value, expected, what, context.diagnostics);
  }
  if (value.kind == ValueKind::here) {
    context.diagnostics.add(wording::misplaced_here(value.span, what));
    return false;
  }
  if (value.kind == ValueKind::name) {
    context.diagnostics.add(wording::not_a_value(value.span, value.name));
    return false;
  }
  ParameterSymbol* symbol = context.symbols.find_parameter(value.name);
  if (symbol == nullptr && value.name == "here") {
    context.diagnostics.add(wording::dollar_before_here(value.span));
    return false;
  }
  if (symbol == nullptr) {
    const auto& declared = context.file.parameters;
    const bool is_declared_so = !is_identifier(value.name) &&
                                std::any_of(declared.begin(), declared.end(),
                                            [](const ParameterText& text) { return !text.name.exists(); });
    if (is_declared_so) return false;
    context.diagnostics.add(
        wording::unknown_parameter(value.span, value.name, context.symbols.parameter_names()));
    return false;
  }
  symbol->is_used = true;
  if (symbol->is_bad) return false;
  if (symbol->dimension != expected && complain_of_bare_parameter(context, *symbol, expected)) return false;
  if (symbol->dimension != expected) {
    context.diagnostics.add(wording::wrong_parameter_dimension(value.span, what, expected, value.name,
                                                               symbol->dimension, symbol->parameter.span));
    return false;
  }
  return true;
}

double present_value(const CheckContext& context, const ValueText& value) {
  if (value.kind != ValueKind::parameter) return value.quantity.value;
  const ParameterSymbol* symbol = context.symbols.find_parameter(value.name);
  return symbol == nullptr ? 0.0 : value.sign * symbol->parameter.value;
}

double dwell_of(const CheckContext& context, const ExitText& exit) {
  return exit.dwell ? present_value(context, *exit.dwell) : 0.0;
}

double blend_of(const CheckContext& context, const TaskText& task) {
  return task.blend ? present_value(context, *task.blend) : Task{}.blend.constant;
}

void check_time(CheckContext& context, const ValueText& value, const std::string& what, bool zero_allowed) {
  if (!check_value(context, value, dimension::time, what)) return;
  check_positive(context, value, what, zero_allowed);
}

void check_positive(CheckContext& context, const ValueText& value, const std::string& what,
                    bool zero_allowed) {
  const double now = present_value(context, value);
  if (now < 0.0 || (now == 0.0 && !zero_allowed)) {
    context.diagnostics.add(wording::not_positive(value.span, what, zero_allowed));
  } else {
    require_positive(context, value, what, zero_allowed);
  }
}

std::string base_of(const CheckContext& context) {
  return context.robot ? context.robot->base_frame : std::string();
}

std::optional<int> check_frame(CheckContext& context, const Word& name) {
  if (!name.exists()) return std::nullopt;
  const std::optional<int> index = context.symbols.find_frame(name.text);
  if (!index && name.text == "footprint") {
    context.diagnostics.add(wording::footprint_is_no_frame(name.span));
    return std::nullopt;
  }
  const std::optional<int> signal = index ? std::nullopt : context.symbols.find_signal(name.text);
  if (signal && context.symbols.signals[static_cast<std::size_t>(*signal)].signal.type == SignalType::pose) {
    context.diagnostics.add(wording::signal_is_no_frame(name.span, name.text));
    return std::nullopt;
  }
  if (!index) {
    if (is_frame_set(context.file, name.text)) {
      context.diagnostics.add(wording::frame_only_set(name.span, name.text));
    } else if (context.symbols.has_robot) {
      context.diagnostics.add(wording::unknown_frame(name.span, "frame", name.text,
                                                     context.symbols.frame_names(), base_of(context)));
    }
    return std::nullopt;
  }
  FrameSymbol& symbol = context.symbols.frames[static_cast<std::size_t>(*index)];
  symbol.is_used = true;
  if (symbol.is_bad) return std::nullopt;
  return index;
}

void check_statements(CheckContext& context, const std::optional<Scene>& scene, CheckedFile& checked) {
  const TaskFile& file = context.file;
  check_parameters(context);
  declare_signals(context);
  check_frames(context);
  check_world(context);
  check_outputs(context);
  if (scene) check_scene_signals(context, *scene);
  if (scene) check_held_docks(context, *scene);
  check_groups(context, file.always_groups);
  for (const ExitText& exit : file.always_exits) {
    checked.always_conditions.push_back(check_exit(context, exit, nullptr));
  }
  if (file.start.exists() && !file.tasks.empty() && !checked.symbols.find_task(file.start.text)) {
    context.diagnostics.add(
        wording::unknown_name(file.start.span, "task", file.start.text, checked.symbols.tasks));
  }
  for (const TaskText& task : file.tasks) {
    checked.conditions.push_back(check_task(context, task));
    std::optional<Condition> require;
    if (task.require && !task.require->is_bad) require = check_condition(context, *task.require, task.groups);
    checked.requirements.push_back(std::move(require));
  }
  check_named_arguments(context);
  check_flow(context, checked.conditions, checked.always_conditions);
  check_requirements(context, checked.requirements);
  check_unguarded_sets(context, {checked.conditions, checked.always_conditions, checked.requirements});
  check_feeling(context);
}

}  // namespace zwang::lang
