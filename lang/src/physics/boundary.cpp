// W607: a range of positions, or a region, that asks for more braking force than the motors have. It may also
// ask for a force along an axis on which no motor pushes.
//
// A boundary counts on the deceleration a_brk: the axis's acceleration range, else the robot file's, else its
// `stop`. The axis's force range over the effective mass bounds it. It uses
//
//   braking_share a_brk m        m: the effective mass
#include <algorithm>
#include <array>
#include <cmath>

#include "diagnostic/wordings_physics.hpp"
#include "physics/questions.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::lang {

namespace {

void ask_axis(const PlannedTask& plan, const PlannedAxis& axis, const Span& span, const std::string& what,
              Probe& probe, Remarks& remarks) {
  const AxisFigures* figures = probe.figures(axis);
  if (figures == nullptr || !figures->is_reachable) return;
  double braking = std::min(acceleration_limit(plan, axis, 1.0, true).most,
                            acceleration_limit(plan, axis, -1.0, true).most);
  if (!std::isfinite(braking) && axis.turns()) return;
  if (!std::isfinite(braking)) braking = probe.robot().stop.deceleration;
  for (std::size_t i = 0; i < figures->masses.size(); ++i) {
    const double mass = figures->masses[i];
    const double force = figures->forces[i];
    if (!std::isfinite(mass) || !(force > 0.0)) continue;
    double a = braking;
    if (const auto& range = axis[solver::Quantity::force]) {
      a = std::min(a, std::min(range->high, -range->low) / mass);
    }
    const double used = solver::braking_share * mass;
    if (used * a <= force * (1.0 + 1e-6)) continue;
    remarks.add(wording::boundary_not_held(span, what, axis.turns(), mass, a, force, force / used));
    return;
  }
}

constexpr std::array own_axes = {solver::Axis::x, solver::Axis::y};

PlannedAxis own_axis(solver::Axis axis, const std::string& what, const Robot& robot) {
  PlannedAxis own;
  own.path = what;
  own.move_name = robot.base_frame;
  own.move = own.in = {0, {}};
  own.axis = axis;
  return own;
}

/// An axis that the base slides along and no motor pushes along. If the base stands askew to a boundary, it
/// has to brake along this axis, too.
bool ask_motors(const Robot& robot, const Span& span, const std::string& what, Probe& probe,
                Remarks& remarks) {
  for (const solver::Axis axis : own_axes) {
    const AxisFigures* figures = probe.figures(own_axis(axis, what, robot));
    if (figures == nullptr || figures->is_reachable || figures->is_held) continue;
    remarks.add(wording::boundary_askew(span, what, axis == solver::Axis::x ? "x" : "y"));
    return true;
  }
  return false;
}

/// A region bounds the base in every direction: its own x and y stand for them.
void ask_region(const PlannedTask& plan, const GroupText& group, const Robot& robot, Probe& probe,
                Remarks& remarks) {
  const std::string& what = group.name.text;
  if (ask_motors(robot, group.region.span, what, probe, remarks)) return;
  for (const solver::Axis axis : own_axes)
    ask_axis(plan, own_axis(axis, what, robot), group.region.span, what, probe, remarks);
}

}  // namespace

void ask_boundary(const CheckContext& context, const PlannedTask& plan, Probe& probe, Remarks& remarks) {
  for (const PlannedAxis& axis : plan.axes) {
    if (!axis[solver::Quantity::position] || axis.text == nullptr) continue;
    const Span span = axis.span(solver::Quantity::position);
    if (axis.is_headed_anyhow() && ask_motors(*context.robot, span, axis.path, probe, remarks)) continue;
    ask_axis(plan, axis, span, axis.path, probe, remarks);
  }
  for (const auto* groups : {&context.file.always_groups, &plan.task->groups}) {
    for (const GroupText& group : *groups) {
      const bool is_region = group.kind == GroupKind::inside && group.region.exists();
      if (is_region) ask_region(plan, group, *context.robot, probe, remarks);
    }
  }
}

}  // namespace zwang::lang
