// W620: a guard on a distance, `nearest < d`, that fires too late to stop.
//
//   v (for + stale_after + blend/2) + v^2/2a + a T^2/2 <= d - reach
//   v (for + stale_after + blend/2) + v T              <= d - reach     where v < a T
//
//   v      the base's speed limit in a task in which the exit is asked for
//   a, T   the deceleration that the ranges of the task that stands leave, and its time constant; at `done`
//          and `failed` the robot file's `stop`, as far as the motors make it, and no T
//   reach  of the footprint from the base's origin, from where a distance counts. A guard nearer than that
//          counts from the footprint.
//
// Beside the distance a condition may ask for more, as long as a base on its way meets it. That is a speed
// above a limit, a time that has passed, a way moved. A distance feature whose other end hangs on a pose
// signal counts like a signal, and so does the place of the base's origin along an axis that a pose signal
// carries. Both do not if a position is driven: a base arrives where it is driven to.
//
// If two guards read one signal, the wider one fires first. The task that it leads to gives the base's speed.
#include <algorithm>
#include <cmath>

#include "check/cases.hpp"
#include "diagnostic/wordings_never.hpp"
#include "physics/questions.hpp"
#include "zwang/lang/condition_function.hpp"
#include "zwang/solver/base_analysis.hpp"

namespace zwang::lang {

namespace {

using solver::Quantity;

/// How the base comes to rest once the guard is true.
struct Braking {
  double deceleration = solver::infinity;  ///< [m/s^2]
  double time_constant = 0.0;              ///< [s]
  double delay = 0.0;                      ///< [s] before it brakes
};

double way_to_stop(double speed, const Braking& braking) {
  const double a = braking.deceleration, T = braking.time_constant;
  const double braked = speed < a * T ? speed * T : speed * speed / (2.0 * a) + 0.5 * a * T * T;
  return speed * braking.delay + (std::isfinite(a) ? braked : speed * T);
}

/// The largest speed that stops within the way; the way grows with the speed.
double speed_for(double way, const Braking& braking, double most) {
  double low = 0.0, high = most;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (way_to_stop(middle, braking) > way ? high : low) = middle;
  }
  return low;
}

/// The distance that the exit compares, and with what.
struct Guard {
  int signal = -1;         ///< whose age counts
  bool is_signal = false;  ///< the signal itself is the distance; else its pose is measured to
  std::string name;        ///< of what is compared
  double distance = 0.0;   ///< [m]
};

/// True of a base that drives on at `speed`, sooner or later.
bool holds_on_the_way(const Demanded& demanded, double speed) {
  const ExpressionNode& node = *demanded.node;
  const bool has_no_end = std::isinf(demanded.bounds.high);
  switch (node.op) {
    case Op::signal:
    case Op::valid:
      return true;
    case Op::elapsed:
    case Op::of_task:
      return has_no_end;
    case Op::of_frame:
      return has_no_end && (!calls(node, "speed") || demanded.bounds.low < speed);
    default:
      return false;
  }
}

/// From the base to what a pose signal measures.
std::optional<Guard> feature_guard(const CheckContext& context, int index) {
  const FeatureSymbol& symbol = context.symbols.features[static_cast<std::size_t>(index)];
  const Feature& feature = symbol.feature;
  if (symbol.is_bad || feature.kind != FeatureKind::distance) return std::nullopt;
  const int first = context.symbols.signal_of(feature.first),
            second = context.symbols.signal_of(feature.second);
  const bool is_first_measured = first >= 0;
  if (is_first_measured == (second >= 0)) return std::nullopt;
  const Place own = place_of(context, is_first_measured ? feature.second : feature.first);
  const bool is_origin = own.frame.body == 0 && own.frame.pose.position.head<2>().norm() < 1e-9;
  if (!is_origin) return std::nullopt;
  return Guard{is_first_measured ? first : second, false, feature.name, 0.0};
}

/// Of the base's origin along an axis that a pose signal carries. Its place is a distance on the way to 0.
std::optional<Guard> axis_guard(const CheckContext& context, const Demanded& demanded,
                                const std::vector<GroupText>& groups) {
  const ExpressionNode& node = *demanded.node;
  const GroupText& group =
      (node.in_always ? context.file.always_groups : groups)[static_cast<std::size_t>(node.index)];
  const std::string& axis = group.axes[static_cast<std::size_t>(node.axis)].name.text;
  const std::optional<int> move = context.symbols.find_frame(group.move.text),
                           in = context.symbols.find_frame(group.in.text);
  const bool is_place = node.what == CoordinateQuantity::position && group.kind == GroupKind::axes &&
                        (axis == "x" || axis == "y");
  if (!is_place || !move || !in) return std::nullopt;
  const Place own = place_of(context, *move);
  const int signal = context.symbols.signal_of(*in);
  if (signal < 0 || own.frame.body != 0 || !(own.frame.pose.position.head<2>().norm() < 1e-9))
    return std::nullopt;
  const double low = demanded.bounds.low, high = demanded.bounds.high;
  if (!(low < 0.0) || !(high > 0.0)) return std::nullopt;
  return Guard{signal, false, group.name.text + "." + axis + ".position", std::min(-low, high)};
}

/// What the part of a condition compares; `distance` where an end of it is one.
std::optional<Guard> measured_distance(const CheckContext& context, const Demanded& demanded,
                                       const std::vector<GroupText>& groups) {
  const ExpressionNode& node = *demanded.node;
  std::optional<Guard> found;
  if (node.op == Op::coordinate) return axis_guard(context, demanded, groups);
  if (node.op == Op::feature) found = feature_guard(context, node.index);
  if (node.op == Op::signal) {
    const SignalSymbol& symbol = context.symbols.signals[static_cast<std::size_t>(node.index)];
    if (symbol.signal.type == SignalType::number && symbol.dimension == dimension::length)
      found = Guard{node.index, true, symbol.signal.name, 0.0};
  }
  if (!found || !std::isfinite(demanded.bounds.high)) return std::nullopt;
  found->distance = demanded.bounds.high;
  return found;
}

/// nullopt: it is no guard of a distance.
std::optional<Guard> guard_of(const CheckContext& context, const Condition& condition,
                              const std::vector<GroupText>& groups, double speed) {
  const auto cases = cases_of(context, condition, groups);
  if (!cases) return std::nullopt;
  for (const Case& one : *cases) {
    std::optional<Guard> guard;
    bool is_met = true;
    for (const auto& [key, demanded] : one) {
      if (std::optional<Guard> found = measured_distance(context, demanded, groups)) {
        guard = std::move(found);
      } else {
        is_met = is_met && holds_on_the_way(demanded, speed);
      }
    }
    if (guard && is_met && guard->distance > 0.0) return guard;
  }
  return std::nullopt;
}

class StoppingQuestion {
 public:
  StoppingQuestion(const CheckContext& context, const ExitConditions& conditions, Probe& probe,
                   Remarks& remarks)
      : context_(context), conditions_(conditions), probe_(probe), remarks_(remarks) {}

