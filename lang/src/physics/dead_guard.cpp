// W602: a force range that the driver's own nu never reaches, so that a guard on `saturated` never fires.
//
// Blocked (ds = 0), a driver asks for the acceleration b and its row presses with m b:
//
//   velocity v          b = |v| / tau
//   acceleration c      b = |c|
//   position with a velocity range [-v, v]: far away the range decides, b = v / h
//
// less where the axis's own acceleration range folds in. Where another range stops the base at less than b,
// the driver misses its b in the open already and runs into its bound: then the guard is not dead.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_physics.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

struct Demand {
  double b = 0.0;     ///< [m/s^2] or [rad/s^2], signed; of a position driver either way
  bool both = false;  ///< it may push either way
};

std::optional<Demand> demand_of(const PlannedAxis& axis) {
  const std::optional<solver::Range>& velocity = axis[solver::Quantity::velocity];
  if (axis.driver == solver::Quantity::velocity && axis.target)
    return Demand{*axis.target / axis.time_constant, false};
  if (axis.driver == solver::Quantity::acceleration && axis.target) return Demand{*axis.target, false};
  if (axis.driver == solver::Quantity::position && velocity) {
    return Demand{std::max(velocity->high, -velocity->low) / solver::ConstraintSet::horizon, true};
  }
  return std::nullopt;
}

/// Where a guard of the task asks for `group.axis.saturated`.
std::optional<Span> guard_on(const CheckContext& context, const TaskText& task, const PlannedAxis& axis) {
  const std::string wanted =
      axis.group + (axis.is_feature() ? "" : "." + axis.text->name.text) + ".saturated";
  const auto find = [&](const std::vector<ExitText>& exits) -> std::optional<Span> {
    for (const ExitText& exit : exits) {
      for (const ExpressionText& node : exit.when.nodes) {
        if (node.kind == ExpressionKind::name && node.word == wanted) return node.span;
      }
    }
    return std::nullopt;
  };
  const std::optional<Span> here = find(task.exits);
  return here ? here : find(context.file.always_exits);
}

}  // namespace

void ask_dead_guard(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) {
    const std::optional<solver::Range>& force = axis[solver::Quantity::force];
    if (!axis.drives_motion() || !force || axis.group.empty() || !(axis.time_constant > 0.0)) continue;
    const std::optional<Demand> demand = demand_of(axis);
    const AxisFigures* figures = probe.figures(axis);
    if (!demand || demand->b == 0.0 || figures == nullptr || !std::isfinite(figures->mass)) continue;
    double b = std::abs(demand->b);
    if (const auto& own = axis[solver::Quantity::acceleration]) {
      b = std::min(b, demand->both      ? std::max(own->high, -own->low)
                      : demand->b > 0.0 ? own->high
                                        : -own->low);
    }
    const double bound = demand->both      ? std::min(force->high, -force->low)
                         : demand->b > 0.0 ? force->high
                                           : -force->low;
    if (acceleration_limit(plan, axis, demand->b, false).most < b) continue;
    const double pressed = figures->mass * b;
    if (pressed >= bound) continue;
    const std::optional<Span> guard = guard_on(context, *plan.task, axis);
    if (!guard) continue;
    // m v / tau = bound
    const double time_constant =
        axis.driver == solver::Quantity::velocity ? figures->mass * std::abs(*axis.target) / bound : 0.0;
    remarks.add(wording::dead_guard(axis.span(solver::Quantity::force), axis.path, axis.turns(),
                                    figures->mass, b, pressed, time_constant, *guard));
  }
}

}  // namespace zwang::lang
