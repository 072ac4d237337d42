// W511: an exit that the ranges in force decide: never true, or true as soon as the task is entered.
//
//   measured                    lies within
//   group.axis.position         the ranges of positions on that axis; in the first task s0 +- v t, too
//   group.axis.velocity         the ranges of velocities on it
//   group.axis.force            0 and the driver's own force, or its force range
//                               and the regions in force
//   speed(frame)                what `speed` and the ranges of the base's axes leave
//   moved(frame)                that speed times the time t until the task ends at the latest
//                               on a straight way no longer than the region in force
//   turned(frame)               the turning speed times the time
//   elapsed, since(own task)    that time
//   entries(task)               1 where no way leads back to it, 0 where none leads from it to this task
//   since(task)                 nothing where no way leads from it to this task
//   an output                   its start, and each value that the file sets it to
//
// A condition that also asks for `elapsed < t` has t in the place of the time.
//
// An exit to `failed` may watch over a range: whoever pushes the base can break it. So positions and speeds
// count for other exits only.
#include <algorithm>
#include <cmath>

#include "check/endings.hpp"
#include "diagnostic/wordings_never.hpp"
#include "diagnostic/wordings_outputs.hpp"
#include "physics/confined.hpp"
#include "physics/questions.hpp"
#include "zwang/lang/condition_function.hpp"

namespace zwang::lang {

namespace {

using solver::Quantity;

/// The known bounds of a measured number, and their reason.
struct Known {
  Bounds bounds;
  std::string by;  ///< path of the range, `timeout`
  Span span;
  bool holds_whatever_pushes = false;
  int output = -1;  ///< whose values they are
  bool is_unknown = false;
};

/// All values to which the file sets an output.
std::vector<const ValueText*> values_set(const CheckContext& context, const std::string& output) {
  std::vector<const ValueText*> values;
  const auto gather = [&](const std::vector<SetText>& sets) {
    for (const SetText& set : sets) {
      if (set.kind == SetKind::output && set.name.text == output) values.push_back(&set.value);
    }
  };
  for (const ExitText& exit : context.file.always_exits) gather(exit.set);
  for (const TaskText& task : context.file.tasks) {
    gather(task.set_on_entry);
    for (const ExitText& exit : task.exits) gather(exit.set);
  }
  return values;
}

Known known_output(const CheckContext& context, int index) {
  const Output& output = context.symbols.outputs[static_cast<std::size_t>(index)].output;
  Known known{{output.start, output.start}, output.name, output.span, true, index};
  for (const ValueText* value : values_set(context, output.name)) {
    const std::optional<bool> truth = truth_of(*value);
    if (!truth && value->kind != ValueKind::quantity) return {};
    const double given = truth ? (*truth ? 1.0 : 0.0) : value->quantity.value;
    known.bounds.low = std::min(known.bounds.low, given);
    known.bounds.high = std::max(known.bounds.high, given);
  }
  return known;
}

class ExitQuestion {
 public:
  ExitQuestion(const CheckContext& context, const PlannedTask& plan, Probe& probe, bool is_first)
      : context_(context),
        plan_(plan),
        probe_(probe),
        is_first_(is_first),
        regions_(confinements(context, plan)) {}

  /// `latest`: when the task ends at the latest. [s]
  void ask(const ExitText& exit, const Condition& condition, const Ending& latest, Remarks& remarks) {
    latest_ = latest;
    if (!(latest.time > 0.0)) {
      remarks.add(wording::never_in_time(exit.when.span, latest.by, latest.span));
      return;
    }
    const auto cases = cases_of(context_, condition, groups());
    if (!cases || remarks.any_at(exit.when.span) || is_decided(context_, condition)) return;
    if (cases->empty()) {
      remarks.add(wording::contradicts_itself(exit.when.span));
      return;
    }
    std::optional<Found> why;
    for (const Case& one : *cases) {
      const std::optional<Found> found = contradicted(one, exit);
      if (!found) return ask_at_once(exit, condition, remarks);
      if (!why) why = found;
    }
    if (why->known.output >= 0) return tell_output(exit, why->known, false, remarks);
    if (why->known.is_unknown)
      return remarks.add(wording::not_entered_yet(exit.when.span, why->what, why->known.by));
    remarks.add(wording::never_true(exit.when.span, why->what, why->known.bounds.low, why->known.bounds.high,
                                    why->unit, why->known.by, why->known.span));
  }

