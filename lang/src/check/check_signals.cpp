// Whether a scene gives the signals that a task file declares, with their types.
#include <algorithm>

#include "check/context.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "words/nearest.hpp"

namespace zwang::lang {

namespace {

/// The dimension of a scene's number signal. nullopt: the signal gives no number.
std::optional<Dimension> number_of(const SceneSignal& signal) {
  if (signal.beyond) return std::nullopt;
  if (signal.kind == SceneSignalKind::distance) return dimension::length;
  if (signal.kind == SceneSignalKind::force) return dimension::force;
  const bool is_script = signal.kind == SceneSignalKind::script && signal.script_kind == ScriptKind::number;
  const bool is_travel = signal.kind == SceneSignalKind::travel;
  if (!is_script && !is_travel) return std::nullopt;
  return Dimension{signal.powers[0], signal.powers[1], signal.powers[2], signal.powers[3]};
}

std::string measured_by(const SceneSignal& signal) {
  if (const auto number = number_of(signal)) return describe(*number);
  if (signal.kind == SceneSignalKind::pose) return "a pose";
  if (signal.kind == SceneSignalKind::wrench && !signal.beyond) return "a wrench";
  return signal.script_kind == ScriptKind::lost && signal.kind == SceneSignalKind::script ? "nothing at all"
                                                                                          : "true or false";
}

std::string declared_as(const SignalSymbol& declared) {
  switch (declared.signal.type) {
    case SignalType::boolean:
      return "`type: bool`";
    case SignalType::number:
      return describe(declared.dimension);
    case SignalType::pose:
      return "a pose";
    case SignalType::wrench:
      break;
  }
  return "a wrench";
}

bool gives(const SceneSignal& signal, const SignalSymbol& declared) {
  const bool is_script = signal.kind == SceneSignalKind::script;
  const bool is_lost = is_script && signal.script_kind == ScriptKind::lost;
  switch (declared.signal.type) {
    case SignalType::boolean:
      return signal.kind == SceneSignalKind::latch || is_lost || signal.beyond ||
             (is_script && signal.script_kind == ScriptKind::truth);
    case SignalType::number:
      return is_lost || number_of(signal) == declared.dimension;
    case SignalType::pose:
      return signal.kind == SceneSignalKind::pose;
    case SignalType::wrench:
      return (signal.kind == SceneSignalKind::wrench && !signal.beyond) || is_lost;
  }
  return false;
}

/// What to write instead.
std::string remedy(const SceneSignal& signal, const SignalSymbol& declared) {
  const std::string unit = usual_unit(declared.dimension);
  const bool is_script = signal.kind == SceneSignalKind::script;
  if (is_script && declared.signal.type == SignalType::boolean)
    return "write `true` and `false` in the script, or declare the signal as `type: number`";
  if (is_script && declared.signal.type == SignalType::number && signal.script_kind == ScriptKind::truth)
    return "write numbers" + (unit.empty() ? std::string() : " in `" + unit + "`") +
           " in the script, or declare the signal as `type: bool`";
  if (is_script && declared.signal.type == SignalType::number)
    return unit.empty() ? "write plain numbers in the script, or give the signal its `unit`"
                        : "write the script in `" + unit + "`, or mend the signal's `unit`";
  const bool is_force = signal.kind == SceneSignalKind::force || signal.kind == SceneSignalKind::wrench;
  const bool is_travel = signal.kind == SceneSignalKind::travel && !signal.beyond;
  if (declared.signal.type == SignalType::boolean && (is_force || is_travel)) {
    const std::string least = is_force ? "1 N" : signal.powers[3] != 0 ? "1 deg" : "1 mm";
    return "write `beyond: " + least + "` beside it: true from there on; or declare it as what it is";
  }
  if (signal.beyond && declared.signal.type != SignalType::boolean)
    return "leave `beyond` out, or declare the signal as `type: bool`";
  return "give it another source, or declare it as what it is";
}

/// A misspelt name: the task file's signal would never come.
void check_name(CheckContext& context, const Scene& scene, const SceneSignal& signal) {
  std::vector<std::string> without_source;
  for (const std::string& name : context.symbols.signal_names()) {
    const bool has_source = std::any_of(scene.signals.begin(), scene.signals.end(),
                                        [&](const SceneSignal& other) { return other.name == name; });
    if (!has_source) without_source.push_back(name);
  }
  // A scene may serve several task files, and give more than this one asks for.
  const std::string meant = nearest(signal.name, without_source);
  if (!meant.empty()) context.diagnostics.add(wording::unheard_signal(signal.span, signal.name, meant));
}

/// A sample is `delay` old when it comes, and `period` older when the next one does.
void check_age(CheckContext& context, const SceneSignal& signal, int index) {
  const auto& stale_after = context.file.signals[static_cast<std::size_t>(index)].stale_after;
  if (!stale_after || stale_after->kind == ValueKind::bad) return;
  const double age = present_value(context, *stale_after);
  if (!(age > 0.0) || signal.delay + signal.period <= age) return;
  context.diagnostics.add(
      wording::signal_too_old(signal.span, signal.name, signal.delay, signal.period, age, stale_after->span));
}

/// A latch that `holds` a hook, in the dock of an object that a pull moves.
void check_hold(CheckContext& context, const Scene& scene, const SceneSignal& signal, int index) {
  const Word& hook = context.file.signals[static_cast<std::size_t>(index)].holds;
  const bool is_of_an_object = signal.object >= 0 && signal.object < static_cast<int>(scene.objects.size());
  if (!hook.exists() || signal.kind != SceneSignalKind::latch || !is_of_an_object) return;
  const SceneObject& object = scene.objects[static_cast<std::size_t>(signal.object)];
  if (object.inverse_mass() > 0.0)
    context.diagnostics.add(wording::partner_rolls(hook.span, hook.text, object.name, object.span));
}

/// Where the file first uses a signal that the scene does not give.
class UnfedSignal {
 public:
  UnfedSignal(const CheckContext& context, int signal) : context_(context), signal_(signal) {}

