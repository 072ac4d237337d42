// W402: a task's driver asks for a value that `always` does not allow.
#include <cmath>

#include "check/context.hpp"
#include "check/parameter_values.hpp"
#include "diagnostic/wordings.hpp"

namespace zwang::lang {

namespace {

/// The value that a driver asks for, if it is known before the run.
std::optional<double> asked(const CheckContext& context, const StatementText& statement) {
  if (statement.is_range) return std::nullopt;
  const bool is_known =
      statement.value.kind == ValueKind::quantity || statement.value.kind == ValueKind::parameter;
  if (!is_known) return std::nullopt;
  return present_value(context, statement.value);
}

void compare_with_limit(CheckContext& context, const std::string& group, const AxisText& axis,
                        solver::Quantity quantity, const GroupText& limiting, const AxisText& limit) {
  const std::optional<StatementText>& driver = axis[quantity];
  const std::optional<StatementText>& range = limit[quantity];
  if (!driver || !range || !range->is_range) return;
  std::optional<double> value = asked(context, *driver);
  if (value && limit.is_norm()) value = std::abs(*value);  // whatever way it goes
  const double low = present_value(context, range->low);
  const double high = present_value(context, range->high);
  if (!value || (low <= *value && *value <= high) || low > high) return;
  context.diagnostics.add(
      wording::beyond_always(driver->span, group + "." + axis.name.text, as_written(driver->value),
                             "always." + limiting.name.text + "." + limit.name.text,
                             *value > high ? as_written(range->high) : as_written(range->low), range->span));
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
