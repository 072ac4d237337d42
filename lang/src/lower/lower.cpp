#include "lower/lower.hpp"

namespace zwang::lang {

namespace {

using solver::Quantity;

/// Every look-up below was proved by `check`.
class Lowering {
 public:
  explicit Lowering(CheckedFile checked) : checked_(std::move(checked)) {}

  Program lower() {
    Program program;
    program.about = checked_.file.about;
    for (const ParameterSymbol& symbol : checked_.symbols.parameters) {
      program.parameters.push_back(symbol.parameter);
      // Without a range of its own, its places bound it.
      const bool is_bounded =
          symbol.admitted.low > -solver::infinity || symbol.admitted.high < solver::infinity;
      if (!symbol.parameter.range && is_bounded) program.parameters.back().range = symbol.admitted;
    }
    for (const FrameSymbol& symbol : checked_.symbols.frames) program.frames.push_back(symbol.declaration);
    for (const SignalSymbol& symbol : checked_.symbols.signals) program.signals.push_back(symbol.signal);
    for (std::size_t i = 0; i < checked_.file.signals.size(); ++i) {
      const std::optional<ValueText>& age = checked_.file.signals[i].stale_after;
      if (age) program.signals[i].stale_after = value(*age);
    }
    for (const OutputSymbol& symbol : checked_.symbols.outputs) program.outputs.push_back(symbol.output);
    for (const RegionSymbol& symbol : checked_.symbols.regions) program.regions.push_back(symbol.region);
    for (const FeatureSymbol& symbol : checked_.symbols.features) program.features.push_back(symbol.feature);
    program.paths = checked_.file.paths;
    for (Path& path : program.paths) path.frame = *checked_.symbols.find_frame(path.name);
    for (const GroupText& group : checked_.file.always_groups) {
      program.always.groups.push_back(lower_group(group, 0));
    }
    for (std::size_t i = 0; i < checked_.file.always_exits.size(); ++i) {
      program.always.exits.push_back(
          lower_exit(checked_.file.always_exits[i], checked_.always_conditions[i]));
    }
    for (std::size_t i = 0; i < checked_.file.tasks.size(); ++i) {
      program.tasks.push_back(lower_task(checked_.file.tasks[i], checked_.conditions[i]));
      program.tasks.back().require = checked_.requirements[i];
    }
    program.start = *checked_.symbols.find_task(checked_.file.start.text);
    program.robot = std::move(checked_.robot);
    program.scene = std::move(checked_.scene);
    return program;
  }

 private:
  Value value(const ValueText& text) {
    if (text.kind == ValueKind::name) {
      Value result;
      result.signal = *checked_.symbols.find_signal(text.name);
      return result;
    }
    if (text.kind != ValueKind::parameter) return {.constant = text.quantity.value};
    const ParameterSymbol* symbol = checked_.symbols.find_parameter(text.name);
    const auto index = symbol - checked_.symbols.parameters.data();
    return {.constant = 0.0, .parameter = static_cast<int>(index), .sign = text.sign};
  }

  Target target(const Word& word) const {
    if (word.text == "done") return {TargetKind::done, -1};
    if (word.text == "failed") return {TargetKind::failed, -1};
    if (word.text == "back") return {TargetKind::back, -1};
    return {TargetKind::task, *checked_.symbols.find_task(word.text)};
  }

  AxisStatements lower_axis(const AxisText& text, const GroupText& group, int level) {
    AxisStatements axis;
    const bool is_feature = group.kind == GroupKind::feature;
    axis.name = is_feature ? group.name.text : group.name.text + "." + text.name.text;
    axis.axis = axis_named(text.name.text).value_or(solver::Axis::x);
    axis.is_planar = !is_feature && text.is_norm();
    axis.span = text.name.span;
    const std::array ranges{&axis.position, &axis.velocity, &axis.acceleration, &axis.force};
    for (const Quantity quantity :
         {Quantity::position, Quantity::velocity, Quantity::acceleration, Quantity::force}) {
      const std::optional<StatementText>& statement = text[quantity];
      if (!statement) continue;
      const auto index = static_cast<std::size_t>(quantity);
      axis.statement_spans[index] = statement->key_span;
      if (statement->is_range) {
        *ranges[index] = ValueRange{value(statement->low), value(statement->high)};
      } else {
        axis.driver = quantity;
        axis.here = statement->value.kind == ValueKind::here;
        if (!axis.here) axis.target = value(statement->value);
      }
    }
    const std::optional<ValueText>& time_constant =
        text.time_constant ? text.time_constant : group.time_constant;
    if (time_constant) axis.time_constant = value(*time_constant);
    if (text.yield) {
      lower_yield(text, axis);
    } else {
      if (text.stiffness) axis.stiffness = value(*text.stiffness);
      if (text.damping) axis.damping = value(*text.damping);
    }
    if (text.build_up) axis.build_up = value(*text.build_up);
    const std::optional<ValueText>& weight = text.weight ? text.weight : group.weight;
    if (weight) axis.weight = value(*weight);
    const std::optional<ValueText>& return_speed = text.return_speed ? text.return_speed : group.return_speed;
    if (return_speed) axis.return_speed = value(*return_speed);
    axis.level = text.level.value_or(group.level.value_or(level));
    return axis;
  }