 private:
  struct Found {
    Known known;
    std::string what, unit;
  };

  const std::vector<GroupText>& groups() const {
    static const std::vector<GroupText> none;
    return plan_.task != nullptr ? plan_.task->groups : none;
  }

  /// True at every instant, so that the task is left as soon as it is entered.
  void ask_at_once(const ExitText& exit, const Condition& condition, Remarks& remarks) {
    if (exit.target.text == "failed") return;
    latest_ = {};
    const auto cases = cases_of(context_, condition, groups(), true);
    if (!cases || cases->empty()) return;
    std::optional<Found> why;
    for (const Case& one : *cases) {
      const std::optional<Found> found = contradicted(one, exit);
      if (!found) return;
      why = found;
    }
    if (why->known.output >= 0) return tell_output(exit, why->known, true, remarks);
    remarks.add(wording::always_true(exit.when.span, why->what, why->known.bounds.low, why->known.bounds.high,
                                     why->unit, why->known.by, why->known.span));
  }

  std::optional<Found> contradicted(const Case& demanded, const ExitText& exit) {
    const bool watches = exit.target.text == "failed";
    until_ = latest_.time;
    for (const auto& [key, demand] : demanded) {
      if (demand.node->op == Op::elapsed) until_ = std::min(until_, demand.bounds.high);
    }
    for (const auto& [key, demand] : demanded) {
      const Known known = known_of(*demand.node);
      if (watches && !known.holds_whatever_pushes) continue;
      if (!both(known.bounds, demand.bounds).is_empty()) continue;
      return Found{known, name_of(*demand.node), unit_of(*demand.node)};
    }
    return std::nullopt;
  }

  Known known_of(const ExpressionNode& node) {
    switch (node.op) {
      case Op::elapsed:
        return {{0.0, latest_.time}, latest_.by, latest_.span, true};
      case Op::of_frame:
        if (calls(node, "speed")) return known_speed(node);
        if (calls(node, "turned")) return known_turn(node);
        return calls(node, "moved") ? known_way(node) : Known{};
      case Op::of_task:
        return calls(node, "entries") ? known_entries(node) : known_since(node);
      case Op::coordinate:
        return known_coordinate(node);
      case Op::feature:
        return known_feature(node);
      case Op::output:
        return known_output(context_, node.index);
      default:
        return {};
    }
  }

  Known known_speed(const ExpressionNode& node) {
    const SpeedLimit limit = limit_of(node);
    return {{0.0, limit.most}, limit.path, limit.span};
  }

  Known known_way(const ExpressionNode& node) {
    Known known;
    if (std::isfinite(until_)) {
      const SpeedLimit limit = limit_of(node);
      known = {{0.0, limit.most * until_}, limit.path, limit.span};
    }
    if (!place_of(context_, node.index).is_known || place_of(context_, node.index).frame.body != 0)
      return known;
    for (const Confinement& region : regions_) {
      const double longest = longest_way(region, plan_, probe_, is_first_);
      if (longest < known.bounds.high) known = {{0.0, longest}, region.path, region.span};
    }
    return known;
  }

  Known known_turn(const ExpressionNode& node) {
    const Place place = place_of(context_, node.index);
    if (!std::isfinite(until_) || !place.is_known || place.frame.body != 0) return {};
    const SpeedLimit limit = most_turning(plan_, probe_);
    return {{0.0, limit.most * until_}, limit.path, limit.span};
  }

  Known known_since(const ExpressionNode& node) const {
    const std::string& task = context_.symbols.tasks[static_cast<std::size_t>(node.index)];
    if (is_yet_to_come(task)) return {{solver::infinity, -solver::infinity}, task, {}, true, -1, true};
    const bool is_own = plan_.task != nullptr && plan_.task->name.text == task && !leads_back(context_);
    return is_own ? Known{{0.0, latest_.time}, latest_.by, latest_.span, true} : Known{};
  }

  /// No way leads from it to the task whose exits are looked at.
  bool is_yet_to_come(const std::string& task) const {
    return plan_.task != nullptr && plan_.task->name.text != task && !leads_back(context_) &&
           !is_entered_after(context_, plan_.task->name.text, task);
  }

