#include "physics/physics.hpp"

#include <algorithm>
#include <stdexcept>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_physics.hpp"
#include "physics/left_behind.hpp"
#include "physics/statics.hpp"

namespace zwang::lang {

namespace {

bool is_same_axis(const PlannedAxis& a, const PlannedAxis& b) {
  const auto is_same = [](const solver::AttachedFrame& f, const solver::AttachedFrame& g) {
    return f.body == g.body && f.pose.rotation.isApprox(g.pose.rotation) &&
           (f.pose.position - g.pose.position).norm() < 1e-9;
  };
  return a.is_on_path == b.is_on_path && a.measure == b.measure && a.axis == b.axis &&
         a.other_axis == b.other_axis && a.coefficients == b.coefficients && is_same(a.move, b.move) &&
         is_same(a.in, b.in);
}

/// A range on an axis of the base also bounds what frames on the base may do, however they are turned.
bool bounds(const PlannedAxis& limit, const PlannedAxis& axis) {
  if (is_same_axis(limit, axis)) return true;
  if (limit.is_feature()) return false;
  const bool is_other_axis = !axis.is_feature() && axis.in.body == limit.in.body && axis.axis != limit.axis &&
                             axis.in.pose.rotation.isApprox(limit.in.pose.rotation);
  return limit.move.body == 0 && axis.move.body == 0 && limit.in.body == 0 && limit.turns() == axis.turns() &&
         !is_other_axis;
}

}  // namespace

AccelerationLimit acceleration_limit(const PlannedTask& plan, const PlannedAxis& axis, double sign,
                                     bool own) {
  AccelerationLimit limit;
  for (const PlannedAxis& other : plan.axes) {
    const std::optional<solver::Range>& range = other[solver::Quantity::acceleration];
    if (!range || !bounds(other, axis) || (&other == &axis && !own)) continue;
    const double most = sign > 0.0 ? range->high : -range->low;
    if (most < limit.most) limit = {most, &other};
  }
  return limit;
}

ForceLimit sum_limit(const PlannedTask& plan, const PlannedAxis& axis, double sign) {
  ForceLimit limit;
  for (const PlannedAxis& other : plan.axes) {
    const std::optional<solver::Range>& range = other[solver::Quantity::force];
    if (!range || other.driver || other.level > axis.level || &other == &axis || !bounds(other, axis))
      continue;
    const double most = sign > 0.0 ? range->high : -range->low;
    if (most < limit.most) limit = {most, &other};
  }
  return limit;
}

namespace {

/// The inputs of the questions that are the same in all tasks.
struct Asked {
  const std::optional<Scene>& scene;
  const ExitConditions& conditions;
  const AllTasks& all;
  std::vector<int> held_steerings;
};

/// Questions about the file as it is written, before any axis is taken out of the plan. No guesses on top of
/// errors: what could not be read may be what decides.
void ask_exits_of_task(const CheckContext& context, std::size_t index, const PlannedTask& plan,
                       const Asked& asked, Probe& probe, Remarks& remarks) {
  if (context.diagnostics.has_errors()) return;
  ask_contradiction(context, plan, probe, remarks);
  ask_exits(context, plan, plan.task->exits, asked.conditions.of_tasks[index], asked.all, probe, remarks);
  ask_requirement(context, plan, asked.conditions.on_entry[index], asked.all, probe, remarks);
  ask_stopping(context, plan, asked.conditions, index, probe, remarks);
}

void ask_task(const CheckContext& context, std::size_t index, const Asked& asked, Probe& probe,
              Remarks& remarks) {
  PlannedTask plan = asked.all.plans[index];
  const bool is_start = plan.task->name.text == context.file.start.text;
  ask_exits_of_task(context, index, plan, asked, probe, remarks);
  ask_reach(plan, probe, remarks);
  ask_travel(plan, *context.robot, asked.scene, remarks);
  ask_steering(context, plan, asked.held_steerings, probe, remarks);
  ask_hopping(context, plan, asked.conditions, asked.all, probe, remarks);
  ask_square(context, plan, asked.conditions.of_tasks[index], asked.held_steerings, asked.scene, is_start,
             probe, remarks);
  ask_turned_slowly(context, plan, asked.conditions.of_tasks[index], probe, remarks);
  ask_freedoms(plan, probe, remarks);
  ask_askew(plan, probe, remarks);
  ask_free(plan, probe, remarks);
  ask_still(context, plan, probe, remarks);
  ask_distance(plan, probe, remarks);
  ask_left_over(context, plan, probe, remarks);
  ask_coasting(context, plan, asked.all, asked.conditions.of_tasks[index], remarks);
  ask_top_speed(plan, *context.robot, probe, remarks);
  ask_plane(plan, probe, remarks);
  ask_path(context, plan, probe, remarks);
  ask_arm_force(plan, *context.robot, remarks);
  ask_press(plan, probe, remarks);
  ask_springs(plan, probe, remarks);
  ask_dead_guard(context, plan, probe, remarks);
  ask_time_constant(plan, probe, remarks);
  ask_yields(context, plan, asked.scene, probe, remarks);
  ask_dead_band(context, plan, probe, remarks);
  ask_swinging(context, plan, probe, remarks);
  ask_yield_axes(context, plan, probe, remarks);
  ask_wheel_torque(plan, probe, remarks);
  ask_friction(context, plan, probe, remarks);
  ask_boundary(context, plan, probe, remarks);
  ask_tipping(plan, asked.scene, probe, remarks);
  ask_traction(plan, asked.scene, probe, remarks);
  if (!context.with_notes) return;
  ask_trailing(context, plan, remarks);
  ask_heading(context, plan, probe, remarks);
  ask_hit(plan, asked.scene, is_start, probe, remarks);
  ask_force_budget(plan, probe, remarks);
}

}  // namespace

void check_physics(CheckContext& context, const std::optional<Scene>& scene, const ExitConditions& conditions,
                   double& budget) {
  if (!context.robot) return;
  try {
    Probe probe(*context.robot, scene, budget);
    Remarks remarks(context.diagnostics);
    AllTasks all{{}, scene};
    for (const TaskText& task : context.file.tasks) all.plans.push_back(plan_task(context, task));
    // To ask each pair of tasks whether a way leads from one to the other takes too long in a large file.
    constexpr std::size_t most_asked_alone = 32;
    if (all.plans.size() > most_asked_alone) all.any = driven_by_any(all.plans, probe);
    const Asked asked{scene, conditions, all, held_steerings(context, context.robot->model)};
    if (!context.diagnostics.has_errors())
      ask_exits(context, plan_always(context), context.file.always_exits, conditions.of_always, all, probe,
                remarks);
    ask_stop(context.file.robot.span, probe, remarks);
    ask_grip_of_stop(context.file.robot.span, scene, probe, remarks);
    for (std::size_t i = 0; i < context.file.tasks.size(); ++i) {
      const TaskText& task = context.file.tasks[i];
      if (!probe.is_exhausted()) ask_task(context, i, asked, probe, remarks);
      if (!probe.is_exhausted()) continue;
      context.diagnostics.add(wording::unasked(task.name.span, task.name.text));
      return;
    }
  } catch (const std::invalid_argument& error) {
    // The builder of the model took it, the sweeps cannot: nothing about motion can be said of this robot.
    context.diagnostics.add(wording::impossible_model(context.file.robot.span, error.what()));
  }
}

}  // namespace zwang::lang
