// W602, W619, N619: a force range that a motion driver never reaches.
//
// Blocked (ds = 0), a driver asks for the acceleration b, and the base presses with
//
//   m min(b, a_max)        a_max: of the acceleration ranges in force, of its own axis or of others
//   at most F_sum          of force ranges without a driver, which bound the sum of all rows
//
//   velocity v             b = |v| / tau
//   acceleration c         b = |c|
//   position               b = v / h with a velocity range [-v, v], as far away the range decides
//
// W602: an exit asks for `saturated`, and b does not reach the range, or without one what the motors make.
// Where another range stops the base at less than b, the driver misses its b in the open already. It runs
// into its bound, so that guard is not dead.
//
// W619: less than half of the range is pressed. Up to twice what is made, a range is taken for a rounded
// bound. A yield and `build_up` push as hard as the motors make, the latter within the acceleration ranges.
//
// N619: the demand of a position grows with the distance, so that its range is a bound for bases of any mass.
// If an acceleration limit bounds the demand, N619 is written.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_never.hpp"
#include "diagnostic/wordings_physics.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

constexpr double generous = 0.5;  // of the range

struct Demand {
  double b = 0.0;     ///< [m/s^2] or [rad/s^2], signed; of a position driver either way
  bool both = false;  ///< it may push either way
};

std::optional<Demand> demand_of(const PlannedAxis& axis) {
  const std::optional<solver::Range>& velocity = axis[solver::Quantity::velocity];
  if (axis.driver == solver::Quantity::velocity && axis.target)
    return Demand{*axis.target / axis.time_constant, false};
  if (axis.driver == solver::Quantity::acceleration && axis.target) return Demand{*axis.target, false};
  if (axis.driver != solver::Quantity::position) return std::nullopt;
  if (!velocity) return Demand{solver::infinity, true};
  return Demand{std::max(velocity->high, -velocity->low) / solver::limit_horizon, true};
}

/// Where a guard of the task asks for `group.axis.saturated`.
std::optional<Span> guard_on(const CheckContext& context, const PlannedTask& plan, const PlannedAxis& axis) {
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
  if (axis.group.empty()) return std::nullopt;
  const std::optional<Span> here = find(plan.task->exits);
  return here ? here : find(context.file.always_exits);
}

/// The end of the range that the driver pushes towards; of one that pushes either way the nearer.
double bound_of(const solver::Range& range, const Demand& demand) {
  return demand.both ? std::min(range.high, -range.low) : demand.b > 0.0 ? range.high : -range.low;
}

AccelerationLimit nearest_limit(const PlannedTask& plan, const PlannedAxis& axis, const Demand& demand,
                                bool own) {
  if (!demand.both) return acceleration_limit(plan, axis, demand.b, own);
  const AccelerationLimit ahead = acceleration_limit(plan, axis, 1.0, own);
  const AccelerationLimit back = acceleration_limit(plan, axis, -1.0, own);
  return ahead.most > back.most ? ahead : back;  // the side that presses harder counts
}

void ask_axis(const CheckContext& context, const PlannedTask& plan, const PlannedAxis& axis,
              const Demand& demand, double mass, Remarks& remarks) {
  const solver::Range& range = *axis[solver::Quantity::force];
  const double bound = bound_of(range, demand);
  if (!(bound > 0.0) || range.low > 0.0 || range.high < 0.0) return;  // E408
  const AccelerationLimit own_limit = nearest_limit(plan, axis, demand, true);
  const AccelerationLimit limit = nearest_limit(plan, axis, demand, false);
  double b = std::abs(demand.b);
  if (const auto& own = axis[solver::Quantity::acceleration]) b = std::min(b, bound_of(*own, demand));
  // m v / tau = bound
  const double time_constant =
      axis.driver == solver::Quantity::velocity ? mass * std::abs(*axis.target) / bound : 0.0;
  const std::optional<Span> guard = guard_on(context, plan, axis);
  if (guard && limit.most >= b && mass * b < bound) {
    remarks.add(wording::dead_guard(axis.span(solver::Quantity::force), axis.path, axis.turns(), mass, b,
                                    mass * b, time_constant, *guard));
    return;
  }
  const double made = std::min(b, own_limit.most);
  const bool by_limit = own_limit.most < std::abs(demand.b);
  wording::Unreached unreached{axis.path, axis.turns(), mass, made, mass * made, bound};
  if (demand.both && by_limit) {
    if (context.with_notes && mass * made < bound)
      remarks.add(wording::limited_range(axis.span(solver::Quantity::force), unreached,
                                         own_limit.from->span(solver::Quantity::acceleration)));
    return;
  }
  const ForceLimit sum = sum_limit(plan, axis, demand.b);
  if (sum.most < mass * made) {
    unreached.pressed = sum.most;
    unreached.sum = sum.from->path;
    if (sum.most < generous * bound)
      remarks.add(wording::never_reached(axis.span(solver::Quantity::force), unreached,
                                         sum.from->span(solver::Quantity::force)));
    return;
  }
  if (!(mass * made < generous * bound)) return;
  unreached.velocity = axis.driver == solver::Quantity::velocity ? *axis.target : 0.0;
  unreached.time_constant = axis.time_constant;
  // W604: a velocity wants four ticks.
  const bool is_slow_enough = time_constant >= 4.0 * context.robot->control_period;
  unreached.enough = by_limit || !is_slow_enough ? 0.0 : time_constant;
  remarks.add(wording::never_reached(
      axis.span(solver::Quantity::force), unreached,
      by_limit && own_limit.from != nullptr ? own_limit.from->span(solver::Quantity::acceleration) : Span{}));
}

