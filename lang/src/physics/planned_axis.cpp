#include "physics/planned_axis.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zwang::lang {

namespace {

using solver::Quantity;

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

std::optional<double> farthest_value(const CheckContext& context, const ValueText& value,
                                     const Dimension& expected) {
  const ParameterSymbol* symbol = good_parameter(context, value, expected);
  if (symbol == nullptr || !symbol->parameter.range) return known(context, value, expected);
  const solver::Range& range = *symbol->parameter.range;
  return value.sign * (std::abs(range.low) > std::abs(range.high) ? range.low : range.high);
}

/// False when the axis has a driver that cannot be read: nothing is known of it then.
bool read_statements(const CheckContext& context, const AxisText& text, PlannedAxis& axis) {
  for (const Quantity quantity : quantities_of_axis) {
    const std::optional<StatementText>& statement = text[quantity];
    if (!statement) continue;
    const auto index = static_cast<std::size_t>(quantity);
    const Dimension expected = dimension_of(axis.turns() ? solver::Axis::rz : solver::Axis::x, quantity);
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
    axis.farthest_target = farthest_value(context, statement->value, expected);
    const bool is_open = statement->value.kind == ValueKind::here || statement->value.kind == ValueKind::name;
    if (!axis.target && !is_open) return false;
  }
  if (!text.yield) return true;
  if (axis.driver) return false;
  axis.driver = Quantity::acceleration;
  axis.is_yield = true;
  axis.spans[static_cast<std::size_t>(Quantity::acceleration)] = text.yield_span;
  return !text.yield->is_bad;
}

void stand_between(PlannedAxis& axis, const Place& move, const Place& in) {
  axis.move = move.frame;
  axis.in = in.frame;
  axis.in_world = axis.in.body < 0;
  axis.is_placed = move.is_known && in.is_known;
  axis.is_set = move.is_set || in.is_set;
}

/// Of an axis of a group: false when its frames or its name cannot be read.
bool measure_axis(const CheckContext& context, const GroupText& group, const AxisText& text,
                  PlannedAxis& axis) {
  const std::optional<int> move = good_frame(context.symbols, group.move);
  const std::optional<int> in = good_frame(context.symbols, group.in);
  const std::optional<solver::Axis> named = axis_named(text.name.text);
  if (!move || !in || !named) return false;
  axis.move_name = group.move.text;
  axis.in_name = group.in.text;
  axis.axis = *named;
  axis.is_on_path = context.symbols.frames[static_cast<std::size_t>(*in)].path >= 0;
  // E420: a path has no other axes.
  if (axis.is_on_path && (*named == solver::Axis::rx || *named == solver::Axis::ry)) return false;
  stand_between(axis, place_of(context, *move), place_of(context, *in));
  return true;
}

/// A distance or an angle between two frames is the same in both directions. The frame on the robot becomes
/// the moving one.
bool measure_feature(const CheckContext& context, std::optional<int> index, PlannedAxis& axis) {
  if (!index || context.symbols.features[static_cast<std::size_t>(*index)].is_bad) return false;
  const Feature& feature = context.symbols.features[static_cast<std::size_t>(*index)].feature;
  Place move = place_of(context, feature.first);
  Place in = place_of(context, feature.second);
  if (feature.kind == FeatureKind::bearing) {
    axis.axis = solver::Axis::rz;
    axis.measure = solver::Measure::bearing;
  } else if (feature.kind == FeatureKind::direction) {
    axis.axis = feature.turns ? solver::Axis::rz : solver::Axis::x;
    axis.measure = solver::Measure::direction;
    axis.coefficients = feature.direction;
  } else {
    const bool is_turned = move.frame.body < 0;
    if (is_turned) std::swap(move, in);
    axis.measure = feature.kind == FeatureKind::angle ? solver::Measure::angle : solver::Measure::distance;
    if (feature.kind == FeatureKind::angle) {
      axis.axis = is_turned ? feature.second_axis : feature.first_axis;
      axis.other_axis = is_turned ? feature.first_axis : feature.second_axis;
    }
  }
  const bool points_nowhere =
      feature.kind == FeatureKind::direction && feature.direction == std::array<double, 6>{};        // E411
  const bool is_rigid = feature.kind != FeatureKind::direction && move.frame.body == in.frame.body;  // E412
  if (points_nowhere || is_rigid) return false;
  axis.move_name = feature.name;
  stand_between(axis, move, in);
  return true;
}

std::optional<PlannedAxis> plan_axis(const CheckContext& context, const GroupText& group,
                                     const AxisText& text, bool in_always) {
  const bool is_feature = group.kind == GroupKind::feature;
  PlannedAxis axis;
  // The part that could not be read may decide the answer, so the model is not asked.
  if (group.is_incomplete) return std::nullopt;
  const bool is_measured =
      is_feature ? measure_feature(context, context.symbols.find_feature(group.feature.text), axis)
                 : measure_axis(context, group, text, axis);
  if (!is_measured) return std::nullopt;
  axis.path = (in_always ? "always." : "") + group.name.text + (is_feature ? "" : "." + text.name.text);
  axis.text = &text;
  if (!in_always) axis.group = group.name.text;
  if (text.is_free) return axis;
  if (axis.move.body < 0 || !read_statements(context, text, axis)) return std::nullopt;
  // A position in axes that ride along: E405 says so.
  const bool rides_along = !is_feature && axis.in.body >= 0 && axis.in.body == axis.move.body;
  if (rides_along && axis.driver == solver::Quantity::position && axis.target) return std::nullopt;
  const std::optional<ValueText>& tau = text.time_constant ? text.time_constant : group.time_constant;
  if (tau) axis.time_constant = known(context, *tau, dimension::time).value_or(0.0);
  axis.time_constant_span = tau ? tau->span : text.name.span;
  axis.level = text.level.value_or(group.level.value_or(in_always ? 0 : 1));
  axis.is_soft = text.weight || group.weight;
  const bool turns = axis.turns();
  axis.is_spring = !axis.is_yield && (text.stiffness || text.damping);
  if (text.build_up) {
    axis.build_up = known(context, *text.build_up, dimension::time);
    axis.build_up_span = text.build_up->span;
  }
  if (axis.is_yield && text.mass && text.damping) {
    axis.yield_mass = known(context, *text.mass, turns ? dimension::inertia : dimension::mass);
    axis.yield_mass_span = text.mass->span;
    axis.damping = known(context, *text.damping, turns ? dimension::angular_damping : dimension::damping);
  }
  if (axis.is_yield && text.dead_band) {
    axis.dead_band = known(context, *text.dead_band, turns ? dimension::torque : dimension::force);
    axis.dead_band_span = text.dead_band->span;
  }
  if (text.stiffness && text.damping) {
    axis.stiffness =
        known(context, *text.stiffness, turns ? dimension::angular_stiffness : dimension::stiffness);
    axis.damping = known(context, *text.damping, turns ? dimension::angular_damping : dimension::damping);
    axis.stiffness_span = text.stiffness->span;
    axis.damping_span = text.damping->span;
  }
  return axis;
}

void plan_speed(const CheckContext& context, const GroupText& group, const AxisText& text, bool in_always,
                std::vector<PlannedSpeed>& speeds) {
  const std::optional<int> move = good_frame(context.symbols, group.move);
  const std::optional<StatementText>& velocity = text[Quantity::velocity];
  if (!move || !velocity || !velocity->is_range) return;
  const std::optional<double> most = known(context, velocity->high, dimension::velocity);
  const int body = place_of(context, *move).frame.body;
  if (!most || *most < 0.0 || body < 0) return;
  speeds.push_back(
      {(in_always ? "always." : "") + group.name.text + "." + text.name.text, body, *most, velocity->span});
}

void plan_norm(const CheckContext& context, const GroupText& group, const AxisText& text, bool in_always,
               Quantity quantity, std::vector<PlannedNorm>& norms) {
  const std::optional<int> move = good_frame(context.symbols, group.move);
  const std::optional<StatementText>& norm = text[quantity];
  if (!move || !norm || !norm->is_range) return;
  const Dimension measures = quantity == Quantity::force ? dimension::force : dimension::acceleration;
  const std::optional<double> most = known(context, norm->high, measures);
  const Place place = place_of(context, *move);
  if (!most || place.frame.body < 0) return;
  norms.push_back(
      {(in_always ? "always." : "") + group.name.text + ".plane", place.frame, *most, norm->span});
}

/// A norm bounds each of its two axes.
void plan_box(const CheckContext& context, const GroupText& group, const AxisText& text, bool in_always,
              std::vector<PlannedAxis>& axes) {
  for (const solver::Axis along : {solver::Axis::x, solver::Axis::y}) {
    PlannedAxis axis;
    const std::optional<int> move = good_frame(context.symbols, group.move);
    const std::optional<int> in = good_frame(context.symbols, group.in);
    if (!move || !in) return;
    axis.path = (in_always ? "always." : "") + group.name.text + "." + text.name.text;
    axis.text = &text;
    if (!in_always) axis.group = group.name.text;
    axis.move_name = group.move.text;
    axis.in_name = group.in.text;
    axis.axis = along;
    axis.is_norm = true;
    stand_between(axis, place_of(context, *move), place_of(context, *in));
    if (axis.move.body < 0) return;
    for (const Quantity quantity : {Quantity::acceleration, Quantity::force}) {
      const std::optional<StatementText>& range = text[quantity];
      const std::optional<double> most = range && range->is_range
                                             ? known(context, range->high, dimension_of(along, quantity))
                                             : std::nullopt;
      if (!most || *most < 0.0) continue;
      axis.spans[static_cast<std::size_t>(quantity)] = range->span;
      axis.ranges[static_cast<std::size_t>(quantity)] = solver::Range{-*most, *most};
    }
    axis.level = text.level.value_or(group.level.value_or(in_always ? 0 : 1));
    if (axis[Quantity::acceleration] || axis[Quantity::force]) axes.push_back(std::move(axis));
  }
}

void plan_groups(const CheckContext& context, const std::vector<GroupText>& groups, bool in_always,
                 PlannedTask& plan) {
  for (const GroupText& group : groups) {
    if (group.kind == GroupKind::inside) continue;
    for (const AxisText& text : group.axes) {
      if (text.is_norm() && group.kind == GroupKind::axes) {
        plan_speed(context, group, text, in_always, plan.speeds);
        plan_norm(context, group, text, in_always, Quantity::acceleration, plan.norms);
        plan_norm(context, group, text, in_always, Quantity::force, plan.force_norms);
        plan_box(context, group, text, in_always, plan.axes);
        continue;
      }
      std::optional<PlannedAxis> axis = plan_axis(context, group, text, in_always);
      if (axis) (text.is_free ? plan.free : plan.axes).push_back(std::move(*axis));
    }
  }
}

bool is_base(const solver::AttachedFrame& frame) {
  return frame.body == 0 && frame.pose.position.isZero() && frame.pose.rotation.isIdentity();
}

/// In force where `always` and the task give none on the base's own axis. A range does not count that a
/// driver may break: one on a later level, or with a weight.
void add_robot_limits(const CheckContext& context, std::vector<PlannedAxis>& axes) {
  const std::size_t given = axes.size();
  int driven = std::numeric_limits<int>::max();
  for (const PlannedAxis& axis : axes) {
    if (axis.driver) driven = std::min(driven, axis.level);
  }
  for (const BaseLimit& limit : context.robot->limits) {
    const auto index = static_cast<std::size_t>(limit.quantity);
    const bool is_given = std::any_of(axes.begin(), axes.begin() + static_cast<std::ptrdiff_t>(given),
                                      [&](const PlannedAxis& axis) {
                                        const bool holds = !axis.is_soft && axis.level <= driven;
                                        return holds && is_base(axis.move) && is_base(axis.in) &&
                                               axis.axis == limit.axis && axis.ranges[index];
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

/// The range on the base's own axis that is left of all that are in force.
std::optional<solver::Range> base_range(const std::vector<PlannedAxis>& axes, solver::Axis which) {
  std::optional<solver::Range> left;
  for (const PlannedAxis& axis : axes) {
    const std::optional<solver::Range>& range = axis[Quantity::acceleration];
    const bool is_it =
        range && !axis.is_feature() && axis.axis == which && is_base(axis.move) && is_base(axis.in);
    if (!is_it) continue;
    if (!left) left = range;
    left->low = std::max(left->low, range->low);
    left->high = std::min(left->high, range->high);
  }
  return left;
}

/// Between two bounds the acceleration allowed along a direction e is least_i a_i / |e_i|. It is largest at
/// the corners of the box of ranges, where the bound passes from one axis to the other.
void find_corners(std::vector<PlannedAxis>& axes) {
  const std::optional<solver::Range> x = base_range(axes, solver::Axis::x);
  const std::optional<solver::Range> y = base_range(axes, solver::Axis::y);
  if (!x || !y) return;
  for (PlannedAxis& axis : axes) {
    if (!axis.is_open()) continue;
    for (const double ax : {x->low, x->high}) {
      for (const double ay : {y->low, y->high}) axis.corners[axis.corner_count++] = std::atan2(ay, ax);
    }
  }
}

}  // namespace

Place place_of(const CheckContext& context, int index) {
  Place place;
  while (index > 0) {
    const FrameDeclaration& declaration = context.symbols.frames[static_cast<std::size_t>(index)].declaration;
    place.is_set = place.is_set || is_frame_set(context.file, declaration.name);
    place.frame.pose = declaration.pose * place.frame.pose;
    if (declaration.parent == FrameParent::body) place.frame.body = declaration.parent_index;
    if (declaration.parent == FrameParent::signal) place.is_known = false;
    index = declaration.parent == FrameParent::frame ? declaration.parent_index : 0;
  }
  return place;
}

double PlannedTask::speed_limit(const PlannedAxis& axis) const {
  const std::optional<solver::Range>& range = axis[solver::Quantity::velocity];
  double most = range ? std::max(range->high, -range->low) : solver::infinity;
  if (axis.turns()) return most;
  for (const PlannedSpeed& speed : speeds) {
    if (speed.body == axis.move.body) most = std::min(most, speed.most);
  }
  return most;
}

std::optional<PlannedAxis> plan_feature(const CheckContext& context, int index) {
  PlannedAxis axis;
  return measure_feature(context, index, axis) ? std::optional(axis) : std::nullopt;
}

PlannedTask plan_always(const CheckContext& context) {
  PlannedTask plan;
  plan_groups(context, context.file.always_groups, true, plan);
  return plan;
}

PlannedTask plan_task(const CheckContext& context, const TaskText& task) {
  PlannedTask plan = plan_always(context);
  plan.task = &task;
  plan_groups(context, task.groups, false, plan);
  add_robot_limits(context, plan.axes);
  find_corners(plan.axes);
  return plan;
}

}  // namespace zwang::lang