  Known known_entries(const ExpressionNode& node) const {
    const std::string& task = context_.symbols.tasks[static_cast<std::size_t>(node.index)];
    if (is_yet_to_come(task)) return {{0.0, 0.0}, "a file without a way from it to this task", {}, true};
    if (leads_back(context_) || is_entered_again(context_, task)) return {};
    return {{0.0, 1.0}, "a file without a way back to it", {}, true};
  }

  SpeedLimit limit_of(const ExpressionNode& node) {
    const Place place = place_of(context_, node.index);
    return place.is_known ? most_speed(plan_, place.frame, probe_) : SpeedLimit{};
  }

  const GroupText& group_of(const ExpressionNode& node) const {
    const auto& all = node.in_always ? context_.file.always_groups : groups();
    return all[static_cast<std::size_t>(node.index)];
  }

  const PlannedAxis* axis_of(const ExpressionNode& node) const {
    const AxisText* text = &group_of(node).axes[static_cast<std::size_t>(node.axis)];
    const auto at = std::find_if(plan_.axes.begin(), plan_.axes.end(),
                                 [&](const PlannedAxis& axis) { return axis.text == text; });
    return at != plan_.axes.end() ? &*at : nullptr;
  }

  Known known_coordinate(const ExpressionNode& node) {
    const PlannedAxis* axis = axis_of(node);
    if (axis == nullptr) return {};
    switch (node.what) {
      case CoordinateQuantity::position:
        return known_position(*axis);
      case CoordinateQuantity::velocity:
        return known_velocity(*axis);
      case CoordinateQuantity::force:
        return known_force(*axis);
      default:
        return {};
    }
  }

  Known known_feature(const ExpressionNode& node) {
    const Feature& feature = context_.symbols.features[static_cast<std::size_t>(node.index)].feature;
    for (const PlannedAxis& axis : plan_.axes) {
      if (axis.is_feature() && axis.move_name == feature.name && axis[Quantity::position])
        return known_position(axis);
    }
    return {};
  }

  Known known_position(const PlannedAxis& axis) {
    Known known;
    if (const auto& range = axis[Quantity::position])
      known = {{range->low, range->high}, axis.path, axis.span(Quantity::position)};
    for (const Confinement& region : regions_) {
      const auto left = left_of_position(region, axis, probe_.robot());
      const Bounds rest = left ? both(known.bounds, {left->low, left->high}) : known.bounds;
      if (rest.low > known.bounds.low || rest.high < known.bounds.high)
        known = {rest, region.path, region.span};
    }
    const bool is_measured_from_start = is_first_ && axis.is_placed && !axis.is_set && axis.in_world &&
                                        axis.move.body == 0 && axis.measure == solver::Measure::axis &&
                                        !axis.turns() && std::isfinite(latest_.time);
    if (!is_measured_from_start) return known;
    SpeedLimit limit = most_speed(plan_, axis.move, probe_);
    const double own = plan_.speed_limit(axis);
    if (own < limit.most) limit = {own, axis.path, axis.span(Quantity::velocity)};
    const double from = probe_.position_at_start(axis), way = limit.most * latest_.time;
    const Bounds reached = both(known.bounds, {from - way, from + way});
    if (reached.low > known.bounds.low || reached.high < known.bounds.high)
      known = {reached, limit.path, limit.span};
    return towards_target(axis, from, known);
  }

  /// A driver of position goes from where it starts to its target; a tenth and 2 cm are left for overshoot.
  static Known towards_target(const PlannedAxis& axis, double from, Known known) {
    if (axis.driver != Quantity::position || !axis.target || axis.is_spring || axis.is_soft) return known;
    const double beyond = 0.1 * std::abs(*axis.target - from) + 0.02;
    const Bounds way{std::min(from, *axis.target) - beyond, std::max(from, *axis.target) + beyond};
    const Bounds left = both(known.bounds, way);
    if (left.low > known.bounds.low || left.high < known.bounds.high)
      known = {left, axis.path, axis.driver_span()};
    return known;
  }

  Known known_velocity(const PlannedAxis& axis) {
    Known known;
    for (const PlannedAxis& other : plan_.axes) {
      const auto& range = other[Quantity::velocity];
      if (!range || other.move.body != axis.move.body) continue;
      const int sign = &other == &axis ? 1 : probe_.alignment(axis, other);
      if (sign == 0) continue;
      const Bounds seen = sign > 0 ? Bounds{range->low, range->high} : Bounds{-range->high, -range->low};
      const Bounds left = both(known.bounds, seen);
      if (left.low > known.bounds.low || left.high < known.bounds.high)
        known = {left, other.path, other.span(Quantity::velocity)};
    }
    return known;
  }