  /// In the task `index`: of its own exits and of those of `always`.
  void ask(const PlannedTask& plan, std::size_t index) {
    const SpeedLimit limit = fastest(plan);
    if (!std::isfinite(limit.most) || !(limit.most > 0.0)) return;
    const std::vector<Guarded> guards = guards_of(plan, index, limit.most);
    for (const Guarded& one : guards) {
      const bool comes_later = std::any_of(guards.begin(), guards.end(), [&](const Guarded& other) {
        return other.guard.signal == one.guard.signal && other.guard.name == one.guard.name &&
               other.guard.distance > one.guard.distance;
      });
      if (!comes_later && one.exit->target.text != plan.task->name.text) compare(one, limit);
    }
  }

 private:
  struct Guarded {
    const ExitText* exit;
    Guard guard;
  };

  std::vector<Guarded> guards_of(const PlannedTask& plan, std::size_t index, double speed) const {
    std::vector<Guarded> guards;
    const bool arrives = std::any_of(plan.axes.begin(), plan.axes.end(), [](const PlannedAxis& axis) {
      return axis.driver == Quantity::position && !axis.turns();
    });
    const auto add = [&](const std::vector<ExitText>& exits, const std::vector<Condition>& conditions,
                         const std::vector<GroupText>& groups) {
      for (std::size_t i = 0; i < exits.size(); ++i) {
        const auto guard = guard_of(context_, conditions[i], groups, speed);
        if (guard && (guard->is_signal || !arrives)) guards.push_back({&exits[i], *guard});
      }
    };
    static const std::vector<GroupText> none;
    add(context_.file.always_exits, conditions_.of_always, none);
    add(plan.task->exits, conditions_.of_tasks[index], plan.task->groups);
    return guards;
  }

  /// Where the task drives the base with known velocities alone, no faster than those.
  SpeedLimit fastest(const PlannedTask& plan) {
    SpeedLimit limit = most_speed(plan, {0, {}}, probe_);
    double squares = 0.0;
    bool is_known = false;
    for (const PlannedAxis& axis : plan.axes) {
      if (!axis.driver || axis.move.body != 0 || axis.turns()) continue;
      if (axis.driver != Quantity::velocity || !axis.target || axis.is_feature()) return limit;
      squares += *axis.target * *axis.target;
      is_known = true;
    }
    if (is_known) limit.most = std::min(limit.most, std::sqrt(squares));
    return limit;
  }

