// Steps 1 to 3 of the tick: the snapshot, what of it is stale, and what conditions may ask about.
#include <cmath>

#include "schedule/parts.hpp"

namespace zwang::runtime {

void Scheduler::Parts::sense(const Sensed& sensed) noexcept {
  state = &sensed.state;
  now = sensed.time;
  transition.reset();
  frames.update(model, sensed.state);
  signals.update(sensed, parameters, frames);
}

/// A frame on a pose signal is somewhere only while the signal is known.
bool Scheduler::Parts::is_known(int frame) const noexcept {
  const int signal = frames.signal_of(frame);
  return signal < 0 || signals.known(signal);
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
    case lang::Op::speed:
      return of_frame(node.index, frames.speed(node.index));
    case lang::Op::moved:
      return of_frame(node.index, frames.moved(node.index));
    case lang::Op::signal:
      return {signals.value(node.index), signals.stale(node.index)};
    case lang::Op::valid:
      return {signals.known(node.index) ? 1.0 : 0.0};
    case lang::Op::coordinate:
      return coordinate(node, owner);
    default:
      return {};
  }
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
  const solver::Coordinate c = coordinate_of(g, g.axes[static_cast<std::size_t>(node.axis)], a);
  return of_frame(g.in, node.what == lang::CoordinateQuantity::position ? c.position : c.velocity);
}

solver::Coordinate Scheduler::Parts::coordinate_of(const lang::Group& group, const lang::AxisStatements& axis,
                                                   const ActiveAxis* active_axis) const noexcept {
  return solver::coordinate_of(frames.attached(group.move), axes_frame(group, active_axis), axis.axis, model,
                               *state);
}

const ActiveAxis* Scheduler::Parts::find(const Origin& origin) const noexcept {
  for (const ActiveAxis& a : axes) {
    if (a.origin.task == origin.task && a.origin.group == origin.group && a.origin.axis == origin.axis) {
      return &a;
    }
  }
  return nullptr;
}

}  // namespace zwang::runtime
