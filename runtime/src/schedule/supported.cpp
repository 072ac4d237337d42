#include "schedule/supported.hpp"

#include <stdexcept>

namespace zwang::runtime {

namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& where) {
  throw std::invalid_argument(where + ": " + what + " can be checked, but not run yet");
}

void require_value(const lang::Value& value, const std::string& where) {
  if (value.signal >= 0) refuse("a value from a signal", where);
}

void require_range(const std::optional<lang::ValueRange>& range, const std::string& where) {
  if (!range) return;
  require_value(range->low, where);
  require_value(range->high, where);
}

void require_axis(const lang::AxisStatements& axis, const std::string& task) {
  const std::string where = task + "." + axis.name;
  if (axis.stiffness || axis.damping) refuse("stiffness and damping", where);
  if (axis.weight) refuse("a weight", where);
  if (axis.is_planar_speed) refuse("a limit of the planar speed", where);
  const bool motion_driver = axis.driver && axis.driver != solver::Quantity::force;
  if (axis.force && !motion_driver) refuse("a force range without a motion driver beside it", where);
  require_value(axis.target, where);
  require_value(axis.time_constant, where);
  for (const auto* range : {&axis.position, &axis.velocity, &axis.acceleration, &axis.force}) {
    require_range(*range, where);
  }
}

void require_condition(const lang::Condition& condition, const std::string& where) {
  for (const lang::ExpressionNode& node : condition.nodes) {
    if (node.op == lang::Op::signal || node.op == lang::Op::valid) refuse("a condition on a signal", where);
    if (node.op == lang::Op::feature) refuse("a condition on a feature", where);
    if (node.in_always) refuse("a condition on a group of `always`", where);
  }
}

void require_task(const lang::Task& task) {
  if (task.require) refuse("`require`", task.name);
  if (task.attempts) refuse("`attempts`", task.name);
  for (const lang::Group& group : task.groups) {
    const std::string where = task.name + "." + group.name;
    if (group.kind == lang::GroupKind::inside) refuse("`inside` a region", where);
    if (group.kind == lang::GroupKind::feature) refuse("a constraint on a feature", where);
    for (const lang::AxisStatements& axis : group.axes) require_axis(axis, task.name);
  }
  for (const lang::Exit& exit : task.exits) {
    if (exit.release) refuse("`release`", task.name);
    if (exit.target.kind == lang::TargetKind::back) refuse("`goto: back`", task.name);
    require_condition(exit.when, task.name);
    require_value(exit.dwell, task.name);
  }
  if (task.timeout && task.timeout->target.kind == lang::TargetKind::back) refuse("`goto: back`", task.name);
}

}  // namespace

void require_supported(const lang::Program& program) {
  if (!program.always.groups.empty() || !program.always.exits.empty()) refuse("`always`", program.path);
  for (const lang::FrameDeclaration& frame : program.frames) {
    if (frame.parent == lang::FrameParent::signal) refuse("a frame on a pose signal", frame.name);
  }
  for (const lang::Task& task : program.tasks) require_task(task);
}

}  // namespace zwang::runtime
