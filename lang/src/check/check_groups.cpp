#include <algorithm>
#include <array>
#include <numbers>

#include "check/context.hpp"
#include "check/parameter_values.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_forces.hpp"
#include "diagnostic/wordings_paths.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "diagnostic/wordings_standing.hpp"

namespace zwang::lang {

namespace {

using solver::Axis;

std::string axis_path(const GroupText& group, const AxisText& axis) {
  return group.kind == GroupKind::feature ? group.name.text : group.name.text + "." + axis.name.text;
}

/// Not below 0.
void check_return_speed(CheckContext& context, const ValueText& value, const Dimension& expected,
                        const std::string& what) {
  if (check_value(context, value, expected, what)) check_positive(context, value, what, true);
}

bool has_position_range(const AxisText& text) {
  const std::optional<StatementText>& position = text[solver::Quantity::position];
  return position && position->is_range;
}

/// `return` leads back into a range of positions: the axis must have one.
void check_return(CheckContext& context, const AxisText& text, Axis axis, const std::string& path,
                  const std::optional<ValueText>& return_speed) {
  if (!return_speed) return;
  check_return_speed(context, *return_speed, dimension_of(axis, solver::Quantity::velocity),
                     path + ".return");
  const std::optional<StatementText>& position = text[solver::Quantity::position];
  const bool is_unread = position && !position->is_range && position->value.kind == ValueKind::bad;
  if (!has_position_range(text) && !is_unread)
    context.diagnostics.add(wording::return_without_range(return_speed->span, path));
}

/// One axis of one group.
class AxisCheck {
 public:
  /// `groups`: those of the task, which a `yield` may speak of.
  AxisCheck(CheckContext& context, const std::vector<GroupText>& groups, const GroupText& group,
            const AxisText& text)
      : context_(context),
        groups_(groups),
        text_(text),
        path_(axis_path(group, text)),
        feature_(feature_of(context, group)),
        axis_(feature_ == nullptr ? axis_named(text.name.text).value_or(Axis::x)
                                  : (feature_->turns ? Axis::rz : Axis::x)),
        is_incomplete_(group.is_incomplete) {}

  void check() {
    for (const solver::Quantity quantity : quantities_of_axis) check_statement(quantity);
    check_single_driver();
    check_place_on_feature();
    const bool is_bearing = feature_ != nullptr && feature_->kind == FeatureKind::bearing;
    if (is_bearing || (feature_ == nullptr && turns())) check_half_turn(context_, text_, path_);
    check_force_range();
    if (text_.time_constant) check_time(context_, *text_.time_constant, path_ + ".time_constant", false);
    check_yield();
    check_build_up();
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
    lang::check_positive(context_, value, what, false);
  }

  /// A norm begins at 0.
  void check_norms() {
    if (!text_.is_norm() || feature_ != nullptr) return;
    for (const solver::Quantity quantity :
         {solver::Quantity::velocity, solver::Quantity::acceleration, solver::Quantity::force}) {
      const std::optional<StatementText>& range = text_[quantity];
      if (!range || !range->is_range || !known_value(context_, range->low, dimension_of(axis_, quantity)))
        continue;
      const solver::Range values = values_of(context_, range->low);
      if (values.low == 0.0 && values.high == 0.0) continue;
      const std::string what = path_ + "." + word_of(quantity);
      context_.diagnostics.add(text_.is_speed() ? wording::speed_from_zero(range->span, what)
                                                : wording::norm_from_zero(range->span, what));
    }
  }

  /// `yield` with `mass` and `damping`: moves like a body that the force pushes.
  void check_yield() {
    if (!text_.yield) return;
    const std::string what = path_ + ".yield";
    if (!text_.yield->is_bad) {
      auto force = check_expression(context_, *text_.yield, groups_, what,
                                    dimension_of(axis_, solver::Quantity::force));
      if (force && context_.yields != nullptr) (*context_.yields)[&text_] = std::move(*force);
    }
    if (text_.mass) check_positive(*text_.mass, turns() ? dimension::inertia : dimension::mass, "mass");
    if (text_.damping)
      check_positive(*text_.damping, turns() ? dimension::angular_damping : dimension::damping, "damping");
    if (text_.dead_band && check_value(context_, *text_.dead_band,
                                       dimension_of(axis_, solver::Quantity::force), path_ + ".dead_band"))
      lang::check_positive(context_, *text_.dead_band, path_ + ".dead_band", true);
    if (text_.time_constant)
      context_.diagnostics.add(wording::yield_with_time_constant(text_.time_constant->span, path_));
  }

  /// `build_up` adds up the error of a driver of motion.
  void check_build_up() {
    if (!text_.build_up) return;
    check_time(context_, *text_.build_up, path_ + ".build_up", false);
    const auto drives = [&](solver::Quantity quantity) {
      return text_[quantity] && !text_[quantity]->is_range;
    };
    const bool has_error = drives(solver::Quantity::position) || drives(solver::Quantity::velocity);
    if (!has_error && !is_incomplete_) {
      context_.diagnostics.add(wording::build_up_without_driver(text_.build_up->span, path_));
    } else if (text_.stiffness && !text_.yield) {
      context_.diagnostics.add(wording::build_up_with_spring(text_.build_up->span, path_));
    }
  }

