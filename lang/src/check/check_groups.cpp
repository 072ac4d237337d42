#include <algorithm>
#include <array>
#include <numbers>

#include "check/context.hpp"
#include "check/room.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "diagnostic/wordings_standing.hpp"

namespace zwang::lang {

namespace {

using solver::Axis;
using solver::Quantity;

constexpr std::array quantities{Quantity::position, Quantity::velocity, Quantity::acceleration,
                                Quantity::force};

std::string written(const ValueText& value) {
  if (value.kind == ValueKind::parameter) return (value.sign < 0 ? "-$" : "$") + value.name;
  return value.quantity.number + " " + value.quantity.unit;
}

/// The value at the start, where it can be read and measures what is expected.
std::optional<double> known_value(const CheckContext& context, const ValueText& value,
                                  const Dimension& expected) {
  if (value.kind == ValueKind::quantity && value.quantity.dimension == expected) return value.quantity.value;
  if (value.kind != ValueKind::parameter) return std::nullopt;
  const ParameterSymbol* symbol = context.symbols.find_parameter(value.name);
  if (symbol == nullptr || symbol->is_bad || symbol->dimension != expected) return std::nullopt;
  return present_value(context, value);
}

/// Not below 0.
void check_return_speed(CheckContext& context, const ValueText& value, const Dimension& expected,
                        const std::string& what) {
  if (check_value(context, value, expected, what) && present_value(context, value) < 0.0)
    context.diagnostics.add(wording::not_positive(value.span, what, true));
}

bool has_position_range(const AxisText& text) {
  const std::optional<StatementText>& position = text[Quantity::position];
  return position && position->is_range;
}

/// `return` leads back into a range of positions: the axis must have one.
void check_return(CheckContext& context, const AxisText& text, Axis axis, const std::string& path,
                  const std::optional<ValueText>& return_speed) {
  if (!return_speed) return;
  check_return_speed(context, *return_speed, dimension_of(axis, Quantity::velocity), path + ".return");
  const std::optional<StatementText>& position = text[Quantity::position];
  const bool is_unread = position && !position->is_range && position->value.kind == ValueKind::bad;
  if (!has_position_range(text) && !is_unread)
    context.diagnostics.add(wording::return_without_range(return_speed->span, path));
}

/// One axis of one group.
class AxisCheck {
 public:
  AxisCheck(CheckContext& context, const GroupText& group, const AxisText& text, std::optional<int> move,
            std::optional<int> in)
      : context_(context),
        text_(text),
        path_(group.kind == GroupKind::feature ? group.name.text : group.name.text + "." + text.name.text),
        feature_(feature_of(context, group)),
        axis_(feature_ == nullptr ? axis_named(text.name.text).value_or(Axis::x)
                                  : (feature_->turns ? Axis::rz : Axis::x)),
        move_(move),
        in_(in),
        is_incomplete_(group.is_incomplete) {}

  void check() {
    for (const Quantity quantity : quantities) check_statement(quantity);
    check_single_driver();
    check_place_on_feature();
    check_force_range();
    if (text_.time_constant) check_time(context_, *text_.time_constant, path_ + ".time_constant", false);
    check_compliance();
    check_norms();
    if (text_.weight) check_positive(*text_.weight, turns() ? dimension::inertia : dimension::mass, "weight");
    check_return(context_, text_, axis_, path_, text_.return_speed);
  }

 private:
  static const Feature* feature_of(const CheckContext& context, const GroupText& group) {
    if (group.kind != GroupKind::feature) return nullptr;
    const std::optional<int> index = context.symbols.find_feature(group.feature.text);
    return index ? &context.symbols.features[static_cast<std::size_t>(*index)].feature : nullptr;
  }

  bool turns() const { return is_rotation(axis_); }

  void check_positive(const ValueText& value, const Dimension& expected, const char* word) {
    const std::string what = path_ + "." + word;
    if (!check_value(context_, value, expected, what)) return;
    if (present_value(context_, value) <= 0.0) {
      context_.diagnostics.add(wording::not_positive(value.span, what, false));
    }
  }

  /// A norm begins at 0.
  void check_norms() {
    if (!text_.is_norm() || feature_ != nullptr) return;
    for (const Quantity quantity : {Quantity::velocity, Quantity::acceleration, Quantity::force}) {
      const std::optional<StatementText>& range = text_[quantity];
      if (!range || !range->is_range) continue;
      const ValueText& low = range->low;
      const bool is_known =
          low.kind == ValueKind::quantity && low.quantity.dimension == dimension_of(axis_, quantity);
      if (!is_known || low.quantity.value == 0.0) continue;
      const std::string what = path_ + "." + word_of(quantity);
      context_.diagnostics.add(text_.is_speed() ? wording::speed_from_zero(range->span, what)
                                                : wording::norm_from_zero(range->span, what));
    }
  }

