// A number that a condition measures.
//
//   measured                    lies within
//   group.axis.position         the ranges of positions on that axis, and the regions in force; in the
//                               first task s0 +- v t, too, also along a path
//   a distance                  in the first task s0 +- v t, too, and no less than the regions and the
//                               heights of its points leave
//   group.axis.velocity         the ranges of velocities on it, and the speed of velocity drivers
//   group.axis.force            0 and the driver's own force, or its force range; 0 where the axis is free
//   speed(frame)                what `speed` and the ranges of the base's axes leave, and what velocity
//                               drivers give
//   moved(frame)                that speed, or that of velocity drivers, times the time t until the latest
//                               end of the task; on a straight way no longer than the region in force; in
//                               the first task the way to the drivers' places
//   turned(frame)               the turning speed times the time; in the first task the turn to its place
//   elapsed, since(own task)    that time
//   entries(task)               its `attempts`; 1 where no way leads back to it, 0 where none leads from
//                               it to this task
//   since(task)                 nothing where no way leads from it to this task
//   an output                   its start, and each value that the file sets it to
//   a signal of the scene       known_signal.cpp
//
// A condition that also asks for `elapsed < t` has t in the place of the time.
#include "physics/known_number.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/driven_way.hpp"
#include "physics/known_signal.hpp"
#include "physics/left_behind.hpp"
#include "physics/measured_number.hpp"
#include "zwang/lang/condition_function.hpp"

namespace zwang::lang {

namespace {

/// Which parameter an end of the range is; empty: none.
std::string parameter_of(const PlannedAxis& axis, solver::Quantity quantity) {
  if (axis.text == nullptr || !(*axis.text)[quantity]) return "";
  const StatementText& statement = *(*axis.text)[quantity];
  for (const ValueText* end : {&statement.low, &statement.high, &statement.value}) {
    if (end->kind == ValueKind::parameter) return end->name;
  }
  return "";
}

/// A `set` of the file may give the parameter of that quantity another value.
bool may_be_set(const CheckContext& context, const PlannedAxis& axis, solver::Quantity quantity) {
  const std::string parameter = parameter_of(axis, quantity);
  return !parameter.empty() && is_set_later(context, parameter);
}

}  // namespace

KnownNumbers::KnownNumbers(const CheckContext& context, const PlannedTask& plan, const AllTasks& all,
                           Probe& probe)
    : context_(context),
      plan_(plan),
      probe_(probe),
      all_(all),
      is_start_(plan.task == nullptr || plan.task->name.text == context.file.start.text),
      is_first_(plan.task != nullptr && is_start_ && !is_entered_again(context, plan.task->name.text) &&
                !leads_back(context)),
      regions_(confinements(context, plan)) {}

void KnownNumbers::set_time(const Ending& latest, double until) {
  latest_ = latest;
  until_ = until;
}

/// The tasks from which a way leads to this one. Asked once.
const std::vector<const PlannedTask*>& KnownNumbers::before() {
  if (!before_)
    before_ = all_.any ? other_tasks(plan_, all_.plans) : tasks_before(context_, plan_, all_.plans);
  return *before_;
}

bool KnownNumbers::is_entered_with(const ExpressionNode& node, const Bounds& demanded, const Known& known) {
  // Each axis is compared with all that is driven: of very many nothing is claimed, so that a check ends
  // soon.
  constexpr std::size_t most_motions = 64;
  if (plan_.task != nullptr && all_.any && all_.any->motions.size() > most_motions) return true;
  const auto meets = [&](const Bounds& left) { return !both(left, demanded).is_empty(); };
  if (node.op == Op::of_frame) {
    const bool turning = calls(node, "turned");
    const double left =
        all_.any ? (turning ? all_.any->turning : all_.any->speed) : speed_left(before(), turning, probe_);
    // A base that is faster at first goes farther, too.
    return calls(node, "speed") ? meets({left, left}) : left > known.speed;
  }
  const PlannedAxis* axis =
      node.op == Op::feature ? feature_axis(node) : axis_measured(context_, plan_, node);
  if (axis == nullptr) return false;
  const bool is_velocity = node.op == Op::coordinate && node.what == CoordinateQuantity::velocity;
  // A run begins at rest.
  if (is_velocity && is_start_ && meets({std::min(0.0, known.bounds.low), std::max(0.0, known.bounds.high)}))
    return true;
  if (!is_velocity) return meets(positions_left(before(), *axis));
  return meets(all_.any ? velocities_left(*all_.any, *axis, probe_)
                        : velocities_left(before(), *axis, probe_));
}

Known KnownNumbers::of(const ExpressionNode& node) {
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
    case Op::signal:
      return known_signal(context_.symbols.signals[static_cast<std::size_t>(node.index)].signal.name,
                          all_.scene, probe_.robot());
    default:
      return {};
  }
}

