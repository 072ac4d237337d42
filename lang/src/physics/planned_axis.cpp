#include "physics/planned_axis.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::lang {

namespace {

using solver::Quantity;

constexpr std::array quantities{Quantity::position, Quantity::velocity, Quantity::acceleration,
                                Quantity::force};

/// Where a frame is fixed: the parents stand before it in the table, so the chain ends.
solver::AttachedFrame attached(const Symbols& symbols, int index) {
  solver::AttachedFrame frame{-1, {}};
  while (index > 0) {
    const FrameDeclaration& declaration = symbols.frames[static_cast<std::size_t>(index)].declaration;
    frame.pose = declaration.pose * frame.pose;
    if (declaration.parent == FrameParent::body) frame.body = declaration.parent_index;
    index = declaration.parent == FrameParent::frame ? declaration.parent_index : 0;
  }
  return frame;
}

std::optional<int> good_frame(const Symbols& symbols, const Word& name) {
  const std::optional<int> index = symbols.find_frame(name.text);
  if (!index || symbols.frames[static_cast<std::size_t>(*index)].is_bad) return std::nullopt;
  return index;
}

const ParameterSymbol* good_parameter(const CheckContext& context, const ValueText& value,
                                      const Dimension& expected) {
  if (value.kind != ValueKind::parameter) return nullptr;
  const ParameterSymbol* symbol = context.symbols.find_parameter(value.name);
  if (symbol == nullptr || symbol->is_bad || symbol->dimension != expected) return nullptr;
  const std::optional<solver::Range>& range = symbol->parameter.range;
  const double now = symbol->parameter.value;
  const bool is_outside = range && (now < range->low || now > range->high);  // E204 says so
  return is_outside ? nullptr : symbol;
}

/// The value at the start, where it is one of the expected dimension.
std::optional<double> known(const CheckContext& context, const ValueText& value, const Dimension& expected) {
  if (value.kind == ValueKind::quantity && value.quantity.dimension == expected) return value.quantity.value;
  if (good_parameter(context, value, expected) != nullptr) return present_value(context, value);
  return std::nullopt;
}

std::optional<double> farthest(const CheckContext& context, const ValueText& value,
                               const Dimension& expected) {
  const ParameterSymbol* symbol = good_parameter(context, value, expected);
  if (symbol == nullptr || !symbol->parameter.range) return known(context, value, expected);
  const solver::Range& range = *symbol->parameter.range;
  return value.sign * (std::abs(range.low) > std::abs(range.high) ? range.low : range.high);
}

/// False when the axis has a driver that cannot be read: nothing is known of it then.
bool read_statements(const CheckContext& context, const AxisText& text, PlannedAxis& axis) {
  for (const Quantity quantity : quantities) {
    const std::optional<StatementText>& statement = text[quantity];
    if (!statement) continue;
    const auto index = static_cast<std::size_t>(quantity);
    const Dimension expected = dimension_of(axis.axis, quantity);
    axis.spans[index] = statement->span;
    if (statement->is_range) {
      const std::optional<double> low = known(context, statement->low, expected);
      const std::optional<double> high = known(context, statement->high, expected);
      if (low && high && *low <= *high) axis.ranges[index] = solver::Range{*low, *high};
      continue;
    }
    if (axis.driver) return false;
    axis.driver = quantity;
    axis.target = known(context, statement->value, expected);
    axis.farthest_target = farthest(context, statement->value, expected);
    const bool is_open = statement->value.kind == ValueKind::here || statement->value.kind == ValueKind::name;
    if (!axis.target && !is_open) return false;
  }
  return true;
}

std::optional<PlannedAxis> plan_axis(const CheckContext& context, const GroupText& group,
                                     const AxisText& text, bool in_always) {
  const std::optional<int> move = good_frame(context.symbols, group.move);
  const std::optional<int> in = good_frame(context.symbols, group.in);
  const std::optional<solver::Axis> named = axis_named(text.name.text);
  if (!move || !in || !named || text.is_free) return std::nullopt;
  PlannedAxis axis;
  axis.path = (in_always ? "always." : "") + group.name.text + "." + text.name.text;
  axis.text = &text;
  if (!in_always) axis.group = group.name.text;
  axis.move_name = group.move.text;
  axis.move = attached(context.symbols, *move);
  axis.in = attached(context.symbols, *in);
  axis.in_world = axis.in.body < 0;
  axis.axis = *named;
  if (axis.move.body < 0 || !read_statements(context, text, axis)) return std::nullopt;
  // A position in axes that ride along: E405 says so.
  const bool rides_along = axis.in.body >= 0 && axis.in.body == axis.move.body;
  if (rides_along && axis.driver == solver::Quantity::position && axis.target) return std::nullopt;
  const std::optional<ValueText>& tau = text.time_constant ? text.time_constant : group.time_constant;
  if (tau) axis.time_constant = known(context, *tau, dimension::time).value_or(0.0);
  axis.time_constant_span = tau ? tau->span : text.name.span;
  axis.level = text.level.value_or(group.level.value_or(in_always ? 0 : 1));
  axis.is_soft = text.weight || group.weight;
  axis.is_spring = text.stiffness || text.damping;
  return axis;
}

void plan_groups(const CheckContext& context, const std::vector<GroupText>& groups, bool in_always,
                 std::vector<PlannedAxis>& axes) {
  for (const GroupText& group : groups) {
    if (group.kind != GroupKind::axes) continue;
    for (const AxisText& text : group.axes) {
      std::optional<PlannedAxis> axis = plan_axis(context, group, text, in_always);
      if (axis) axes.push_back(std::move(*axis));
    }
  }
}

bool is_base(const solver::AttachedFrame& frame) {
  return frame.body == 0 && frame.pose.position.isZero() && frame.pose.rotation.isIdentity();
}

/// In force where `always` and the task give none on the base's own axis.
void add_robot_limits(const CheckContext& context, std::vector<PlannedAxis>& axes) {
  const std::size_t given = axes.size();
  for (const BaseLimit& limit : context.robot->limits) {
    const auto index = static_cast<std::size_t>(limit.quantity);
    const bool is_given = std::any_of(
        axes.begin(), axes.begin() + static_cast<std::ptrdiff_t>(given), [&](const PlannedAxis& axis) {
          return is_base(axis.move) && is_base(axis.in) && axis.axis == limit.axis && axis.ranges[index];
        });
    if (is_given) continue;
    PlannedAxis axis;
    axis.path = "the robot file's limit";
    axis.move_name = context.robot->base_frame;
    axis.move = axis.in = {0, {}};
    axis.axis = limit.axis;
    axis.ranges[index] = limit.range;
    axis.spans[index] = limit.span;
    axis.level = 0;
    axes.push_back(std::move(axis));
  }
}

}  // namespace

PlannedTask plan_task(const CheckContext& context, const TaskText& task) {
  PlannedTask plan;
  plan.task = &task;
  plan_groups(context, context.file.always_groups, true, plan.axes);
  plan_groups(context, task.groups, false, plan.axes);
  add_robot_limits(context, plan.axes);
  return plan;
}

}  // namespace zwang::lang