  /// `stiffness` and `damping` make a spring of a position driver, in the place of the time constant.
  void check_compliance() {
    if (!text_.stiffness && !text_.damping) return;
    const std::optional<StatementText>& position = text_[Quantity::position];
    const int errors_before = context_.diagnostics.error_count();
    if (text_.stiffness) {
      check_positive(*text_.stiffness, turns() ? dimension::angular_stiffness : dimension::stiffness,
                     "stiffness");
    }
    if (text_.damping) {
      check_positive(*text_.damping, turns() ? dimension::angular_damping : dimension::damping, "damping");
    }
    const Span span = (text_.stiffness ? *text_.stiffness : *text_.damping).span;
    const bool is_spring = text_.stiffness && text_.damping && position && !position->is_range;
    // A key of the spring may be the one that could not be read.
    const bool is_read = context_.diagnostics.error_count() == errors_before;
    if (!is_spring && !is_incomplete_ && is_read)
      context_.diagnostics.add(wording::incomplete_spring(span, path_));
    if (is_spring && text_.time_constant) {
      context_.diagnostics.add(wording::spring_with_time_constant(text_.time_constant->span, path_));
    }
  }

  void check_statement(Quantity quantity) {
    const std::optional<StatementText>& statement = text_[quantity];
    if (!statement) return;
    const std::string what = path_ + "." + word_of(quantity);
    const Dimension expected = dimension_of(axis_, quantity);
    if (statement->is_range) {
      const bool low = check_value(context_, statement->low, expected, what);
      const bool high = check_value(context_, statement->high, expected, what);
      if (low && high && present_value(context_, statement->low) > present_value(context_, statement->high)) {
        context_.diagnostics.add(
            wording::empty_range(statement->span, written(statement->low), written(statement->high)));
      }
      return;
    }
    const bool is_here = statement->value.kind == ValueKind::here && quantity == Quantity::position;
    if (is_here) return;
    check_driver_value(context_, statement->value, expected, what);
  }

  /// A distance is never negative, an angle between two axes never more than half a turn.
  void check_place_on_feature() {
    const std::optional<StatementText>& position = text_[Quantity::position];
    if (feature_ == nullptr || !position || feature_->kind == FeatureKind::direction) return;
    const bool is_distance = feature_->kind == FeatureKind::distance;
    const Dimension expected = is_distance ? dimension::length : dimension::angle;
    const ValueText& low = position->is_range ? position->low : position->value;
    const ValueText& high = position->is_range ? position->high : position->value;
    const auto value_of = [&](const ValueText& value) { return known_value(context_, value, expected); };
    const bool is_below = value_of(high).value_or(0.0) < 0.0;
    const bool is_above = !is_distance && value_of(low).value_or(0.0) > std::numbers::pi;
    if (!is_below && !is_above) return;
    context_.diagnostics.add(is_distance ? wording::beyond_a_distance(position->span, path_)
                                         : wording::beyond_an_angle(position->span, path_));
  }

  const FrameSymbol* symbol(const std::optional<int>& frame) const {
    return frame ? &context_.symbols.frames[static_cast<std::size_t>(*frame)] : nullptr;
  }

  void check_single_driver() {
    const StatementText* first = nullptr;
    std::string first_word;
    for (const Quantity quantity : quantities) {
      const std::optional<StatementText>& statement = text_[quantity];
      if (!statement || statement->is_range || statement->value.kind == ValueKind::bad) continue;
      if (first == nullptr) {
        first = &*statement;
        first_word = word_of(quantity);
      } else {
        context_.diagnostics.add(wording::driven_twice(statement->key_span, path_, first_word,
                                                       word_of(quantity), first->key_span));
        return;
      }
    }
  }

  /// A force range bounds a motion driver or the whole axis: it must leave room for no force at all.
  void check_force_range() {
    const std::optional<StatementText>& force = text_[Quantity::force];
    if (!force || !force->is_range) return;
    const auto is_known = [&](const ValueText& v) {
      return v.kind == ValueKind::quantity ||
             (v.kind == ValueKind::parameter && context_.symbols.find_parameter(v.name) != nullptr);
    };
    if (!is_known(force->low) || !is_known(force->high)) return;
    const double low = present_value(context_, force->low);
    const double high = present_value(context_, force->high);
    if (low <= high && (low > 0.0 || high < 0.0)) {
      context_.diagnostics.add(wording::force_range_without_zero(force->span, path_));
    }
  }