Known KnownNumbers::known_speed(const ExpressionNode& node) {
  const SpeedLimit limit = limit_of(node);
  Known known{{0.0, limit.most}, limit.path, limit.span};
  known.speed = limit.most;
  return known;
}

Known KnownNumbers::known_way(const ExpressionNode& node) {
  Known known;
  if (std::isfinite(until_)) {
    const SpeedLimit limit = limit_of(node);
    known = {{0.0, limit.most * until_}, limit.path, limit.span};
    known.speed = limit.most;
    known.time = until_;
  }
  if (!place_of(context_, node.index).is_known || place_of(context_, node.index).frame.body != 0)
    return known;
  for (const Confinement& region : regions_) {
    const double longest = longest_way(region, plan_, probe_, is_first_);
    if (longest < known.bounds.high) known = {{0.0, longest}, region.path, region.span};
  }
  if (is_first_) limit_to(known, way_to_places(plan_, place_of(context_, node.index).frame, probe_));
  return known;
}

void KnownNumbers::limit_to(Known& known, const std::optional<DrivenWay>& way) const {
  if (!way || !(way->most < known.bounds.high)) return;
  if (may_be_set(context_, *way->by, *way->by->driver)) return;
  known = {{0.0, way->most}, way->by->path, way->by->driver_span()};
}

Known KnownNumbers::known_turn(const ExpressionNode& node) {
  const Place place = place_of(context_, node.index);
  if (!place.is_known || place.frame.body != 0) return {};
  Known known;
  if (std::isfinite(until_)) {
    const SpeedLimit limit = most_turning(plan_, probe_);
    known = {{0.0, limit.most * until_}, limit.path, limit.span};
    known.speed = limit.most;
    known.time = until_;
  }
  if (is_first_) limit_to(known, turn_to_places(plan_, probe_));
  return known;
}

Known KnownNumbers::known_since(const ExpressionNode& node) const {
  const std::string& task = context_.symbols.tasks[static_cast<std::size_t>(node.index)];
  if (is_yet_to_come(task)) return {{solver::infinity, -solver::infinity}, task, {}, true, -1, true};
  const bool is_own = plan_.task != nullptr && plan_.task->name.text == task && !leads_back(context_);
  return is_own ? Known{{0.0, latest_.time}, latest_.by, latest_.span, true} : Known{};
}

/// No way leads from it to the task whose exits are looked at.
bool KnownNumbers::is_yet_to_come(const std::string& task) const {
  return plan_.task != nullptr && plan_.task->name.text != task && !leads_back(context_) &&
         !is_entered_after(context_, plan_.task->name.text, task);
}

Known KnownNumbers::known_entries(const ExpressionNode& node) const {
  const std::string& task = context_.symbols.tasks[static_cast<std::size_t>(node.index)];
  if (is_yet_to_come(task)) return {{0.0, 0.0}, "a file without a way from it to this task", {}, true};
  if (!leads_back(context_) && !is_entered_again(context_, task))
    return {{0.0, 1.0}, "a file without a way back to it", {}, true};
  for (const TaskText& one : context_.file.tasks) {
    if (one.name.text == task && one.attempts)
      return {
          {0.0, static_cast<double>(one.attempts->most)}, "`attempts` of " + task, one.attempts->span, true};
  }
  return {};
}

SpeedLimit KnownNumbers::limit_of(const ExpressionNode& node) {
  const Place place = place_of(context_, node.index);
  return place.is_known ? speed_in_force(plan_, place.frame, probe_) : SpeedLimit{};
}

