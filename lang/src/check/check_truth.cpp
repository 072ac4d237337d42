// Conditions that are decided before the run, and thresholds with two sides.
#include <algorithm>
#include <limits>
#include <numbers>

#include "check/context.hpp"
#include "check/parameter_values.hpp"
#include "diagnostic/wordings.hpp"
#include "zwang/lang/condition_function.hpp"

namespace zwang::lang {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The values that a node can have: numbers in [low, high]. Of a truth value: 0, 1 or both.
struct Interval {
  double low = -infinity;
  double high = infinity;
};

constexpr Interval undecided{0.0, 1.0};
constexpr Interval never{0.0, 0.0};
constexpr Interval always{1.0, 1.0};

Interval less(const Interval& a, const Interval& b, bool or_equal) {
  if (or_equal ? a.high <= b.low : a.high < b.low) return always;
  if (or_equal ? a.low > b.high : a.low >= b.high) return never;
  return undecided;
}

Interval product(const Interval& a, const Interval& b) {
  const bool is_point = a.low == a.high && b.low == b.high;
  if (is_point) return {a.low * b.low, a.low * b.low};
  return a.low >= 0.0 && b.low >= 0.0 ? Interval{0.0, infinity} : Interval{};
}

/// A parameter may be set to anything in its range.
Interval parameter_interval(const CheckContext& context, int index) {
  const Parameter& parameter = context.symbols.parameters[static_cast<std::size_t>(index)].parameter;
  if (parameter.range) return {parameter.range->low, parameter.range->high};
  return {};
}

Interval feature_interval(const Feature& feature, bool knows_half_turns) {
  if (feature.kind == FeatureKind::direction) return {};
  if (feature.kind == FeatureKind::bearing)
    return knows_half_turns ? Interval{-std::numbers::pi, std::numbers::pi} : Interval{};
  return {0.0, feature.kind == FeatureKind::distance ? infinity : std::numbers::pi};
}

/// A norm is never negative.
Interval part_interval(const ExpressionNode& wrench) {
  return wrench.axis == static_cast<int>(WrenchPart::plane) ? Interval{0.0, infinity} : Interval{};
}

/// The context in which a condition is judged.
struct TruthOf {
  const CheckContext& context;
  const std::vector<GroupText>& groups;  ///< of the task that it stands in
  bool knows_half_turns = true;          ///< that angles start anew at 180 deg
};

/// The position along a rotation starts anew at half a turn.
Interval coordinate_interval(const TruthOf& truth, const ExpressionNode& node) {
  if (node.what == CoordinateQuantity::saturated) return undecided;
  const auto& groups = node.in_always ? truth.context.file.always_groups : truth.groups;
  const auto index = static_cast<std::size_t>(node.index);
  if (node.what != CoordinateQuantity::position || node.axis < 0 || index >= groups.size()) return {};
  const GroupText& group = groups[index];
  const bool turns = group.kind == GroupKind::axes &&
                     group.axes[static_cast<std::size_t>(node.axis)].name.text.starts_with("r");
  return turns && truth.knows_half_turns ? Interval{-std::numbers::pi, std::numbers::pi} : Interval{};
}

Interval interval_of(const TruthOf& truth, const ExpressionNode& node, const Interval& a, const Interval& b) {
  const CheckContext& context = truth.context;
  switch (node.op) {
    case Op::constant:
      return {node.number, node.number};
    case Op::parameter:
      return parameter_interval(context, node.index);
    case Op::elapsed:
      return {0.0, infinity};
    case Op::of_frame:
    case Op::of_task:
      return {function_of(node).values.low, function_of(node).values.high};
    case Op::coordinate:
      return coordinate_interval(truth, node);
    case Op::signal:
      if (node.axis >= 0) return part_interval(node);
      return context.symbols.signals[static_cast<std::size_t>(node.index)].signal.type == SignalType::boolean
                 ? undecided
                 : Interval{};
    case Op::output:
      return context.symbols.outputs[static_cast<std::size_t>(node.index)].output.is_number ? Interval{}
                                                                                            : undecided;
    case Op::estimated_force:
      return {};
    case Op::estimated_wrench:
      return part_interval(node);
    case Op::valid:
      return undecided;
    case Op::feature:
      return feature_interval(context.symbols.features[static_cast<std::size_t>(node.index)].feature,
                              truth.knows_half_turns);
    case Op::abs:
      return {a.low > 0.0 ? a.low : a.high < 0.0 ? -a.high : 0.0, std::max(-a.low, a.high)};
    case Op::negate:
      return {-a.high, -a.low};
    case Op::add:
      return {a.low + b.low, a.high + b.high};
    case Op::subtract:
      return {a.low - b.high, a.high - b.low};
    case Op::multiply:
      return product(a, b);
    case Op::divide:
      return {};
    case Op::less:
      return less(a, b, false);
    case Op::less_equal:
      return less(a, b, true);
    case Op::greater:
      return less(b, a, false);
    case Op::greater_equal:
      return less(b, a, true);
    case Op::logical_and:
      return {std::min(a.low, b.low), std::min(a.high, b.high)};
    case Op::logical_or:
      return {std::max(a.low, b.low), std::max(a.high, b.high)};
    case Op::logical_not:
      return {1.0 - a.high, 1.0 - a.low};
  }
  return {};
}

/// The value of a subtree that holds only constants and parameters; nullopt when something is measured.
std::optional<double> fixed_value(const CheckContext& context, const Condition& condition, int index) {
  const ExpressionNode& node = condition.nodes[static_cast<std::size_t>(index)];
  if (node.op == Op::constant) return node.number;
  if (node.op == Op::parameter) {
    return context.symbols.parameters[static_cast<std::size_t>(node.index)].parameter.value;
  }
  if (node.op != Op::negate) return std::nullopt;
  const std::optional<double> value = fixed_value(context, condition, node.left);
  if (!value) return std::nullopt;
  return -*value;
}

/// The same, with its parameter.
ValueText fixed_text(const CheckContext& context, const Condition& condition, int index) {
  const ExpressionNode& node = condition.nodes[static_cast<std::size_t>(index)];
  if (node.op == Op::negate) {
    ValueText text = fixed_text(context, condition, node.left);
    text.sign = -text.sign;
    text.quantity.value = -text.quantity.value;
    return text;
  }
  ValueText text;
  text.span = condition.span;
  text.kind = node.op == Op::parameter ? ValueKind::parameter : ValueKind::quantity;
  text.quantity.value = node.number;
  if (node.op == Op::parameter)
    text.name = context.symbols.parameters[static_cast<std::size_t>(node.index)].parameter.name;
  return text;
}

}  // namespace