  struct Use {
    Span span;
    wording::UnfedUse kind;
  };
  /// Conditions first: those of `always`, then task by task.
  std::optional<Use> find() const {
    const TaskFile& file = context_.file;
    const Span* span = read_by(file.always_exits);
    for (std::size_t i = 0; span == nullptr && i < file.tasks.size(); ++i) span = read_by(file.tasks[i]);
    if (span != nullptr) return use_at(*span, wording::UnfedUse::condition);
    span = moved_by(file.always_groups);
    for (std::size_t i = 0; span == nullptr && i < file.tasks.size(); ++i)
      span = moved_by(file.tasks[i].groups);
    if (span != nullptr) return use_at(*span, wording::UnfedUse::motion);
    return std::nullopt;
  }

 private:
  const SignalSymbol& symbol() const { return context_.symbols.signals[static_cast<std::size_t>(signal_)]; }

  Use use_at(const Span& span, wording::UnfedUse kind) const {
    const bool is_wrench = symbol().signal.type == SignalType::wrench;
    return {span, is_wrench ? wording::UnfedUse::wrench : kind};
  }

  bool hangs_on_it(const Word& frame) const {
    const std::optional<int> index = context_.symbols.find_frame(frame.text);
    return index && context_.symbols.signal_of(*index) == signal_;
  }

  bool feature_hangs_on_it(const std::string& name) const {
    const std::optional<int> index = context_.symbols.find_feature(name);
    if (!index) return false;
    const Feature& feature = context_.symbols.features[static_cast<std::size_t>(*index)].feature;
    return context_.symbols.signal_of(feature.first) == signal_ ||
           context_.symbols.signal_of(feature.second) == signal_;
  }

  bool region_hangs_on_it(const std::string& name) const {
    const std::optional<int> index = context_.symbols.find_region(name);
    if (!index) return false;
    const Region& region = context_.symbols.regions[static_cast<std::size_t>(*index)].region;
    return context_.symbols.signal_of(region.parent) == signal_;
  }