  /// `stiffness` and `damping` make a spring of a position driver, in the place of the time constant.
  void check_compliance() {
    if (text_.yield || (!text_.stiffness && !text_.damping)) return;
    const std::optional<StatementText>& position = text_[solver::Quantity::position];
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
    if (!is_spring && !is_incomplete_ && is_read) {
      const std::string missing = !text_.stiffness ? "stiffness" : !text_.damping ? "damping" : "position";
      context_.diagnostics.add(wording::incomplete_spring(span, path_, missing));
    }
    if (is_spring && text_.time_constant) {
      context_.diagnostics.add(wording::spring_with_time_constant(text_.time_constant->span, path_));
    }
  }

  void check_statement(solver::Quantity quantity) {
    const std::optional<StatementText>& statement = text_[quantity];
    if (!statement) return;
    const std::string what = path_ + "." + word_of(quantity);
    const Dimension expected = dimension_of(axis_, quantity);
    if (statement->is_range) {
      const bool low = check_value(context_, statement->low, expected, what);
      const bool high = check_value(context_, statement->high, expected, what);
      if (!low || !high) return;
      if (present_value(context_, statement->low) > present_value(context_, statement->high)) {
        context_.diagnostics.add(
            wording::empty_range(statement->span, as_written(statement->low), as_written(statement->high)));
      } else {
        require_order(context_, statement->low, statement->high,
                      "the lower end of `" + what + "` cannot lie above its upper end");
      }
      return;
    }
    const bool is_here = statement->value.kind == ValueKind::here && quantity == solver::Quantity::position;
    if (is_here) return;
    check_driver_value(context_, statement->value, expected, what);
  }

  /// A distance is never negative, an angle between two axes never more than half a turn.
  void check_place_on_feature() {
    const std::optional<StatementText>& position = text_[solver::Quantity::position];
    if (feature_ == nullptr || !position || feature_->kind == FeatureKind::direction ||
        feature_->kind == FeatureKind::bearing)
      return;
    const bool is_distance = feature_->kind == FeatureKind::distance;
    const Dimension expected = is_distance ? dimension::length : dimension::angle;
    const ValueText& low = position->is_range ? position->low : position->value;
    const ValueText& high = position->is_range ? position->high : position->value;
    const auto value_of = [&](const ValueText& value) { return known_value(context_, value, expected); };
    const bool is_below = value_of(high).value_or(0.0) < 0.0;
    const bool is_above = !is_distance && value_of(low).value_or(0.0) > std::numbers::pi;
    if (!is_below && !is_above) {
      const std::string kind = is_distance ? "a distance" : "an angle between two axes";
      if (value_of(high)) require(context_, high, {.rule = kind + " cannot be below 0"});
      if (value_of(low) && !is_distance)
        require(context_, low,
                {.rule = kind + " cannot be above 180 deg", .limit = std::numbers::pi, .is_least = false});
      return;
    }
    context_.diagnostics.add(is_distance ? wording::beyond_a_distance(position->span, path_)
                                         : wording::beyond_an_angle(position->span, path_));
  }

