#include "schedule/supported.hpp"

#include <stdexcept>

namespace zwang::runtime {

namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& where) {
  throw std::invalid_argument(where + ": " + what + " can be checked, but not run yet");
}

void require_axis(const lang::AxisStatements& axis, const std::string& task) {
  const std::string where = task + "." + axis.name;
  if (axis.stiffness || axis.damping) refuse("stiffness and damping", where);
  if (axis.weight) refuse("a weight", where);
  if (axis.is_planar_speed) refuse("a limit of the planar speed", where);
  const bool motion_driver = axis.driver && axis.driver != solver::Quantity::force;
  if (axis.force && !motion_driver) refuse("a force range without a motion driver beside it", where);
}

void require_condition(const lang::Condition& condition, const std::string& where) {
  for (const lang::ExpressionNode& node : condition.nodes) {
    if (node.op == lang::Op::feature) refuse("a condition on a feature", where);
  }
}

void require_task(const lang::Task& task) {
  if (task.require) require_condition(*task.require, task.name);
  for (const lang::Group& group : task.groups) {
    const std::string where = task.name + "." + group.name;
    if (group.kind == lang::GroupKind::inside) refuse("`inside` a region", where);
    if (group.kind == lang::GroupKind::feature) refuse("a constraint on a feature", where);
    for (const lang::AxisStatements& axis : group.axes) require_axis(axis, task.name);
  }
  for (const lang::Exit& exit : task.exits) {
    require_condition(exit.when, task.name);
  }
}

}  // namespace

void require_supported(const lang::Program& program) {
  lang::Task always;
  always.name = "always";
  always.groups = program.always.groups;
  always.exits = program.always.exits;
  require_task(always);
  for (const lang::Task& task : program.tasks) require_task(task);
}

}  // namespace zwang::runtime