/// Its bound is what the motors make.
void ask_without_range(const CheckContext& context, const PlannedTask& plan, const PlannedAxis& axis,
                       const Demand& demand, const AxisFigures& figures, Remarks& remarks) {
  const std::optional<Span> guard = guard_on(context, plan, axis);
  const double b = std::abs(demand.b);
  const bool is_clipped = nearest_limit(plan, axis, demand, true).most < b;
  if (!guard || is_clipped || figures.mass * b >= figures.force) return;
  remarks.add(wording::never_saturated(
      *guard, {axis.path, axis.turns(), figures.mass, b, figures.mass * b, figures.force}, figures.force));
}

/// Of a driver that pushes ever harder: what stops it below its range.
void ask_motors(const PlannedTask& plan, const PlannedAxis& axis, const AxisFigures& figures,
                Remarks& remarks) {
  const solver::Range& range = *axis[solver::Quantity::force];
  const double side = !axis.is_yield && axis.target && *axis.target < 0.0 ? -1.0 : 1.0;
  const double bound = axis.is_yield || !axis.target ? std::max(range.high, -range.low)
                       : side > 0.0                  ? range.high
                                                     : -range.low;
  const AccelerationLimit limit =
      axis.is_yield ? AccelerationLimit{} : acceleration_limit(plan, axis, side, true);
  double motors = 0.0;
  for (const double force : figures.forces) motors = std::max(motors, force);
  const double allowed = figures.mass * limit.most;
  const double pressed = std::min(motors, allowed);
  if (!(pressed > 0.0) || !(pressed < generous * bound) || remarks.any_at(axis.span(solver::Quantity::force)))
    return;
  wording::Unreached unreached{axis.path, axis.turns(), figures.mass, limit.most, pressed, bound};
  unreached.by_motors = motors <= allowed;
  remarks.add(wording::never_reached(
      axis.span(solver::Quantity::force), unreached,
      unreached.by_motors ? Span{} : limit.from->span(solver::Quantity::acceleration)));
}

bool pushes_ever_harder(const PlannedAxis& axis, const Drive& drive) {
  return axis[solver::Quantity::force] && !drive.takes_velocity &&
         (axis.is_yield || (axis.build_up && axis.drives_motion())) && axis.text != nullptr && !axis.is_soft;
}

}  // namespace

void ask_dead_guard(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) {
    if (pushes_ever_harder(axis, context.robot->drive)) {
      const AxisFigures* figures = probe.figures(axis);
      if (figures != nullptr && figures->is_reachable && std::isfinite(figures->mass))
        ask_motors(plan, axis, *figures, remarks);
      continue;
    }
    // An integral (`build_up`) reaches the force range in time.
    const bool is_asked = axis.drives_motion() && axis.text != nullptr && !axis.is_soft &&
                          axis.time_constant > 0.0 && !axis.text->build_up;
    const std::optional<Demand> demand = is_asked ? demand_of(axis) : std::nullopt;
    const AxisFigures* figures = demand && demand->b != 0.0 ? probe.figures(axis) : nullptr;
    if (figures == nullptr || !figures->is_reachable || !std::isfinite(figures->mass)) continue;
    if (axis[solver::Quantity::force]) {
      ask_axis(context, plan, axis, *demand, context.robot->drive.mass_factor * figures->mass, remarks);
    } else if (!context.diagnostics.has_errors()) {
      ask_without_range(context, plan, axis, *demand, *figures, remarks);
    }
  }
}

}  // namespace zwang::lang