  void check_single_driver() {
    const StatementText* first = nullptr;
    std::string first_word;
    if (text_.yield) {
      for (const solver::Quantity quantity : quantities_of_axis) {
        const std::optional<StatementText>& other = text_[quantity];
        if (!other || other->is_range || other->value.kind == ValueKind::bad) continue;
        context_.diagnostics.add(
            wording::driven_twice(other->key_span, path_, "yield", word_of(quantity), text_.yield_span));
        return;
      }
    }
    for (const solver::Quantity quantity : quantities_of_axis) {
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
    const std::optional<StatementText>& force = text_[solver::Quantity::force];
    if (!force || !force->is_range) return;
    const auto is_known = [&](const ValueText& v) {
      return v.kind == ValueKind::quantity ||
             (v.kind == ValueKind::parameter && context_.symbols.find_parameter(v.name) != nullptr);
    };
    if (!is_known(force->low) || !is_known(force->high)) return;
    const double low = present_value(context_, force->low);
    const double high = present_value(context_, force->high);
    if (low > high) return;
    if (low > 0.0 || high < 0.0) {
      context_.diagnostics.add(wording::force_range_without_zero(force->span, path_));
    } else if (!is_mirrored(force->low, force->high)) {
      const std::string rule = "the force range of `" + path_ + "` must hold 0";
      require(context_, force->low, {.rule = rule, .is_least = false});
      require(context_, force->high, {.rule = rule});
    }
  }

  /// `+-$f`: its order says all.
  static bool is_mirrored(const ValueText& low, const ValueText& high) {
    return low.kind == ValueKind::parameter && high.kind == ValueKind::parameter && low.name == high.name;
  }

  CheckContext& context_;
  const std::vector<GroupText>& groups_;
  const AxisText& text_;
  std::string path_;
  const Feature* feature_;  ///< nullptr: the axis is one of a frame
  Axis axis_;               ///< whose dimensions the statements have: of a feature any that measures alike
  bool is_incomplete_;
};

/// A frame that rides along with the moved link is always at the same place in it. The frames are the
/// group's: its first position tells for all.
void check_positions(CheckContext& context, const GroupText& group, const std::optional<int>& move_index,
                     const std::optional<int>& in_index) {
  if (!move_index || !in_index) return;
  const FrameSymbol& move = context.symbols.frames[static_cast<std::size_t>(*move_index)];
  const FrameSymbol& in = context.symbols.frames[static_cast<std::size_t>(*in_index)];
  if (in.body < 0 || move.body != in.body) return;
  for (const AxisText& axis : group.axes) {
    const std::optional<StatementText>& position = axis[solver::Quantity::position];
    if (!position || (!position->is_range && position->value.kind == ValueKind::here)) continue;
    const bool is_unknown = !position->is_range && position->value.kind == ValueKind::name &&
                            !context.symbols.find_signal(position->value.name);
    if (is_unknown) continue;
    const bool is_measured = !position->is_range && position->value.kind == ValueKind::name;
    context.diagnostics.add(is_measured
                                ? wording::measured_position_in_own_axes(
                                      position->key_span, axis_path(group, axis), position->value.name)
                                : wording::position_in_own_axes(position->key_span, axis_path(group, axis),
                                                                in.declaration.name, move.declaration.name));
    return;
  }
}

void check_feature_group(CheckContext& context, const std::vector<GroupText>& groups,
                         const GroupText& group) {
  const std::optional<int> feature = context.symbols.find_feature(group.feature.text);
  if (!feature) {
    if (group.feature.exists()) {
      context.diagnostics.add(wording::unknown_name(group.feature.span, "feature", group.feature.text,
                                                    context.symbols.feature_names()));
    }
    return;
  }
  context.symbols.features[static_cast<std::size_t>(*feature)].is_used = true;
  if (context.symbols.features[static_cast<std::size_t>(*feature)].is_bad) return;
  for (const AxisText& axis : group.axes) AxisCheck(context, groups, group, axis).check();
  const FeatureSymbol& symbol = context.symbols.features[static_cast<std::size_t>(*feature)];
  // Of a distance and an angle E412 says so.
  if (!symbol.is_bad && symbol.feature.kind == FeatureKind::direction)
    check_positions(context, group, symbol.feature.first, symbol.feature.second);
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
  check_positive(context, *group.weight, group.name.text + ".weight", false);
}

/// The group's `return` is that of each position range that gives none.
void check_group_return(CheckContext& context, const GroupText& group) {
  if (!group.return_speed) return;
  bool is_used = false;
  for (const AxisText& axis : group.axes) {
    if (!has_position_range(axis) || axis.return_speed) continue;
    is_used = true;
    check_return_speed(context, *group.return_speed,
                       dimension_of(axis_named(axis.name.text).value_or(Axis::x), solver::Quantity::velocity),
                       group.name.text + ".return, that of `" + axis.name.text + "`,");
  }
  if (!is_used && !group.is_incomplete)
    context.diagnostics.add(wording::return_without_range(group.return_speed->span, group.name.text));
}

/// Of a group along a path: its axes, and that its frame moves against the path.
void check_path_group(CheckContext& context, const GroupText& group, const std::optional<int>& move_index,
                      const FrameSymbol& path) {
  for (const AxisText& axis : group.axes) {
    const std::string& word = axis.name.text;
    if (word != "x" && word != "y" && word != "z" && word != "rz")
      context.diagnostics.add(wording::no_axis_of_a_path(axis.name.span, group.name.text, word,
                                                         group.move.text, path.declaration.name));
  }
  if (!move_index || path.body < 0) return;
  if (context.symbols.frames[static_cast<std::size_t>(*move_index)].body == path.body)
    context.diagnostics.add(wording::rigid_path(group.in.span, group.move.text, path.declaration.name));
}

void check_group(CheckContext& context, const std::vector<GroupText>& groups, const GroupText& group) {
  if (group.kind == GroupKind::inside) return check_inside(context, group);
  if (group.kind == GroupKind::feature) return check_feature_group(context, groups, group);
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
  for (const AxisText& axis : group.axes) AxisCheck(context, groups, group, axis).check();
  const FrameSymbol* axes = in ? &context.symbols.frames[static_cast<std::size_t>(*in)] : nullptr;
  if (axes != nullptr && axes->path >= 0) return check_path_group(context, group, move, *axes);
  check_positions(context, group, move, in);
}

}  // namespace

void check_groups(CheckContext& context, const std::vector<GroupText>& groups) {
  for (const GroupText& group : groups) check_group(context, groups, group);
}

}  // namespace zwang::lang
