// How fast the base may go at most, by the ranges in force:
//
//   v <= min(speed, sqrt(vx^2 + vy^2))       vx, vy: of the base's own axes, or of the world's
//   v_P <= v + w r                           of a point r beside the base's origin
#include <algorithm>
#include <cmath>

#include "physics/questions.hpp"

namespace zwang::lang {

namespace {

using solver::Axis;
using solver::Quantity;

PlannedAxis axis_of_base(Axis axis, bool in_world) {
  PlannedAxis result;
  result.move = {0, {}};
  result.in = {in_world ? -1 : 0, {}};
  result.in_world = in_world;
  result.axis = axis;
  return result;
}

/// Along one axis of the base's origin, either way; 0 where the base has no motion along its own axis.
SpeedLimit along(const PlannedTask& plan, Axis axis, bool in_world, Probe& probe) {
  const PlannedAxis wanted = axis_of_base(axis, in_world);
  SpeedLimit limit;
  for (const PlannedAxis& other : plan.axes) {
    const auto& range = other[Quantity::velocity];
    if (!range || other.move.body != 0) continue;
    const double most = std::max(range->high, -range->low);
    if (!(most < limit.most) || probe.alignment(wanted, other) == 0) continue;
    limit = {most, other.path, other.span(Quantity::velocity)};
  }
  if (in_world || std::isfinite(limit.most)) return limit;
  const AxisFigures* figures = probe.figures(wanted);
  if (figures != nullptr && !figures->is_reachable) limit.most = 0.0;
  return limit;
}

}  // namespace

SpeedLimit most_turning(const PlannedTask& plan, Probe& probe) {
  return along(plan, Axis::rz, false, probe);
}

SpeedLimit most_speed(const PlannedTask& plan, const solver::AttachedFrame& point, Probe& probe) {
  SpeedLimit limit;
  if (point.body != 0) return limit;
  for (const PlannedSpeed& speed : plan.speeds) {
    if (speed.body == 0 && speed.most < limit.most) limit = {speed.most, speed.path, speed.span};
  }
  for (const bool in_world : {false, true}) {
    const SpeedLimit x = along(plan, Axis::x, in_world, probe), y = along(plan, Axis::y, in_world, probe);
    const double most = std::hypot(x.most, y.most);
    const SpeedLimit& larger = x.most >= y.most ? x : y;
    if (most < limit.most) limit = {most, larger.path, larger.span};
  }
  const double arm = std::hypot(point.pose.position.x(), point.pose.position.y());
  if (arm > 1e-6 && std::isfinite(limit.most)) limit.most += arm * most_turning(plan, probe).most;
  return limit;
}

// An exit of a task that stands still waits for somebody who pushes. So a standing base has no limit.
SpeedLimit speed_of_drivers(const PlannedTask& plan, const solver::AttachedFrame& point, Probe& probe) {
  constexpr double origin = 1e-6;    // [m]
  constexpr double overshoot = 1.1;  // of what a driver asks for
  const auto is_origin = [](const solver::AttachedFrame& frame) {
    return frame.body == 0 && frame.pose.position.head<2>().norm() < origin;
  };
  if (!is_origin(point)) return {};
  SpeedLimit driven;
  double squares = 0.0;
  bool holds_x = false, holds_y = false;
  for (const PlannedAxis& axis : plan.axes) {
    if (!axis.driver || axis.move.body != 0) continue;
    const bool turns_only = axis.turns() && !axis.is_feature() && is_origin(axis.move);
    if (turns_only) continue;
    const bool drives = is_origin(axis.move) && axis.in.body == 0 && !axis.is_feature() && !axis.is_soft &&
                        !axis.is_spring && axis.driver == solver::Quantity::velocity && axis.target &&
                        !axis.build_up && (axis.axis == Axis::x || axis.axis == Axis::y);
    if (!drives) return {};
    (axis.axis == Axis::x ? holds_x : holds_y) = true;
    squares += *axis.target * *axis.target;
    if (*axis.target != 0.0) driven = {0.0, axis.path, axis.driver_span()};
  }
  for (const Axis axis : {Axis::x, Axis::y}) {
    if (axis == Axis::x ? holds_x : holds_y) continue;
    const AxisFigures* figures = probe.figures(axis_of_base(axis, false));
    if (figures == nullptr || figures->is_reachable) return {};
  }
  driven.most = squares > 0.0 ? overshoot * std::sqrt(squares) : solver::infinity;
  return driven;
}

SpeedLimit speed_in_force(const PlannedTask& plan, const solver::AttachedFrame& point, Probe& probe) {
  const SpeedLimit most = most_speed(plan, point, probe), driven = speed_of_drivers(plan, point, probe);
  return driven.most < most.most ? driven : most;
}

}  // namespace zwang::lang
