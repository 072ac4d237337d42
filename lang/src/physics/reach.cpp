// E404: an axis that the ground holds, or that no motor of this robot moves.
//
//   kappa = A Mc A' / A M^-1 A'    the share of the axis that the ground leaves      kappa = 0: held
//   T' A > 0 for some motor        a motor has a force along it                      none: cannot be made
//
// over the start pose and configurations in general position: one that reaches the axis is enough.
#include <algorithm>

#include "diagnostic/wordings_physics.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

/// Standing still where one cannot move asks for nothing; nor does staying `here`.
bool asks_for_nothing(const PlannedAxis& axis) {
  if (axis.text == nullptr) return true;
  if (axis.is_yield) return false;
  const StatementText& statement = *(*axis.text)[*axis.driver];
  if (statement.value.kind == ValueKind::here) return true;
  return axis.driver != solver::Quantity::position && statement.value.kind == ValueKind::quantity &&
         axis.target == 0.0;
}

}  // namespace

void ask_reach(PlannedTask& plan, Probe& probe, Remarks& remarks) {
  const auto is_impossible = [&](const PlannedAxis& axis) {
    if (!axis.driver || asks_for_nothing(axis)) return false;
    const AxisFigures* figures = probe.figures(axis);
    if (figures == nullptr || figures->is_reachable) return false;
    const Span span = axis.is_yield ? axis.driver_span() : (*axis.text)[*axis.driver]->key_span;
    const std::string& word = axis.text->name.text;
    const bool is_sideways = axis.move.body == 0 && !axis.turns() && !axis.is_feature();
    if (probe.is_out_of_plane(axis)) {
      remarks.add(wording::held_axis(span, word));
    } else if (!figures->is_held) {
      const bool can_turn = is_sideways && probe.turns_and_drives();
      remarks.add(axis.in_world && is_sideways ? wording::no_motor_across(span, word, axis.in_name, can_turn)
                                               : wording::no_motor_along(span, word, can_turn));
    } else {
      remarks.add(wording::axis_held_by_wheels(span, word, is_sideways ? probe.frame_ahead() : ""));
    }
    return true;
  };
  std::erase_if(plan.axes, is_impossible);
}

}  // namespace zwang::lang
