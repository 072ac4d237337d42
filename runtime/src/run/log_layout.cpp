#include "run/log_layout.hpp"

#include "run/log_columns.hpp"

namespace zwang::runtime {

namespace {

template <typename Enum>
std::vector<std::string> words_up_to(Enum last) {
  std::vector<std::string> words;
  for (int i = 0; i <= static_cast<int>(last); ++i) words.emplace_back(to_string(static_cast<Enum>(i)));
  return words;
}

std::vector<std::string> task_names(const Scheduler& scheduler) {
  std::vector<std::string> names;
  for (const lang::Task& t : scheduler.tasks()) names.push_back(t.name);
  return names;
}

}  // namespace

LogLayout::LogLayout(const StatementTable& statements, const Scheduler& scheduler, const solver::Model& model,
                     const lang::Program& program, const std::vector<std::string>& event_signals,
                     const std::vector<Column>& extra)
    : inputs_(model, program.signals, program.parameters, program.robot.drive) {
  add_first(statements, scheduler, event_signals);
  add_joints(model, program.robot.drive);
  for (const lang::Signal& signal : program.signals) add_signal(signal);
  first_output_ = static_cast<int>(columns_.size());
  for (const lang::Output& output : program.outputs) {
    add("output." + output.name, "");
    columns_.back().span = output.span;
  }
  for (const Statement& s : statements.all()) add_statement(s);
  for (const lang::Task& t : scheduler.tasks()) {
    guards_.emplace_back();
    for (std::size_t i = 0; i < t.exits.size(); ++i) {
      guards_.back().push_back(add(t.name + ".exit" + std::to_string(i + 1) + ".true_for", "s"));
      columns_.back().span = t.exits[i].span;
    }
  }
  first_input_ = static_cast<int>(columns_.size());
  columns_.insert(columns_.end(), inputs_.columns().begin(), inputs_.columns().end());
  first_extra_ = static_cast<int>(columns_.size());
  columns_.insert(columns_.end(), extra.begin(), extra.end());
  values_.resize(columns_.size(), log_column::blank);
}

void LogLayout::add_first(const StatementTable& statements, const Scheduler& scheduler,
                          const std::vector<std::string>& event_signals) {
  // In the order of `log_column::First`.
  add("time", "s");
  add("task", "", task_names(scheduler));
  add("guard", "", words_up_to(GuardStatus::stopped));
  add("solver", "", words_up_to(solver::Status::degenerate_model));
  add("solver.iterations", "");
  add("base.x", "m");
  add("base.y", "m");
  add("base.yaw", "rad");
  add("base.vx", "m/s");
  add("base.vy", "m/s");
  add("base.wz", "rad/s");
  add("switch", "", words_up_to(Cause::never_stood));
  add("switch.exit", "");
  add("switch.also_true.always", "");  // bit i: exit i + 1
  add("switch.also_true", "");         // likewise; the timeout is the bit above the last exit
  add("switch.refusal", "", words_up_to(Refusal::set));
  std::vector<std::string> rows;
  for (const Statement& s : statements.all()) rows.push_back(s.name);
  add("missed", "", rows);
  add("missed.by", "");
  for (const char* name : {"missed.held_back_by", "missed.held_back_by.2", "missed.held_back_by.3",
                           "missed.held_back_by.4"}) {  // the strongest first
    add(name, "", rows);
  }
  add("event", "", words_up_to(last_event_code));
  add("event.signal", "", event_signals);
  add("event.value", "");
  add("estimated.force.x", "N");
  add("estimated.force.y", "N");
  add("estimated.force.rz", "N m");
  add("slip", "m/s");
}

void LogLayout::add_joints(const solver::Model& model, const lang::Drive& drive) {
  first_joint_ = static_cast<int>(columns_.size());
  for (int j = 0; j < model.joint_count(); ++j) {
    const solver::Joint& joint = model.joint(j);
    const bool slides = joint.type == solver::JointType::prismatic;
    add(joint.name + ".q", slides ? "m" : "rad");
    add(joint.name + ".qd", slides ? "m/s" : "rad/s");
    add(joint.name + ".tau", slides ? "N" : "N m");
  }
  if (drive.takes_velocity) {
    first_command_ = static_cast<int>(columns_.size());
    for (int j = 0; j < model.joint_count(); ++j) {
      for (const CommandColumn& column : command_columns(model.joint(j))) add(column.name, column.unit);
    }
  }
  if (drive.takes_twist) {
    first_twist_ = static_cast<int>(columns_.size());
    for (const auto& [name, unit] : twist_columns) add(name, unit);
  }
}

void LogLayout::add_signal(const lang::Signal& signal) {
  const std::size_t first = columns_.size();
  const std::string name = "signal." + signal.name;
  SignalColumns c;
  c.type = signal.type;
  switch (signal.type) {
    case lang::SignalType::boolean:
    case lang::SignalType::number:  // in SI; a length and a force have no unit in the program any more
      c.value = add(name, "");
      break;
    case lang::SignalType::pose:
      c.value = add(name + ".x", "m");
      add(name + ".y", "m");
      add(name + ".yaw", "rad");
      break;
    case lang::SignalType::wrench:
      c.value = add(name + ".fx", "N");
      add(name + ".fy", "N");
      add(name + ".fz", "N");
      add(name + ".mx", "N m");
      add(name + ".my", "N m");
      add(name + ".mz", "N m");
      break;
  }
  c.age = add(name + ".age", "s");
  c.known = add(name + ".valid", "");
  for (std::size_t i = first; i < columns_.size(); ++i) columns_[i].span = signal.span;
  of_signal_.push_back(c);
}

void LogLayout::add_statement(const Statement& s) {
  using solver::Quantity;
  const auto unit = [&](Quantity quantity) { return std::string(unit_of(s.says.axis, quantity)); };
  StatementColumns c;
  const std::size_t first = columns_.size();
  const bool ranges = s.says.position || s.says.velocity || s.says.acceleration;
  c.inside = s.inside;
  if (s.says.driver || s.says.force || ranges) {
    c.position = add(s.name + (s.inside ? ".left" : ".position"), unit(Quantity::position));
    c.velocity = add(s.name + ".velocity", unit(Quantity::velocity));
    if (s.says.acceleration) c.acceleration = add(s.name + ".acceleration", unit(Quantity::acceleration));
    c.alpha = add(s.name + ".alpha", "");
  }
  if (s.says.driver) {
    const bool pushes = s.says.driver == Quantity::force || s.says.stiffness || s.says.damping;
    c.b =
        pushes ? add(s.name + ".f", unit(Quantity::force)) : add(s.name + ".b", unit(Quantity::acceleration));
    c.nu = add(s.name + ".nu", unit(Quantity::force));
    c.residual = add(s.name + ".residual", unit(Quantity::acceleration));
    c.saturated = add(s.name + ".saturated", "");
  }
  if (ranges) {
    c.limit_nu = add(s.name + ".limit_nu", unit(Quantity::force));
    c.limit_residual = add(s.name + ".limit_residual", unit(Quantity::acceleration));
  }
  if (s.says.force && !s.says.driver) c.sum = add(s.name + ".sum", unit(Quantity::force));
  for (std::size_t i = first; i < columns_.size(); ++i) columns_[i].span = s.says.span;
  of_statement_.push_back(c);
}

int LogLayout::add(std::string name, std::string unit, std::vector<std::string> words) {
  columns_.push_back({std::move(name), std::move(unit), std::move(words)});
  return static_cast<int>(columns_.size()) - 1;
}

}  // namespace zwang::runtime
