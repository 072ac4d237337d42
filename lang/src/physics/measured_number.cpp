#include "physics/measured_number.hpp"

#include <algorithm>

#include "check/context.hpp"
#include "zwang/lang/condition_function.hpp"

namespace zwang::lang {

const GroupText& group_measured(const CheckContext& context, const PlannedTask& plan,
                                const ExpressionNode& node) {
  const auto& all = node.in_always ? context.file.always_groups : plan.task->groups;
  return all[static_cast<std::size_t>(node.index)];
}

const PlannedAxis* axis_measured(const CheckContext& context, const PlannedTask& plan,
                                 const ExpressionNode& node) {
  const AxisText* text = &group_measured(context, plan, node).axes[static_cast<std::size_t>(node.axis)];
  const auto at = std::find_if(plan.axes.begin(), plan.axes.end(),
                               [&](const PlannedAxis& axis) { return axis.text == text; });
  return at != plan.axes.end() ? &*at : nullptr;
}

std::string name_measured(const CheckContext& context, const PlannedTask& plan, const ExpressionNode& node) {
  switch (node.op) {
    case Op::of_task:
      return std::string(function_of(node).name) + "(" +
             context.symbols.tasks[static_cast<std::size_t>(node.index)] + ")";
    case Op::of_frame:
      return std::string(function_of(node).name) + "(" +
             context.symbols.frames[static_cast<std::size_t>(node.index)].declaration.name + ")";
    case Op::feature:
      return context.symbols.features[static_cast<std::size_t>(node.index)].feature.name;
    case Op::coordinate:
      break;
    case Op::output:
      return context.symbols.outputs[static_cast<std::size_t>(node.index)].output.name;
    case Op::signal:
      return context.symbols.signals[static_cast<std::size_t>(node.index)].signal.name;
    default:
      return "elapsed";
  }
  const GroupText& group = group_measured(context, plan, node);
  const bool is_feature = group.kind == GroupKind::feature;
  const char* word = node.what == CoordinateQuantity::position   ? ".position"
                     : node.what == CoordinateQuantity::velocity ? ".velocity"
                                                                 : ".force";
  return group.name.text +
         (is_feature ? "" : "." + group.axes[static_cast<std::size_t>(node.axis)].name.text) + word;
}

std::string unit_measured(const CheckContext& context, const PlannedTask& plan, const ExpressionNode& node) {
  if (node.op == Op::elapsed) return "s";
  if (node.op == Op::of_frame || node.op == Op::of_task) {
    const auto& powers = function_of(node).powers;
    return usual_unit({powers[0], powers[1], powers[2], powers[3]});
  }
  if (node.op == Op::feature)
    return context.symbols.features[static_cast<std::size_t>(node.index)].feature.turns ? "rad" : "m";
  if (node.op == Op::output) return "";
  if (node.op == Op::signal) {
    const SignalSymbol& signal = context.symbols.signals[static_cast<std::size_t>(node.index)];
    return signal.signal.type == SignalType::number ? usual_unit(signal.dimension) : "";
  }
  const PlannedAxis* axis = axis_measured(context, plan, node);
  const auto which = axis != nullptr && axis->turns() ? solver::Axis::rz : solver::Axis::x;
  const solver::Quantity quantity = node.what == CoordinateQuantity::position   ? solver::Quantity::position
                                    : node.what == CoordinateQuantity::velocity ? solver::Quantity::velocity
                                                                                : solver::Quantity::force;
  return usual_unit(dimension_of(which, quantity));
}

}  // namespace zwang::lang
