// `set`: names and values, and whether the pose that a frame takes is known by then.
//
// While a pose signal is not known, whatever is asked of its frames is unknown, and `valid` of it is false.
// An exit asks for the signal if its condition cannot be true then, by Kleene's tables. Under `always` an
// unknown condition fires, too, so there it must be false.
#include "check/check_sets.hpp"

#include <algorithm>

#include "check/parameter_values.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_never.hpp"
#include "diagnostic/wordings_outputs.hpp"

namespace zwang::lang {

namespace {

void check_set_parameter(CheckContext& context, const SetText& set) {
  ParameterSymbol* symbol = context.symbols.find_parameter(set.name.text);
  if (symbol == nullptr) {
    context.diagnostics.add(
        wording::unknown_name(set.name.span, "parameter", set.name.text, context.symbols.parameter_names()));
    return;
  }
  const std::string what = "params." + set.name.text;
  if (symbol->is_bad || !check_value(context, set.value, symbol->dimension, what)) return;
  const double value = present_value(context, set.value);
  const auto& range = symbol->parameter.range;
  if (!range) return;
  if (value < range->low || value > range->high) {
    context.diagnostics.add(wording::outside_range(set.value.span, symbol->parameter, value));
    return;
  }
  const std::string rule = "`" + what + "` takes " + wording::in_unit_of(symbol->parameter, range->low) +
                           " to " + wording::in_unit_of(symbol->parameter, range->high);
  require(context, set.value, {.rule = rule, .limit = range->low});
  require(context, set.value, {.rule = rule, .limit = range->high, .is_least = false});
}

void check_set_frame(CheckContext& context, const SetText& set) {
  const std::optional<int> index = context.symbols.find_frame(set.name.text);
  const bool is_declared = index && context.symbols.frames[static_cast<std::size_t>(*index)].is_declared;
  if (!is_declared && (index || context.symbols.has_robot)) {
    std::vector<std::string> declared;
    for (const FrameText& frame : context.file.frames) declared.push_back(frame.name.text);
    context.diagnostics.add(index ? wording::not_settable(set.name.span, set.name.text)
                                  : wording::unknown_name(set.name.span, "frame", set.name.text, declared));
  }
  check_frame(context, set.source);
}

void check_set_output(CheckContext& context, const SetText& set) {
  const std::optional<int> index = context.symbols.find_output(set.name.text);
  if (!index) {
    context.diagnostics.add(
        wording::unknown_name(set.name.span, "output", set.name.text, context.symbols.output_names()));
    return;
  }
  OutputSymbol& symbol = context.symbols.outputs[static_cast<std::size_t>(*index)];
  symbol.is_used = true;
  if (symbol.is_bad || set.value.kind == ValueKind::bad) return;
  const std::string what = "outputs." + set.name.text;
  if (symbol.output.is_number) {
    check_value(context, set.value, symbol.dimension, what);
    return;
  }
  if (!truth_of(set.value)) context.diagnostics.add(wording::output_needs_truth(set.value.span, what, false));
}

/// The values that a node can have while the signal is not known. A number is only known or not.
struct Possible {
  bool no = false, yes = false, unknown = false;
};

Possible negated(const Possible& a) {
  return {a.yes, a.no, a.unknown};
}

Possible conjunction(const Possible& a, const Possible& b) {
  return {a.no || b.no, a.yes && b.yes, (a.unknown && (b.unknown || b.yes)) || (a.yes && b.unknown)};
}

/// A condition while one signal is not known.
class WithoutSignal {
 public:
  WithoutSignal(const CheckContext& context, int signal, const std::vector<GroupText>& groups)
      : context_(context), signal_(signal), groups_(groups) {}

  Possible root_of(const Condition& condition) const {
    std::vector<Possible> nodes;
    for (const ExpressionNode& node : condition.nodes) {
      const auto operand = [&](int index) {
        return index < 0 ? Possible{} : nodes[static_cast<std::size_t>(index)];
      };
      nodes.push_back(of(node, operand(node.left), operand(node.right)));
    }
    return nodes.empty() ? Possible{true, true, true} : nodes.back();
  }

 private:
  Possible of(const ExpressionNode& node, const Possible& a, const Possible& b) const {
    switch (node.op) {
      case Op::logical_not:
        return negated(a);
      case Op::logical_and:
        return conjunction(a, b);
      case Op::logical_or:
        return negated(conjunction(negated(a), negated(b)));
      case Op::valid:
        return node.index == signal_ ? Possible{.no = true} : Possible{.no = true, .yes = true};
      default:
        break;
    }
    const bool is_unknown =
        needs_signal(node) || (node.left >= 0 && a.unknown) || (node.right >= 0 && b.unknown);
    return is_unknown ? Possible{.unknown = true} : Possible{.no = true, .yes = true};
  }

  bool hangs_on_it(int frame) const { return context_.symbols.signal_of(frame) == signal_; }
  bool hangs_on_it(const Word& frame) const {
    const std::optional<int> index = context_.symbols.find_frame(frame.text);
    return index && hangs_on_it(*index);
  }
  bool feature_hangs_on_it(int index) const {
    const Feature& feature = context_.symbols.features[static_cast<std::size_t>(index)].feature;
    return hangs_on_it(feature.first) || hangs_on_it(feature.second);
  }

