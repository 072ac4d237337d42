// Angles that start anew at half a turn: rx, ry and rz of a group, and a bearing. A driver goes the shorter
// way to what is the same angle. A range is compared with the angle as it is measured, so beyond half a turn
// it is never kept.
#include <cmath>
#include <numbers>

#include "check/context.hpp"
#include "check/parameter_values.hpp"
#include "diagnostic/wordings_never.hpp"

namespace zwang::lang {

namespace {

constexpr double half_a_turn = std::numbers::pi + 1e-9;  // [rad] 180 deg, as it is rounded

}  // namespace

void check_half_turn(CheckContext& context, const AxisText& axis, const std::string& path) {
  const std::optional<StatementText>& position = axis[solver::Quantity::position];
  if (!position) return;
  if (!position->is_range) {
    const std::optional<double> target = known_value(context, position->value, dimension::angle);
    if (target && std::abs(*target) > half_a_turn)
      context.diagnostics.add(
          wording::wraps_to(position->span, path, *target, std::remainder(*target, 2.0 * std::numbers::pi)));
    return;
  }
  const std::optional<double> low = known_value(context, position->low, dimension::angle);
  const std::optional<double> high = known_value(context, position->high, dimension::angle);
  if (low && high && (*low < -half_a_turn || *high > half_a_turn)) {
    context.diagnostics.add(wording::beyond_half_a_turn(position->span, path));
    return;
  }
  const std::string rule = "`" + path + "` starts anew at 180 deg: a range cannot go beyond";
  if (high) require(context, position->high, {.rule = rule, .limit = half_a_turn, .is_least = false});
  if (low) require(context, position->low, {.rule = rule, .limit = -half_a_turn});
}

}  // namespace zwang::lang
