// W649: a driver that is too weak for the dry friction of the wheels to move the base from rest.
//
//   F_held = sum over the driven wheels of g c_j |dq_j/ds|     s: along the axis, without another motion
//
//   c   Coulomb friction of the wheel's joint
//   g   1. Where `presliding` is known, motors that stand make up for `compensate`: 1 - compensate
//
// A task that starts the run begins at rest. Along axes of the world the heading is any one, and the least
// F_held counts. Wheels on swivels are left out: what holds them depends on where they point.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnostic/wordings_friction.hpp"
#include "physics/statics.hpp"
#include "robot/wheel_speed.hpp"

namespace zwang::lang {

namespace {

/// [N] or [N m]
double held_along(const PlannedAxis& axis, const Robot& robot) {
  const bool is_x = axis.axis == solver::Axis::x;
  if (axis.turns()) return dry_friction_along(robot, solver::Vector3::Zero(), 1.0);
  if (axis.in.body == 0) return dry_friction_along(robot, axis.in.pose.rotation.col(is_x ? 0 : 1), 0.0);
  constexpr int directions = 72;
  double least = solver::infinity;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / directions;
    least = std::min(least, dry_friction_along(robot, {std::cos(angle), std::sin(angle), 0.0}, 0.0));
  }
  return least;
}

/// Of the base's own origin: another point moves by a turn, too.
bool is_of_origin(const PlannedAxis& axis) {
  return axis.move.body == 0 && !axis.is_feature() && axis.in.body <= 0 &&
         (axis.turns() ||
          (axis.move.pose.position.head<2>().norm() < 1e-6 && axis.axis != solver::Axis::z)) &&
         axis.axis != solver::Axis::rx && axis.axis != solver::Axis::ry;
}

}  // namespace

void ask_friction(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  const bool is_first = plan.task != nullptr && plan.task->name.text == context.file.start.text;
  if (!is_first || context.robot->drive.takes_velocity) return;
  for (const PlannedAxis& axis : plan.axes) {
    // A driver with `build_up` pushes ever harder.
    const bool asks = axis.driver && axis.driver != solver::Quantity::position && axis.target &&
                      *axis.target != 0.0 && axis.text != nullptr && !axis.is_soft && !axis.is_yield &&
                      !axis.build_up && axis.time_constant > 0.0 && is_of_origin(axis);
    const AxisFigures* figures = asks ? probe.figures(axis) : nullptr;
    if (figures == nullptr || !figures->is_reachable || !std::isfinite(figures->mass)) continue;
    const double force = asked_force(plan, axis, figures->mass), held = held_along(axis, probe.robot());
    if (!(force < held) || !std::isfinite(held)) continue;
    const bool is_velocity = axis.driver == solver::Quantity::velocity;
    const double T = is_velocity ? figures->mass * std::abs(*axis.target) / held : 0.0;
    remarks.add(wording::held_by_friction(axis.driver_span(), {axis.path, axis.turns(), force, held, T}));
  }
}

}  // namespace zwang::lang