  /// nullopt: the task goes on moving, or nobody knows how it brakes.
  std::optional<Braking> braking_into(const ExitText& exit) {
    const std::string& target = exit.target.text;
    Braking braking;
    if (target == "done" || target == "failed") {
      if (!stop_deceleration_) stop_deceleration_ = stop_deceleration();
      braking.deceleration = *stop_deceleration_;
      return braking;
    }
    const std::optional<int> task = context_.symbols.find_task(target);
    if (!task) return std::nullopt;
    const TaskText& text = context_.file.tasks[static_cast<std::size_t>(*task)];
    const PlannedTask plan = plan_task(context_, text);
    bool stands = false;
    for (const PlannedAxis& axis : plan.axes) {
      if (!axis.driver || axis.move.body != 0 || axis.turns() || axis.is_feature()) continue;
      const bool is_still = axis.stands_still() || (axis.driver == Quantity::position && !axis.target);
      if (!is_still) return std::nullopt;
      const AxisFigures* figures = probe_.figures(axis);
      if (figures == nullptr || !figures->is_reachable || !std::isfinite(figures->mass)) continue;
      stands = true;
      add_axis(plan, axis, figures->least_mass, braking);
    }
    if (!stands) return std::nullopt;
    braking.delay = 0.5 * blend_of(context_, text);
    return braking;
  }

  /// The robot file's, as far as the motors make it ahead and sideways, where the base can go that way. A
  /// drive that takes velocities may have no torque in the model.
  double stop_deceleration() const {
    const Robot& robot = probe_.robot();
    const solver::BaseAnalysis base = solver::analyse_base(robot.model, start_state(robot));
    double least = std::min(robot.stop.deceleration, robot.stop.force / robot.model.total_mass());
    for (const solver::AxisAnalysis& axis : {base.axes[0], base.axes[1]}) {
      if (axis.reachable && axis.largest_force > 0.0)
        least = std::min(least, axis.largest_force / axis.effective_mass);
    }
    return least;
  }

  /// The least of what the ranges along the axis leave, whichever way the base goes. Casters that trail along
  /// the motion weigh least. Behind a drive that feels, forces brake a robot that is `mass_factor` as heavy.
  void add_axis(const PlannedTask& plan, const PlannedAxis& axis, double mass, Braking& braking) {
    double a = std::min(acceleration_limit(plan, axis, 1.0, true).most,
                        acceleration_limit(plan, axis, -1.0, true).most);
    for (const PlannedAxis& other : plan.axes) {
      const auto& force = other[Quantity::force];
      const bool bounds = force && (&other == &axis || (!other.driver && probe_.alignment(axis, other) != 0));
      if (bounds)
        a = std::min(a, std::min(force->high, -force->low) / (mass * probe_.robot().drive.mass_factor));
    }
    braking.deceleration = std::min(braking.deceleration, a);
    braking.time_constant = std::max(braking.time_constant, axis.time_constant);
  }

  void compare(const Guarded& one, const SpeedLimit& limit) {
    std::optional<Braking> braking = braking_into(*one.exit);
    if (!braking) return;
    const auto signal = static_cast<std::size_t>(one.guard.signal);
    const std::optional<ValueText>& stale_after = context_.file.signals[signal].stale_after;
    braking->delay +=
        dwell_of(context_, *one.exit) + (stale_after ? present_value(context_, *stale_after) : 0.0);
    const double outline = reach();
    if (!one.guard.is_signal && one.guard.distance <= outline) return;
    const double reach = one.guard.distance > outline ? outline : 0.0;
    const double way = way_to_stop(limit.most, *braking);
    if (way + reach <= one.guard.distance * (1.0 + 1e-6)) return;
    const double slow_enough = speed_for(one.guard.distance - reach, *braking, limit.most);
    remarks_.add(wording::stops_too_late(
        one.exit->when.span, {one.guard.name, one.guard.distance, limit.most, way, reach, slow_enough},
        limit.path, limit.span));
  }

  double reach() {
    double most = 0.0;
    const bool goes_sideways = probe_.base_mobility() == 3;
    for (const solver::Vector3& corner : probe_.robot().footprint) {
      most = std::max(most, std::abs(corner.x()));
      if (goes_sideways) most = std::max(most, std::abs(corner.y()));
    }
    return most;
  }

  const CheckContext& context_;
  const ExitConditions& conditions_;
  Probe& probe_;
  std::optional<double> stop_deceleration_;  ///< once it was asked for
  Remarks& remarks_;
};

}  // namespace

void ask_stopping(const CheckContext& context, const PlannedTask& plan, const ExitConditions& conditions,
                  std::size_t index, Probe& probe, Remarks& remarks) {
  StoppingQuestion(context, conditions, probe, remarks).ask(plan, index);
}

}  // namespace zwang::lang