  bool needs_signal(const ExpressionNode& node) const {
    if (node.op == Op::signal) return node.index == signal_;
    if (node.op == Op::of_frame || node.op == Op::estimated_wrench) return hangs_on_it(node.index);
    if (node.op == Op::feature) return feature_hangs_on_it(node.index);
    const bool is_place = node.op == Op::coordinate && (node.what == CoordinateQuantity::position ||
                                                        node.what == CoordinateQuantity::velocity);
    if (!is_place) return false;
    const auto& groups = node.in_always ? context_.file.always_groups : groups_;
    const GroupText& group = groups[static_cast<std::size_t>(node.index)];
    if (group.kind != GroupKind::feature) return hangs_on_it(group.move) || hangs_on_it(group.in);
    const std::optional<int> feature = context_.symbols.find_feature(group.feature.text);
    return feature && feature_hangs_on_it(*feature);
  }

  const CheckContext& context_;
  int signal_;
  const std::vector<GroupText>& groups_;
};

/// W513: frames that may be set while the signal that they need is not known.
class UnguardedSets {
 public:
  UnguardedSets(CheckContext& context, const SetConditions& conditions)
      : context_(context), conditions_(conditions) {}

  void tell() {
    const TaskFile& file = context_.file;
    for (std::size_t i = 0; i < file.always_exits.size(); ++i) tell_exit(Way{nullptr, i});
    for (std::size_t t = 0; t < file.tasks.size(); ++t) {
      for (std::size_t i = 0; i < file.tasks[t].exits.size(); ++i) tell_exit(Way{&file.tasks[t], i});
      tell_entry(t);
    }
  }

 private:
  /// An exit of a task, or without one of `always`.
  struct Way {
    const TaskText* task = nullptr;
    std::size_t exit = 0;
  };

  const ExitText& exit_of(const Way& way) const {
    return way.task == nullptr ? context_.file.always_exits[way.exit] : way.task->exits[way.exit];
  }

  bool asks(const Way& way, int signal) const {
    static const std::vector<GroupText> none;
    const WithoutSignal without(context_, signal, way.task == nullptr ? none : way.task->groups);
    if (way.task == nullptr) {
      const Possible root = without.root_of(conditions_.of_always[way.exit]);
      return !root.yes && !root.unknown;
    }
    const auto task = static_cast<std::size_t>(way.task - context_.file.tasks.data());
    return !without.root_of(conditions_.of_tasks[task][way.exit]).yes;
  }

  /// The pose signals that must be known when the frame is set.
  std::vector<int> needed_by(const SetText& set) const {
    std::vector<int> signals;
    if (set.kind != SetKind::frame) return signals;
    for (const std::string& name : {set.source.text, set.name.text}) {
      const std::optional<int> frame = context_.symbols.find_frame(name);
      const int signal = frame ? context_.symbols.signal_of(*frame) : -1;
      if (signal >= 0 && std::find(signals.begin(), signals.end(), signal) == signals.end())
        signals.push_back(signal);
    }
    return signals;
  }

  const std::string& name_of(int signal) const {
    return context_.symbols.signals[static_cast<std::size_t>(signal)].signal.name;
  }

  void tell_exit(const Way& way) {
    const ExitText& exit = exit_of(way);
    if (exit.target.text == "done" || exit.target.text == "failed") return;
    for (const SetText& set : exit.set) {
      for (const int signal : needed_by(set)) {
        if (asks(way, signal)) continue;
        context_.diagnostics.add(
            wording::set_from_unknown(set.span, set.name.text, set.source.text, name_of(signal),
                                      way.task == nullptr ? wording::SetIn::always : wording::SetIn::exit,
                                      &exit.when.span, exit.when.text));
      }
    }
  }

  /// Whether the task cannot be entered without the signal.
  bool is_entered_with(std::size_t task, int signal) const {
    const TaskFile& file = context_.file;
    const TaskText& entered = file.tasks[task];
    const std::string& name = entered.name.text;
    const auto& require = conditions_.of_entries[task];
    if (require && !WithoutSignal(context_, signal, entered.groups).root_of(*require).yes) return true;
    if (file.start.text == name) return false;
    const auto leads_without = [&](const TaskText* from, const std::vector<ExitText>& exits) {
      for (std::size_t i = 0; i < exits.size(); ++i) {
        if (exits[i].target.text == name && !asks(Way{from, i}, signal)) return true;
      }
      return false;
    };
    return !leads_without(nullptr, file.always_exits) &&
           std::none_of(file.tasks.begin(), file.tasks.end(), [&](const TaskText& from) {
             const bool by_time =
                 from.timeout && !from.timeout->is_never && from.timeout->target.text == name;
             const bool by_attempts = from.attempts && from.attempts->target.text == name;
             return by_time || by_attempts || leads_without(&from, from.exits);
           });
  }

  void tell_entry(std::size_t task) {
    const TaskText& entered = context_.file.tasks[task];
    for (const SetText& set : entered.set_on_entry) {
      for (const int signal : needed_by(set)) {
        if (is_entered_with(task, signal)) continue;
        context_.diagnostics.add(wording::set_from_unknown(
            set.span, set.name.text, set.source.text, name_of(signal), wording::SetIn::entry, nullptr, {}));
      }
    }
  }

  CheckContext& context_;
  const SetConditions& conditions_;
};

}  // namespace

void check_sets(CheckContext& context, const std::vector<SetText>& sets) {
  for (const SetText& set : sets) {
    switch (set.kind) {
      case SetKind::frame:
        check_set_frame(context, set);
        break;
      case SetKind::parameter:
        check_set_parameter(context, set);
        break;
      case SetKind::output:
        check_set_output(context, set);
        break;
    }
  }
}

void check_unguarded_sets(CheckContext& context, const SetConditions& conditions) {
  if (!context.diagnostics.has_errors()) UnguardedSets(context, conditions).tell();
}

}  // namespace zwang::lang
