// Step 5 of the tick: the snapshot, what of it is stale, and what conditions may ask about.
#include <cmath>
#include <utility>

#include "schedule/parts.hpp"
#include "zwang/lang/feature_measure.hpp"

namespace zwang::runtime {

void Scheduler::Parts::sense(const Sensed& sensed) noexcept {
  state = &sensed.state;
  now = sensed.time;
  transition.reset();
  excursion.reset();
  frames.update(model, sensed.state, period);
  signals.update(sensed, parameters, frames);
  if (task < 0) return;
  for (const int owner : {tasks.always(), task}) follow_paths(owner, false);
}

/// A frame on a pose signal is somewhere only while the signal is known.
bool Scheduler::Parts::is_known(int frame) const noexcept {
  const int signal = frames.signal_of(frame);
  return signal < 0 || signals.known(signal);
}

/// Before the first sample a frame on a pose signal is nowhere, and its axes point nowhere.
bool Scheduler::Parts::was_seen(int frame) const noexcept {
  const int signal = frames.signal_of(frame);
  return signal < 0 || signals.received(signal);
}

Fact Scheduler::Parts::of_frame(int frame, double value) const noexcept {
  if (is_known(frame)) return {value, false};
  return {std::nan(""), signals.stale(frames.signal_of(frame))};
}

Fact Scheduler::Parts::look_up(const lang::ExpressionNode& node, int owner) const noexcept {
  switch (node.op) {
    case lang::Op::parameter:
      return {parameters[static_cast<std::size_t>(node.index)]};
    case lang::Op::elapsed:
      // A task that is not entered yet asks in its `require`.
      return {owner == task || owner == tasks.always() ? elapsed() : 0.0};
    case lang::Op::of_frame:
      return of_frame(node.index, frames.measured(node));
    case lang::Op::of_task:
      return {lang::function_of(node).count(entries_of(node.index))};
    case lang::Op::signal:
      if (node.axis >= 0)
        return {signals.part(node.index, static_cast<lang::WrenchPart>(node.axis)),
                signals.stale(node.index)};
      return {signals.value(node.index), signals.stale(node.index)};
    case lang::Op::output:
      return {outputs[static_cast<std::size_t>(node.index)]};
    case lang::Op::valid:
      return {signals.known(node.index) ? 1.0 : 0.0};
    case lang::Op::estimated_force:
      return {estimated_force(node.axis)};
    case lang::Op::estimated_wrench:
      return {wrenches.part(node.index, static_cast<lang::WrenchPart>(node.axis))};
    case lang::Op::coordinate:
      return coordinate(node, owner);
    case lang::Op::feature:
      return feature(features[static_cast<std::size_t>(node.index)]);
    default:
      return {};
  }
}

lang::TaskEntries Scheduler::Parts::entries_of(int of_task) const noexcept {
  const auto i = static_cast<std::size_t>(of_task);
  lang::TaskEntries of{entries[i], std::nullopt};
  if (of.count > 0) of.since_last = now - entered_last[i];
  return of;
}

Fact Scheduler::Parts::coordinate(const lang::ExpressionNode& node, int owner) const noexcept {
  const Origin origin{node.in_always ? tasks.always() : owner, node.index, node.axis};
  const ActiveAxis* a = find(origin);
  switch (node.what) {
    case lang::CoordinateQuantity::force:
      return {a != nullptr ? a->reading.force : std::nan("")};
    case lang::CoordinateQuantity::residual:
      return {a != nullptr ? a->reading.residual : std::nan("")};
    case lang::CoordinateQuantity::saturated:
      return {a != nullptr ? (a->reading.saturated ? 1.0 : 0.0) : std::nan("")};
    case lang::CoordinateQuantity::position:
    case lang::CoordinateQuantity::velocity:
      break;
  }
  const lang::Group& g = group(origin);
  const lang::AxisStatements& axis = g.axes[static_cast<std::size_t>(node.axis)];
  if (!is_known(g.move)) return of_frame(g.move, 0.0);
  if (is_off_path(g)) return of_frame(g.in, std::nan(""));
  if (node.what == lang::CoordinateQuantity::velocity)
    return of_frame(g.in, coordinate_of(g, axis, a).velocity);
  return of_frame(g.in, position_of(g, axis, a));
}

Fact Scheduler::Parts::feature(const lang::Feature& feature) const noexcept {
  for (const int frame : {feature.first, feature.second}) {
    if (!is_known(frame)) return of_frame(frame, 0.0);
  }
  solver::AxisConstraint c;
  c.move = frames.attached(feature.first);
  c.in = frames.attached(feature.second);
  lang::set_measure(c, feature);
  return {solver::coordinate_of(c, frames.motions()).position};
}

/// The axis's measure and its frames, without the rest of its constraint.
solver::AxisConstraint Scheduler::Parts::measured(const lang::Group& group, const lang::AxisStatements& axis,
                                                  const ActiveAxis* active_axis) const noexcept {
  solver::AxisConstraint c;
  c.move = frames.attached(group.move);
  c.in = axes_frame(group, active_axis);
  c.axis = axis.axis;
  if (axis.is_planar) c.measure = solver::Measure::speed;
  if (group.path >= 0) measure_along(group, c);
  if (group.kind == lang::GroupKind::feature) {
    const lang::Feature& feature = features[static_cast<std::size_t>(group.feature)];
    lang::set_measure(c, feature);
    // The frames may stand in the other order here.
    if (feature.kind == lang::FeatureKind::angle && group.move != feature.first) {
      std::swap(c.axis, c.other_axis);
    }
  }
  return c;
}

solver::Coordinate Scheduler::Parts::coordinate_of(const lang::Group& group, const lang::AxisStatements& axis,
                                                   const ActiveAxis* active_axis) const noexcept {
  return solver::coordinate_of(measured(group, axis, active_axis), frames.motions());
}

double Scheduler::Parts::position_of(const lang::Group& group, const lang::AxisStatements& axis,
                                     const ActiveAxis* active_axis) const noexcept {
  const bool is_one_axis = group.kind != lang::GroupKind::feature && group.path < 0 && !axis.is_planar;
  if (!is_one_axis) return coordinate_of(group, axis, active_axis).position;
  return solver::position_of(frames.attached(group.move), axes_frame(group, active_axis), axis.axis,
                             frames.motions());
}

const ActiveAxis* Scheduler::Parts::find(const Origin& origin) const noexcept {
  const bool in_always = origin.task == tasks.always();
  if (axes.empty() || !(in_always || origin.task == task)) return nullptr;
  const std::vector<std::size_t>& first = first_axis_of[static_cast<std::size_t>(origin.task)];
  const auto group = static_cast<std::size_t>(origin.group);
  if (group >= first.size()) return nullptr;
  const std::size_t i = (in_always ? 0 : always_axes) + first[group] + static_cast<std::size_t>(origin.axis);
  return i < axes.size() && axes[i].origin.group == origin.group ? &axes[i] : nullptr;
}

ActiveAxis* Scheduler::Parts::find(const Origin& origin) noexcept {
  return const_cast<ActiveAxis*>(std::as_const(*this).find(origin));
}

}  // namespace zwang::runtime