  /// `pace`, `felt.x`, a distance to what the signal sees.
  const Span* read_by(const ConditionText& condition) const {
    const std::string& name = symbol().signal.name;
    for (const ExpressionText& node : condition.nodes) {
      const bool is_it = node.word == name || node.word.starts_with(name + ".");
      if (node.kind == ExpressionKind::name && (is_it || feature_hangs_on_it(node.word))) return &node.span;
    }
    return nullptr;
  }

  const Span* read_by(const std::vector<ExitText>& exits) const {
    for (const ExitText& exit : exits) {
      if (const Span* span = read_by(exit.when)) return span;
    }
    return nullptr;
  }

  const Span* read_by(const TaskText& task) const {
    const Span* span = task.require ? read_by(*task.require) : nullptr;
    return span != nullptr ? span : read_by(task.exits);
  }

  /// A value that drives, or the force of a yield.
  const Span* moved_by(const AxisText& axis) const {
    for (const std::optional<StatementText>& statement : axis.statements) {
      const bool is_it = statement && !statement->is_range && statement->value.kind == ValueKind::name &&
                         statement->value.name == symbol().signal.name;
      if (is_it) return &statement->value.span;
    }
    return axis.yield ? read_by(*axis.yield) : nullptr;
  }

  const Span* moved_by(const std::vector<GroupText>& groups) const {
    for (const GroupText& group : groups) {
      for (const Word* frame : {&group.in, &group.move}) {
        if (frame->exists() && hangs_on_it(*frame)) return &frame->span;
      }
      if (group.feature.exists() && feature_hangs_on_it(group.feature.text)) return &group.feature.span;
      if (group.region.exists() && region_hangs_on_it(group.region.text)) return &group.region.span;
      for (const AxisText& axis : group.axes) {
        if (const Span* span = moved_by(axis)) return span;
      }
    }
    return nullptr;
  }

  const CheckContext& context_;
  int signal_;
};

}  // namespace

void check_scene_signals(CheckContext& context, const Scene& scene) {
  for (const SceneSignal& signal : scene.signals) {
    const std::optional<int> index = context.symbols.find_signal(signal.name);
    if (!index) continue;
    const SignalSymbol& declared = context.symbols.signals[static_cast<std::size_t>(*index)];
    if (declared.is_bad) continue;
    if (gives(signal, declared)) {
      check_age(context, signal, *index);
      check_hold(context, scene, signal, *index);
    } else {
      context.diagnostics.add(wording::signal_of_another_type(
          signal.source_span, signal.name, measured_by(signal), declared_as(declared),
          remedy(signal, declared), declared.signal.span));
    }
  }
}

void check_scene_names(CheckContext& context, const Scene& scene) {
  for (const SceneSignal& signal : scene.signals) {
    if (!context.symbols.find_signal(signal.name)) check_name(context, scene, signal);
  }
}

void check_unfed_signals(CheckContext& context, const Scene& scene) {
  std::vector<std::string> unheard;  // W302 says of these what they may be meant for
  for (const SceneSignal& signal : scene.signals) {
    if (!context.symbols.find_signal(signal.name)) unheard.push_back(signal.name);
  }
  for (std::size_t i = 0; i < context.symbols.signals.size(); ++i) {
    const SignalSymbol& symbol = context.symbols.signals[i];
    const std::string& name = symbol.signal.name;
    const bool is_fed = std::any_of(scene.signals.begin(), scene.signals.end(),
                                    [&](const SceneSignal& signal) { return signal.name == name; });
    if (is_fed || symbol.is_bad || !nearest(name, unheard).empty()) continue;
    const auto use = UnfedSignal(context, static_cast<int>(i)).find();
    if (use) context.diagnostics.add(wording::unfed_signal(use->span, name, use->kind, symbol.signal.span));
  }
}

}  // namespace zwang::lang
