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
    }
    for (const FrameSymbol& symbol : checked_.symbols.frames) program.frames.push_back(symbol.declaration);
    for (std::size_t i = 0; i < checked_.file.tasks.size(); ++i) {
      program.tasks.push_back(lower_task(checked_.file.tasks[i], checked_.conditions[i]));
    }
    program.start = *checked_.symbols.find_task(checked_.file.start.text);
    program.robot = std::move(checked_.robot);
    program.scene = std::move(checked_.scene);
    return program;
  }

 private:
  Value value(const ValueText& text) {
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

  AxisStatements lower_axis(const AxisText& text, const GroupText& group) {
    AxisStatements axis;
    axis.name = group.name.text + "." + text.name.text;
    axis.axis = *axis_named(text.name.text);
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
    axis.level = text.level.value_or(group.level.value_or(1));
    return axis;
  }

  Group lower_group(const GroupText& text) {
    Group group;
    group.name = text.name.text;
    group.move = *checked_.symbols.find_frame(text.move.text);
    group.in = *checked_.symbols.find_frame(text.in.text);
    group.span = text.name.span;
    for (const AxisText& axis : text.axes) group.axes.push_back(lower_axis(axis, text));
    return group;
  }

  std::vector<SetAction> lower_sets(const std::vector<SetText>& texts) {
    std::vector<SetAction> sets;
    for (const SetText& text : texts) {
      SetAction set;
      set.span = text.span;
      set.sets_frame = text.kind == SetKind::frame;
      if (set.sets_frame) {
        set.index = *checked_.symbols.find_frame(text.name.text);
        set.source = *checked_.symbols.find_frame(text.source.text);
      } else {
        const ParameterSymbol* symbol = checked_.symbols.find_parameter(text.name.text);
        set.index = static_cast<int>(symbol - checked_.symbols.parameters.data());
        set.value = value(text.value);
      }
      sets.push_back(set);
    }
    return sets;
  }

  Exit lower_exit(const ExitText& text, const Condition& condition) {
    Exit exit;
    exit.when = condition;
    if (text.dwell) exit.dwell = value(*text.dwell);
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
    for (const GroupText& group : text.groups) task.groups.push_back(lower_group(group));
    for (std::size_t i = 0; i < text.exits.size(); ++i) {
      task.exits.push_back(lower_exit(text.exits[i], conditions[i]));
    }
    if (text.timeout && !text.timeout->is_never) {
      task.timeout = Timeout{value(text.timeout->after), target(text.timeout->target), text.timeout->span};
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