  static Known known_force(const PlannedAxis& axis) {
    if (!axis.driver) return {};
    if (axis.driver == Quantity::force) {
      if (!axis.target) return {};
      return {
          {std::min(0.0, *axis.target), std::max(0.0, *axis.target)}, axis.path, axis.driver_span(), true};
    }
    const auto& range = axis[Quantity::force];
    if (!range) return {};
    return {{range->low, range->high}, axis.path, axis.span(Quantity::force), true};
  }

  void tell_output(const ExitText& exit, const Known& known, bool is_true, Remarks& remarks) const {
    const Output& output = context_.symbols.outputs[static_cast<std::size_t>(known.output)].output;
    const bool is_set = !values_set(context_, output.name).empty();
    const std::string example = output.is_number ? ".." : output.start == 0.0 ? "true" : "false";
    remarks.add(wording::output_decides(exit.when.span, {output.name, is_set, example}, is_true, known.span));
  }

  std::string name_of(const ExpressionNode& node) const {
    switch (node.op) {
      case Op::of_task:
        return std::string(function_of(node).name) + "(" +
               context_.symbols.tasks[static_cast<std::size_t>(node.index)] + ")";
      case Op::of_frame:
        return std::string(function_of(node).name) + "(" +
               context_.symbols.frames[static_cast<std::size_t>(node.index)].declaration.name + ")";
      case Op::feature:
        return context_.symbols.features[static_cast<std::size_t>(node.index)].feature.name;
      case Op::coordinate:
        break;
      case Op::output:
        return context_.symbols.outputs[static_cast<std::size_t>(node.index)].output.name;
      default:
        return "elapsed";
    }
    const GroupText& group = group_of(node);
    const bool is_feature = group.kind == GroupKind::feature;
    const char* word = node.what == CoordinateQuantity::position   ? ".position"
                       : node.what == CoordinateQuantity::velocity ? ".velocity"
                                                                   : ".force";
    return group.name.text +
           (is_feature ? "" : "." + group.axes[static_cast<std::size_t>(node.axis)].name.text) + word;
  }

  std::string unit_of(const ExpressionNode& node) const {
    if (node.op == Op::elapsed) return "s";
    if (node.op == Op::of_frame || node.op == Op::of_task) {
      const auto& powers = function_of(node).powers;
      return usual_unit({powers[0], powers[1], powers[2], powers[3]});
    }
    if (node.op == Op::feature)
      return context_.symbols.features[static_cast<std::size_t>(node.index)].feature.turns ? "rad" : "m";
    if (node.op == Op::output) return "";
    const PlannedAxis* axis = axis_of(node);
    const auto which = axis != nullptr && axis->turns() ? solver::Axis::rz : solver::Axis::x;
    const Quantity quantity = node.what == CoordinateQuantity::position   ? Quantity::position
                              : node.what == CoordinateQuantity::velocity ? Quantity::velocity
                                                                          : Quantity::force;
    return usual_unit(dimension_of(which, quantity));
  }

  const CheckContext& context_;
  const PlannedTask& plan_;
  Probe& probe_;
  bool is_first_;
  std::vector<Confinement> regions_;
  Ending latest_;
  double until_ = solver::infinity;  ///< [s] since the task was entered, in the case that is looked at
};

}  // namespace

void ask_exits(const CheckContext& context, const PlannedTask& plan, const std::vector<ExitText>& exits,
               const std::vector<Condition>& conditions, Probe& probe, Remarks& remarks) {
  const bool is_of_task = plan.task != nullptr && &exits == &plan.task->exits;
  const bool is_first = is_of_task && plan.task->name.text == context.file.start.text &&
                        !is_entered_again(context, plan.task->name.text) && !leads_back(context);
  ExitQuestion question(context, plan, probe, is_first);
  for (std::size_t i = 0; i < exits.size(); ++i) {
    if (conditions[i].nodes.empty()) continue;
    const Ending latest = is_of_task ? ending_before(context, *plan.task, conditions, i) : Ending{};
    question.ask(exits[i], conditions[i], latest, remarks);
  }
}

}  // namespace zwang::lang