  CheckContext& context_;
  const AxisText& text_;
  std::string path_;
  const Feature* feature_;  ///< nullptr: the axis is one of a frame
  Axis axis_;               ///< whose dimensions the statements have: of a feature any that measures alike
  std::optional<int> move_, in_;
  bool is_incomplete_;
};

/// E414: a point, or a circle within the footprint, that has no place inside. Corners may stand around a
/// notch, so a footprint is only asked about where there is none.
void check_room(CheckContext& context, const GroupText& group, const Region& region) {
  const std::optional<double> margin =
      group.margin ? known_value(context, *group.margin, dimension::length) : 0.0;
  if (!margin || *margin < 0.0) return;
  const auto has_place = [&](double needed) {
    return region.radius > 0.0 ? region.radius > needed : has_room(region.polygon, needed);
  };
  const Span& span = group.margin ? group.margin->span : group.region.span;
  if (*margin > 0.0 && !has_place(*margin)) {
    context.diagnostics.add(wording::no_inside(span, region.name, *margin, 0.0, region.span));
    return;
  }
  const bool moves_footprint = group.move.text == "footprint" && context.robot.has_value();
  const double circle =
      moves_footprint && is_convex(region.polygon) ? circle_within(context.robot->footprint) : 0.0;
  if (circle > 0.0 && !has_place(*margin + circle))
    context.diagnostics.add(wording::no_inside(span, region.name, *margin, circle, region.span));
}

void check_inside(CheckContext& context, const GroupText& group) {
  const std::optional<int> region = context.symbols.find_region(group.region.text);
  if (region) {
    context.symbols.regions[static_cast<std::size_t>(*region)].is_used = true;
  } else if (group.region.exists()) {
    context.diagnostics.add(wording::unknown_name(group.region.span, "region", group.region.text,
                                                  context.symbols.region_names()));
  }
  if (group.move.text != "footprint") {
    const std::optional<int> move = check_frame(context, group.move);
    if (move && context.symbols.frames[static_cast<std::size_t>(*move)].body < 0) {
      context.diagnostics.add(wording::immovable(group.move.span, group.move.text));
    }
  }
  const std::string what = group.name.text + ".margin";
  if (group.margin && check_value(context, *group.margin, dimension::length, what) &&
      present_value(context, *group.margin) < 0.0) {
    context.diagnostics.add(wording::not_positive(group.margin->span, what, true));
  }
  if (group.return_speed)
    check_return_speed(context, *group.return_speed, dimension::velocity, group.name.text + ".return");
  if (region) check_room(context, group, context.symbols.regions[static_cast<std::size_t>(*region)].region);
}

void check_feature_group(CheckContext& context, const GroupText& group) {
  const std::optional<int> feature = context.symbols.find_feature(group.feature.text);
  if (!feature) {
    if (group.feature.exists()) {
      context.diagnostics.add(wording::unknown_name(group.feature.span, "feature", group.feature.text,
                                                    context.symbols.feature_names()));
    }
    return;
  }
  context.symbols.features[static_cast<std::size_t>(*feature)].is_used = true;
  for (const AxisText& axis : group.axes) AxisCheck(context, group, axis, std::nullopt, std::nullopt).check();
}

/// A frame that rides along with the moved link is always at the same place in it. The frames are the
/// group's: its first position tells for all.
void check_positions(CheckContext& context, const GroupText& group, const std::optional<int>& move_index,
                     const std::optional<int>& in_index) {
  if (!move_index || !in_index) return;
  const FrameSymbol& move = context.symbols.frames[static_cast<std::size_t>(*move_index)];
  const FrameSymbol& in = context.symbols.frames[static_cast<std::size_t>(*in_index)];
  if (in.body < 0 || move.body != in.body) return;
  for (const AxisText& axis : group.axes) {
    const std::optional<StatementText>& position = axis[Quantity::position];
    if (!position || (!position->is_range && position->value.kind == ValueKind::here)) continue;
    const bool is_unknown = !position->is_range && position->value.kind == ValueKind::name &&
                            !context.symbols.find_signal(position->value.name);
    if (is_unknown) continue;
    context.diagnostics.add(wording::position_in_own_axes(position->key_span,
                                                          group.name.text + "." + axis.name.text,
                                                          in.declaration.name, move.declaration.name));
    return;
  }
}

/// The group's weight is that of each axis that gives none: a mass, or on an axis that turns an inertia.
void check_group_weight(CheckContext& context, const GroupText& group) {
  if (!group.weight) return;
  for (const AxisText& axis : group.axes) {
    if (axis.weight || axis.is_free || axis.is_norm()) continue;
    const bool turns = is_rotation(axis_named(axis.name.text).value_or(Axis::x));
    const std::string what = group.name.text + ".weight, that of `" + axis.name.text + "`,";
    if (!check_value(context, *group.weight, turns ? dimension::inertia : dimension::mass, what)) return;
  }
  if (present_value(context, *group.weight) <= 0.0) {
    context.diagnostics.add(wording::not_positive(group.weight->span, group.name.text + ".weight", false));
  }
}

/// The group's `return` is that of each position range that gives none.
void check_group_return(CheckContext& context, const GroupText& group) {
  if (!group.return_speed) return;
  bool is_used = false;
  for (const AxisText& axis : group.axes) {
    if (!has_position_range(axis) || axis.return_speed) continue;
    is_used = true;
    check_return_speed(context, *group.return_speed,
                       dimension_of(axis_named(axis.name.text).value_or(Axis::x), Quantity::velocity),
                       group.name.text + ".return, that of `" + axis.name.text + "`,");
  }
  if (!is_used && !group.is_incomplete)
    context.diagnostics.add(wording::return_without_range(group.return_speed->span, group.name.text));
}

void check_group(CheckContext& context, const GroupText& group) {
  if (group.kind == GroupKind::inside) return check_inside(context, group);
  if (group.kind == GroupKind::feature) return check_feature_group(context, group);
  std::optional<int> move = check_frame(context, group.move);
  const std::optional<int> in = check_frame(context, group.in);
  if (move && context.symbols.frames[static_cast<std::size_t>(*move)].body < 0) {
    context.diagnostics.add(wording::immovable(group.move.span, group.move.text));
    move.reset();
  }
  if (group.time_constant) {
    check_time(context, *group.time_constant, group.name.text + ".time_constant", false);
  }
  check_group_weight(context, group);
  check_group_return(context, group);
  if (group.axes.empty() && !group.is_incomplete)
    context.diagnostics.add(wording::group_without_axes(group.name.span, group.name.text));
  for (const AxisText& axis : group.axes) AxisCheck(context, group, axis, move, in).check();
  check_positions(context, group, move, in);
}

}  // namespace

void check_groups(CheckContext& context, const std::vector<GroupText>& groups) {
  for (const GroupText& group : groups) check_group(context, group);
}

namespace {

/// The magnitude that a driver asks for, where it is known before the run.
std::optional<double> asked(const CheckContext& context, const StatementText& statement) {
  if (statement.is_range) return std::nullopt;
  const bool is_known =
      statement.value.kind == ValueKind::quantity || statement.value.kind == ValueKind::parameter;
  if (!is_known) return std::nullopt;
  return present_value(context, statement.value);
}

void compare_with_limit(CheckContext& context, const std::string& group, const AxisText& axis,
                        Quantity quantity, const GroupText& limiting, const AxisText& limit) {
  const std::optional<StatementText>& driver = axis[quantity];
  const std::optional<StatementText>& range = limit[quantity];
  if (!driver || !range || !range->is_range) return;
  const std::optional<double> value = asked(context, *driver);
  const double low = present_value(context, range->low);
  const double high = present_value(context, range->high);
  if (!value || (low <= *value && *value <= high) || low > high) return;
  context.diagnostics.add(
      wording::beyond_always(driver->span, group + "." + axis.name.text, written(driver->value),
                             "always." + limiting.name.text + "." + limit.name.text,
                             *value > high ? written(range->high) : written(range->low), range->span));
}

}  // namespace

void check_against_always(CheckContext& context, const TaskText& task) {
  if (context.diagnostics.has_errors()) return;
  for (const GroupText& group : task.groups) {
    for (const GroupText& limiting : context.file.always_groups) {
      const bool is_same = group.kind == GroupKind::axes && limiting.kind == GroupKind::axes &&
                           group.move.text == limiting.move.text && group.in.text == limiting.in.text;
      if (!is_same) continue;
      for (const AxisText& axis : group.axes) {
        for (const AxisText& limit : limiting.axes) {
          const bool is_limited = axis.name.text == limit.name.text ||
                                  (limit.is_norm() && (axis.name.text == "x" || axis.name.text == "y"));
          if (!is_limited) continue;
          for (const solver::Quantity quantity :
               {solver::Quantity::velocity, solver::Quantity::acceleration, solver::Quantity::force}) {
            compare_with_limit(context, group.name.text, axis, quantity, limiting, limit);
          }
        }
      }
    }
  }
}

}  // namespace zwang::lang
