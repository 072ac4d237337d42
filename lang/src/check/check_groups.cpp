#include <algorithm>
#include <array>

#include "check/context.hpp"
#include "diagnostic/wordings.hpp"

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

/// One axis of one group.
class AxisCheck {
 public:
  AxisCheck(CheckContext& context, const GroupText& group, const AxisText& text, std::optional<int> move,
            std::optional<int> in)
      : context_(context),
        text_(text),
        path_(group.name.text + "." + text.name.text),
        axis_(*axis_named(text.name.text)),
        move_(move),
        in_(in) {}

  void check() {
    for (const Quantity quantity : quantities) check_statement(quantity);
    check_single_driver();
    check_force_range();
    if (text_.time_constant) check_time(context_, *text_.time_constant, path_ + ".time_constant", false);
  }

 private:
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
      if (quantity == Quantity::position) check_position_is_measurable(*statement);
      return;
    }
    const bool is_here = statement->value.kind == ValueKind::here && quantity == Quantity::position;
    if (is_here) return;
    if (quantity == Quantity::position) check_position_is_measurable(*statement);
    if (check_value(context_, statement->value, expected, what)) check_is_reachable(quantity, *statement);
  }

  const FrameSymbol* symbol(const std::optional<int>& frame) const {
    return frame ? &context_.symbols.frames[static_cast<std::size_t>(*frame)] : nullptr;
  }

  /// A frame that rides along with the moved link is always at the same place in it.
  void check_position_is_measurable(const StatementText& statement) {
    const FrameSymbol* move = symbol(move_);
    const FrameSymbol* in = symbol(in_);
    if (move == nullptr || in == nullptr || in->body < 0 || move->body != in->body) return;
    context_.diagnostics.add(wording::position_in_own_axes(statement.key_span, path_, in->declaration.name,
                                                           move->declaration.name));
  }

  /// The ground holds the base's z, rx and ry. Standing still there is vacuous, anything else impossible.
  void check_is_reachable(Quantity quantity, const StatementText& statement) {
    const bool is_held = axis_ == Axis::z || axis_ == Axis::rx || axis_ == Axis::ry;
    const FrameSymbol* move = symbol(move_);
    if (!is_held || move == nullptr || move->body != 0 || !context_.robot) return;
    if (context_.robot->model.base_type() != solver::BaseType::ground) return;
    const bool is_rest = quantity != Quantity::position && statement.value.kind == ValueKind::quantity &&
                         statement.value.quantity.value == 0.0;
    if (!is_rest) context_.diagnostics.add(wording::held_axis(statement.key_span, text_.name.text));
  }

  void check_single_driver() {
    const StatementText* first = nullptr;
    std::string first_word;
    for (const Quantity quantity : quantities) {
      const std::optional<StatementText>& statement = text_[quantity];
      if (!statement || statement->is_range) continue;
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
  Axis axis_;
  std::optional<int> move_, in_;
};

void check_group(CheckContext& context, const GroupText& group) {
  std::optional<int> move = check_frame(context, group.move);
  const std::optional<int> in = check_frame(context, group.in);
  if (move && context.symbols.frames[static_cast<std::size_t>(*move)].body < 0) {
    context.diagnostics.add(wording::immovable(group.move.span, group.move.text));
    move.reset();
  }
  if (group.time_constant) {
    check_time(context, *group.time_constant, group.name.text + ".time_constant", false);
  }
  if (group.axes.empty())
    context.diagnostics.add(wording::group_without_axes(group.name.span, group.name.text));
  for (const AxisText& axis : group.axes) AxisCheck(context, group, axis, move, in).check();
}

}  // namespace

void check_groups(CheckContext& context, const TaskText& task) {
  for (const GroupText& group : task.groups) check_group(context, group);
}

}  // namespace zwang::lang
