// W646, too: a motion that one task drives, and the next one leaves to nothing.
//
// A base has no friction of its own but that of its motors. A turn that nothing drives, and nothing stops,
// goes on. The rows of the next task span some motions of the base. Along an axis outside of them it goes on
// as fast as the task before drove it. An exit that waits for rest, for a force or for a signal may lead on
// from a contact that has stopped the base, so only times, ways and places are asked about.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_never.hpp"
#include "physics/questions.hpp"
#include "zwang/lang/condition_function.hpp"

namespace zwang::lang {

namespace {

using solver::Axis;
using solver::Quantity;

PlannedAxis own_axis(Axis axis) {
  PlannedAxis base;
  base.move = base.in = {0, {}};
  base.axis = axis;
  return base;
}

/// Whether the condition may come true while the base drives on.
bool comes_in_motion(const Condition& condition) {
  return std::none_of(condition.nodes.begin(), condition.nodes.end(), [](const ExpressionNode& node) {
    const bool is_place = node.op == Op::coordinate && node.what == CoordinateQuantity::position;
    const bool is_state = node.op == Op::coordinate && !is_place;
    return is_state || node.op == Op::signal || node.op == Op::valid || node.op == Op::output ||
           node.op == Op::estimated_force || node.op == Op::estimated_wrench || calls(node, "speed");
  });
}

/// What the task drives along the axis; nullptr: nothing, or a rest.
const PlannedAxis* driver_along(const PlannedTask& plan, const PlannedAxis& axis, Probe& probe) {
  constexpr double least = 0.01;  // [m/s] or [rad/s] slower motion counts as rest at an end, too
  for (const PlannedAxis& driver : plan.axes) {
    const bool is_moving = driver.driver == Quantity::velocity && !driver.is_yield && driver.target &&
                           std::abs(*driver.target) > least;
    if (!is_moving || driver.move.body != 0 || driver.turns() != axis.turns()) continue;
    if (probe.alignment(axis, driver) != 0) return &driver;
  }
  return nullptr;
}

class CoastingQuestion {
 public:
  CoastingQuestion(const AllTasks& all, Probe& probe, Remarks& remarks)
      : all_(all), probe_(probe), remarks_(remarks) {}

  void ask_exit(const PlannedTask& before, const Word& target, const Condition* condition) {
    if (condition != nullptr && (condition->nodes.empty() || !comes_in_motion(*condition))) return;
    ask_way(before, target);
  }

 private:
  void ask_way(const PlannedTask& before, const Word& target) {
    const auto next = std::find_if(all_.plans.begin(), all_.plans.end(), [&](const PlannedTask& plan) {
      return plan.task->name.text == target.text;
    });
    if (next == all_.plans.end() || next->task == before.task) return;
    for (const Axis which : {Axis::x, Axis::y, Axis::rz}) {
      const PlannedAxis axis = own_axis(which);
      const PlannedAxis* driver = driver_along(before, axis, probe_);
      if (driver == nullptr || !is_left_over(*next, axis)) continue;
      remarks_.add(wording::coasts_on(
          target.span, {before.task->name.text, driver->path, *driver->target, driver->turns(), target.text},
          driver->driver_span()));
      return;
    }
  }

  bool is_left_over(const PlannedTask& plan, const PlannedAxis& axis) {
    const AxisFigures* figures = probe_.figures(axis);
    if (figures == nullptr || !figures->is_reachable) return false;
    std::vector<const PlannedAxis*> rows;
    for (const PlannedAxis& row : plan.axes) {
      // A range of velocities says how fast the base may go on.
      const bool speaks = row.driver || (row[Quantity::velocity] && !row.is_norm);
      if (speaks && row.text != nullptr) rows.push_back(&row);
    }
    const int spanned = rows.empty() ? 0 : probe_.rank(rows);
    rows.push_back(&axis);
    return probe_.rank(rows) > spanned;
  }

  const AllTasks& all_;
  Probe& probe_;
  Remarks& remarks_;
};

}  // namespace

void ask_coasting(const CheckContext& context, const PlannedTask& plan, const AllTasks& all,
                  const std::vector<Condition>& conditions, Probe& probe, Remarks& remarks) {
  if (context.diagnostics.has_errors()) return;
  CoastingQuestion question(all, probe, remarks);
  for (std::size_t i = 0; i < plan.task->exits.size(); ++i)
    question.ask_exit(plan, plan.task->exits[i].target, &conditions[i]);
  if (plan.task->timeout && !plan.task->timeout->is_never)
    question.ask_exit(plan, plan.task->timeout->target, nullptr);
}

}  // namespace zwang::lang
