// W511: an `enter.require` that asks for more speed than any task before leaves.
//
//   speed(frame) <= 1.1 (v + w r)      v, w: to which the tasks before drive the base; r: from its origin
//
// A run begins at rest. Times and ways are 0 on entry, and need no model (check_flow.cpp).
#include <algorithm>

#include "diagnostic/wordings_never.hpp"
#include "physics/left_behind.hpp"
#include "physics/measured_number.hpp"
#include "physics/questions.hpp"
#include "zwang/lang/condition_function.hpp"

namespace zwang::lang {

namespace {

/// [m/s] Infinite: nobody knows.
double most_on_entry(const CheckContext& context, const PlannedTask& plan, const AllTasks& all,
                     const ExpressionNode& node, Probe& probe) {
  constexpr double overshoot = 1.1;
  const Place place = place_of(context, node.index);
  if (!place.is_known || place.frame.body != 0) return solver::infinity;
  std::vector<const PlannedTask*> before = tasks_before(context, plan, all.plans);
  if (is_entered_again(context, plan.task->name.text) || leads_back(context)) before.push_back(&plan);
  const double lever = place.frame.pose.position.head<2>().norm();
  const double turning = lever > 0.0 ? lever * speed_left(before, true, probe) : 0.0;
  return overshoot * (speed_left(before, false, probe) + turning);
}

}  // namespace

void ask_requirement(const CheckContext& context, const PlannedTask& plan,
                     const std::optional<Condition>& require, const AllTasks& all, Probe& probe,
                     Remarks& remarks) {
  // To ask each task for those before it takes too long in a large file.
  const bool is_asked = require && !require->nodes.empty() && !all.any && !pushes_the_base(all.scene);
  if (!is_asked || remarks.any_at(plan.task->require->span)) return;
  const auto cases = cases_of(context, *require, plan.task->groups);
  if (!cases || cases->empty()) return;
  std::optional<wording::Kept> why;
  for (const Case& one : *cases) {
    bool is_never = false;
    for (const auto& [key, demanded] : one) {
      if (demanded.node->op != Op::of_frame || !calls(*demanded.node, "speed")) continue;
      const double most = most_on_entry(context, plan, all, *demanded.node, probe);
      if (!(demanded.bounds.low > most)) continue;
      is_never = true;
      why = wording::Kept{name_measured(context, plan, *demanded.node),
                          "m/s",
                          0.0,
                          most,
                          "what the tasks before drive",
                          "",
                          {},
                          solver::infinity};
    }
    if (!is_never) return;
  }
  remarks.add(wording::only_from_outside(plan.task->require->span, *why, false));
}

}  // namespace zwang::lang