  void lower_yield(const AxisText& text, AxisStatements& axis) {
    Yield yield{checked_.yields.at(&text), value(*text.mass), value(*text.damping), {}};
    if (text.dead_band) yield.dead_band = value(*text.dead_band);
    axis.yield = std::move(yield);
    axis.driver = Quantity::acceleration;
    axis.statement_spans[static_cast<std::size_t>(Quantity::acceleration)] = text.yield_span;
  }

  /// `level` is where rows stand that say nothing of it.
  Group lower_group(const GroupText& text, int level) {
    Group group;
    group.name = text.name.text;
    group.span = text.name.span;
    group.kind = text.kind;
    group.level = text.level.value_or(level);
    switch (text.kind) {
      case GroupKind::axes:
        group.move = *checked_.symbols.find_frame(text.move.text);
        group.in = *checked_.symbols.find_frame(text.in.text);
        group.path = checked_.symbols.frames[static_cast<std::size_t>(group.in)].path;
        break;
      case GroupKind::inside:
        group.region = *checked_.symbols.find_region(text.region.text);
        group.moves_footprint = text.move.text == "footprint";
        group.move =
            *checked_.symbols.find_frame(group.moves_footprint ? checked_.robot.base_frame : text.move.text);
        if (text.margin) group.margin = value(*text.margin);
        if (text.return_speed) group.return_speed = value(*text.return_speed);
        break;
      case GroupKind::feature:
        group.feature = *checked_.symbols.find_feature(text.feature.text);
        break;
    }
    for (const AxisText& axis : text.axes) group.axes.push_back(lower_axis(axis, text, level));
    return group;
  }

  std::vector<SetAction> lower_sets(const std::vector<SetText>& texts) {
    std::vector<SetAction> sets;
    for (const SetText& text : texts) {
      SetAction set;
      set.span = text.span;
      set.kind = text.kind;
      switch (text.kind) {
        case SetKind::frame:
          set.index = *checked_.symbols.find_frame(text.name.text);
          set.source = *checked_.symbols.find_frame(text.source.text);
          break;
        case SetKind::parameter: {
          const ParameterSymbol* symbol = checked_.symbols.find_parameter(text.name.text);
          set.index = static_cast<int>(symbol - checked_.symbols.parameters.data());
          set.value = value(text.value);
          break;
        }
        case SetKind::output: {
          set.index = *checked_.symbols.find_output(text.name.text);
          const bool is_number =
              checked_.symbols.outputs[static_cast<std::size_t>(set.index)].output.is_number;
          set.value =
              is_number ? value(text.value) : Value{.constant = truth_of(text.value) == true ? 1.0 : 0.0};
          break;
        }
      }
      sets.push_back(set);
    }
    return sets;
  }

  Exit lower_exit(const ExitText& text, const Condition& condition) {
    Exit exit;
    exit.when = condition;
    if (text.dwell) exit.dwell = value(*text.dwell);
    if (text.release) exit.release = value(*text.release);
    exit.target = target(text.target);
    exit.set = lower_sets(text.set);
    exit.note = text.note;
    exit.span = text.span;
    return exit;
  }

  Task lower_task(const TaskText& text, const std::vector<Condition>& conditions) {
    Task task;
    task.name = text.name.text;
    task.about = text.about;
    task.span = text.name.span;
    if (text.blend) task.blend = value(*text.blend);
    task.set_on_entry = lower_sets(text.set_on_entry);
    for (const GroupText& group : text.groups) task.groups.push_back(lower_group(group, 1));
    for (std::size_t i = 0; i < text.exits.size(); ++i) {
      task.exits.push_back(lower_exit(text.exits[i], conditions[i]));
    }
    if (text.attempts) {
      task.attempts = Attempts{text.attempts->most, target(text.attempts->target), text.attempts->note,
                               text.attempts->span};
    }
    if (text.timeout && !text.timeout->is_never) {
      task.timeout = Timeout{value(text.timeout->after), target(text.timeout->target), text.timeout->note,
                             text.timeout->span};
    }
    return task;
  }

  CheckedFile checked_;
};

}  // namespace

Program lower(CheckedFile checked) {
  return Lowering(std::move(checked)).lower();
}

}  // namespace zwang::lang
