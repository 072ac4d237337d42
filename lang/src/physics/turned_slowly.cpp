// E633: a heading that a wall turns more slowly than the exit asks for that is to tell that it is square.
//
//   w = F b / (alpha gamma I)
//
// Behind a drive that feels, what presses on the base moves a virtual robot. It is alpha times as heavy, and
// its velocities fade with gamma while something presses. A wall that the base comes to askew turns it with
// F b. F is the push at the corner that touches first, b its distance from the line of the push. An exit at
// w_0 >= w is true of a base that the wall still turns. I is the most of all settings of the swivels.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "check/cases.hpp"
#include "diagnostic/wordings_feeling.hpp"
#include "physics/push.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

/// As far as that the shipped scenes let bases come askew. [rad]
constexpr double farthest_askew = 25.0 * std::numbers::pi / 180.0;

}  // namespace

std::optional<double> turn_at_rest(const CheckContext& context, const PlannedTask& plan,
                                   const Condition& condition, const PlannedAxis& axis) {
  const auto cases = cases_of(context, condition, plan.task->groups);
  if (!cases) return std::nullopt;
  std::optional<double> fastest;
  for (const Case& one : *cases) {
    for (const auto& [key, demand] : one) {
      const ExpressionNode& node = *demand.node;
      const bool is_turn = node.op == Op::coordinate && !node.in_always &&
                           node.what == CoordinateQuantity::velocity &&
                           &plan.task->groups[static_cast<std::size_t>(node.index)]
                                   .axes[static_cast<std::size_t>(node.axis)] == axis.text;
      if (!is_turn) continue;
      const double slow = std::min(demand.bounds.high, -demand.bounds.low);
      if (std::isfinite(slow) && slow > fastest.value_or(0.0)) fastest = slow;
    }
  }
  return fastest;
}

void ask_turned_slowly(const CheckContext& context, const PlannedTask& plan,
                       const std::vector<Condition>& conditions, Probe& probe, Remarks& remarks) {
  const Drive& drive = probe.robot().drive;
  if (!drive.feels_contact()) return;
  for (const PlannedAxis& axis : plan.free) {
    const bool is_heading = axis.move.body == 0 && axis.is_placed && !axis.is_feature() && axis.turns() &&
                            !probe.is_out_of_plane(axis);
    const Push push = is_heading ? push_of(plan, probe) : Push{};
    const AxisFigures* figures = push.axis != nullptr ? probe.figures(axis) : nullptr;
    if (figures == nullptr || !std::isfinite(figures->most_mass)) continue;
    const double turns = push.force * lever_askew(push, farthest_askew, probe) /
                         (drive.mass_factor * drive.contact_damping * figures->most_mass);
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      const ExitText& exit = plan.task->exits[i];
      if (exit.target.text == "failed" || conditions[i].nodes.empty()) continue;
      const std::optional<double> slow = turn_at_rest(context, plan, conditions[i], axis);
      if (slow && *slow >= turns)
        remarks.add(wording::turned_slowly(
            exit.when.span, {axis.path, *slow, turns, push.force, farthest_askew}, push.axis->driver_span()));
    }
  }
}

}  // namespace zwang::lang