namespace {

Interval root_of(const TruthOf& truth, const Condition& condition) {
  std::vector<Interval> intervals;
  for (const ExpressionNode& node : condition.nodes) {
    const Interval none;
    const Interval& a = node.left >= 0 ? intervals[static_cast<std::size_t>(node.left)] : none;
    const Interval& b = node.right >= 0 ? intervals[static_cast<std::size_t>(node.right)] : none;
    const Interval result = interval_of(truth, node, a, b);
    intervals.push_back(result);
  }
  return intervals.empty() ? Interval{} : intervals.back();
}

}  // namespace

bool is_decided(const CheckContext& context, const Condition& condition,
                const std::vector<GroupText>& groups) {
  const Interval root = root_of({context, groups}, condition);
  return root.low == root.high;
}

void check_is_open(CheckContext& context, const Condition& condition, const std::vector<GroupText>& groups) {
  const Interval root = root_of({context, groups}, condition);
  if (root.low != root.high) return;
  const Interval without = root_of({context, groups, false}, condition);
  context.diagnostics.add(
      wording::decided_condition(condition.span, root.low > 0.5, without.low != without.high));
}

void check_release(CheckContext& context, const ExitText& exit, const Condition& condition,
                   const Dimension& compared) {
  const ExpressionNode& root = condition.nodes.back();
  const Span span = exit.release->span;
  const bool compares = is_comparison(root.op);
  const std::optional<double> threshold =
      compares ? fixed_value(context, condition, root.right) : std::nullopt;
  if (!threshold) {
    context.diagnostics.add(wording::release_without_threshold(span));
    return;
  }
  if (!check_value(context, *exit.release, compared, "`release`")) return;
  const double release = present_value(context, *exit.release);
  const bool is_below = root.op == Op::less || root.op == Op::less_equal;
  if (is_below ? release < *threshold : release > *threshold) {
    context.diagnostics.add(wording::release_on_wrong_side(span, is_below));
    return;
  }
  const ValueText compared_with = fixed_text(context, condition, root.right);
  const std::string rule = "`release` must lie behind the threshold";
  if (is_below) {
    require_order(context, compared_with, *exit.release, rule);
  } else {
    require_order(context, *exit.release, compared_with, rule);
  }
}

}  // namespace zwang::lang