Known KnownNumbers::known_coordinate(const ExpressionNode& node) {
  const AxisText& text = group_measured(context_, plan_, node).axes[static_cast<std::size_t>(node.axis)];
  if (text.is_free && node.what == CoordinateQuantity::force)
    return {{0.0, 0.0}, "an axis that is `free`", text.name.span, true};
  const PlannedAxis* axis = axis_measured(context_, plan_, node);
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

const PlannedAxis* KnownNumbers::feature_axis(const ExpressionNode& node) const {
  const Feature& feature = context_.symbols.features[static_cast<std::size_t>(node.index)].feature;
  const auto at = std::find_if(plan_.axes.begin(), plan_.axes.end(), [&](const PlannedAxis& axis) {
    return axis.is_feature() && axis.move_name == feature.name &&
           (axis[solver::Quantity::position] || axis.driver == solver::Quantity::position);
  });
  return at != plan_.axes.end() ? &*at : nullptr;
}

Known KnownNumbers::known_feature(const ExpressionNode& node) {
  if (const PlannedAxis* axis = feature_axis(node)) return known_position(*axis);
  const std::optional<PlannedAxis> axis = plan_feature(context_, node.index);
  const bool is_asked = axis && axis->is_open() && axis->is_placed && !axis->is_set && axis->move.body == 0;
  if (!is_asked) return {};
  const Known beside = known_beside_regions(*axis);
  const double height = probe_.kept_height(*axis);
  if (std::isfinite(beside.bounds.low) && beside.bounds.low > height) return beside;
  const Known above{{height, solver::infinity}, "the height between its two points", {}, true};
  if (!is_first_ || !std::isfinite(until_)) return height > 0.0 ? above : Known{};
  const SpeedLimit limit = speed_in_force(plan_, axis->move, probe_);
  const double from = probe_.position_at_start(*axis), way = limit.most * until_;
  Known known{{from - way, from + way}, limit.path, limit.span};
  known.time = until_;
  return height > std::max(0.0, known.bounds.low) ? above : known;
}

/// A distance from a point of the base to a point outside of a region. The 72 directions stand for all.
Known KnownNumbers::known_beside_regions(const PlannedAxis& axis) const {
  constexpr int directions = 72;
  const solver::Vector3& target = axis.in.pose.position;
  const double from = is_start_ ? probe_.position_at_start(axis) : solver::infinity;
  Known known;
  for (const Confinement& region : regions_) {
    const double outside = most_outside(region, probe_.robot(), axis.move.pose.position);
    double least = 0.0;
    for (int i = 0; i < directions; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / directions;
      const solver::Vector3 along(std::cos(angle), std::sin(angle), 0.0);
      least = std::max(least, target.dot(along) - farthest_along(region, along) - outside);
    }
    if (least > known.bounds.low && least > 1e-6 && from >= least)
      known = {{least, solver::infinity}, region.path, region.span};
  }
  known.is_entered_anywhere = !is_first_;
  return known;
}

/// The range of the quantity; nullopt where a `set` of the file may widen it.
std::optional<solver::Range> KnownNumbers::range_of(const PlannedAxis& axis,
                                                    solver::Quantity quantity) const {
  return may_be_set(context_, axis, quantity) ? std::nullopt : axis[quantity];
}

Known KnownNumbers::known_position(const PlannedAxis& axis) {
  Known known;
  if (!axis.is_placed) return known;  // what measures the frame moves it, too
  if (const auto range = range_of(axis, solver::Quantity::position)) {
    known = {{range->low, range->high}, axis.path, axis.span(solver::Quantity::position)};
    known.parameter = parameter_of(axis, solver::Quantity::position);
  }
  known.is_entered_anywhere = plan_.task != nullptr && !is_first_;
  for (const Confinement& region : regions_) {
    const auto left = left_of_position(region, axis, probe_.robot());
    const Bounds rest = left ? both(known.bounds, {left->low, left->high}) : known.bounds;
    if (rest.low > known.bounds.low || rest.high < known.bounds.high)
      known = {rest, region.path, region.span};
    known.is_entered_anywhere = plan_.task != nullptr && !is_first_;
  }
  const bool starts_here = is_start_ && !axis.is_set;
  const std::optional<double> start = axis.is_on_path && !axis.is_feature()
                                          ? start_along_path(context_, plan_, axis, probe_)
                                          : std::optional(starts_here ? probe_.position_at_start(axis) : 0.0);
  if (!starts_here || !start) return known;
  const Bounds ranged = known.bounds;
  const double from = *start;
  // From outside it goes back into the range, through all that lies between.
  if (std::isfinite(known.bounds.low)) known.bounds.low = std::min(known.bounds.low, from);
  if (std::isfinite(known.bounds.high)) known.bounds.high = std::max(known.bounds.high, from);
  const bool is_measured_from_start = is_first_ && axis.in_world && axis.move.body == 0 &&
                                      axis.measure == solver::Measure::axis && !axis.turns() &&
                                      std::isfinite(latest_.time);
  const bool is_distance = is_first_ && axis.is_open() && axis.move.body == 0;
  if (is_distance) return towards_target(axis, from, known);
  if (!is_measured_from_start) return known;
  SpeedLimit limit = most_speed(plan_, axis.move, probe_);
  const double own = plan_.speed_limit(axis);
  if (own < limit.most) limit = {own, axis.path, axis.span(solver::Quantity::velocity)};
  const double way = (axis.is_on_path ? arc_by_way : 1.0) * limit.most * latest_.time;
  const Bounds reached = both(known.bounds, {from - way, from + way});
  if (reached.low > known.bounds.low || reached.high < known.bounds.high)
    known = {reached, limit.path, limit.span};
  // One end of a range would be named in the place of the other one.
  const bool has_range = std::isfinite(ranged.low) || std::isfinite(ranged.high);
  return has_range && axis.driver == solver::Quantity::velocity ? known : towards_target(axis, from, known);
}

/// A driver of position goes from where it starts to its target; a tenth and 2 cm are left for overshoot. A
/// driver of velocity goes one way, by v t; a wall may throw the base back by v T.
Known KnownNumbers::towards_target(const PlannedAxis& axis, double from, Known known) const {
  const bool goes = axis.driver == solver::Quantity::position ||
                    (axis.driver == solver::Quantity::velocity && !axis.stands_still());
  if (!goes || !axis.target || axis.is_spring || axis.is_soft) return known;
  if (may_be_set(context_, axis, *axis.driver)) return known;
  constexpr double least = 0.02, part = 0.1;  // [m], of the way
  Bounds way;
  if (axis.driver == solver::Quantity::position) {
    const double beyond = part * std::abs(*axis.target - from) + least;
    way = {std::min(from, *axis.target) - beyond, std::max(from, *axis.target) + beyond};
  } else {
    const double back = (1.0 + part) * std::abs(*axis.target) * axis.time_constant + least;
    const double ahead = (1.0 + 2.0 * part) * std::abs(*axis.target) * latest_.time + least;
    way = *axis.target > 0.0 ? Bounds{from - back, from + ahead} : Bounds{from - ahead, from + back};
  }
  const Bounds left = both(known.bounds, way);
  if (left.low > known.bounds.low || left.high < known.bounds.high)
    known = {left, axis.path, axis.driver_span()};
  return known;
}

Known KnownNumbers::known_velocity(const PlannedAxis& axis) {
  Known known;
  for (const PlannedAxis& other : plan_.axes) {
    const auto range = range_of(other, solver::Quantity::velocity);
    if (!range || other.move.body != axis.move.body) continue;
    const int sign = &other == &axis ? 1 : probe_.alignment(axis, other);
    if (sign == 0) continue;
    const Bounds seen = sign > 0 ? Bounds{range->low, range->high} : Bounds{-range->high, -range->low};
    const Bounds left = both(known.bounds, seen);
    if (!(left.low > known.bounds.low || left.high < known.bounds.high)) continue;
    known = {left, other.path, other.span(solver::Quantity::velocity)};
    known.parameter = parameter_of(other, solver::Quantity::velocity);
  }
  // A wall throws a base back no faster than it came.
  const bool is_planar =
      !axis.turns() && !axis.is_feature() && (axis.axis == solver::Axis::x || axis.axis == solver::Axis::y);
  if (!is_planar || axis.move.body != 0) return known;
  const SpeedLimit driven = speed_of_drivers(plan_, axis.move, probe_);
  const Bounds left = both(known.bounds, {-driven.most, driven.most});
  if (left.low > known.bounds.low || left.high < known.bounds.high) known = {left, driven.path, driven.span};
  return known;
}

Known KnownNumbers::known_force(const PlannedAxis& axis) const {
  if (!axis.driver) return {};
  const std::string parameter = parameter_of(axis, solver::Quantity::force);
  if (!parameter.empty() && is_set_later(context_, parameter)) return {};
  Known known;
  if (axis.driver == solver::Quantity::force) {
    if (!axis.target) return {};
    known = {{std::min(0.0, *axis.target), std::max(0.0, *axis.target)}, axis.path, axis.driver_span(), true};
  } else if (const auto& range = axis[solver::Quantity::force]) {
    known = {{range->low, range->high}, axis.path, axis.span(solver::Quantity::force), true};
  }
  known.parameter = parameter;
  return known;
}

}  // namespace zwang::lang
