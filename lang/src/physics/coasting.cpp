// W646, too: a motion that one task drives, and the next one leaves to nothing.
//
// A base has no friction of its own but that of its motors. A turn that nothing drives, and nothing stops,
// goes on. With the base's twist (vx, vy, w) a row along n of a point r moves by
//
//   ds = n . (vx - w ry, vy + w rx)          or w, of a row that turns
//
// A motion that moves no row of the next task goes on as fast as the task before drove it. Exits that
// wait for times, ways and places are asked about. One that waits for rest, a force or a signal may lead on
// from a contact that has stopped the base.
#include <algorithm>
#include <cmath>

#include "diagnostic/wordings_never.hpp"
#include "physics/questions.hpp"
#include "zwang/lang/condition_function.hpp"

namespace zwang::lang {

namespace {

using solver::Axis;
using solver::Quantity;

/// Whether the condition may come true while the base drives on.
bool comes_in_motion(const Condition& condition) {
  return std::none_of(condition.nodes.begin(), condition.nodes.end(), [](const ExpressionNode& node) {
    const bool is_place = node.op == Op::coordinate && node.what == CoordinateQuantity::position;
    const bool is_state = node.op == Op::coordinate && !is_place;
    return is_state || node.op == Op::signal || node.op == Op::valid || node.op == Op::output ||
           node.op == Op::estimated_force || node.op == Op::estimated_wrench || calls(node, "speed");
  });
}

/// Whether the base's motion along its own axis moves the row.
bool is_moved(const PlannedAxis& row, Axis motion) {
  constexpr double least = 1e-3;  // of 1, or [m]
  if (row.move.body != 0) return row.in_world;
  if (row.is_feature()) return true;
  if (row.turns()) return row.axis == Axis::rz && motion == Axis::rz;
  const solver::Vector3& r = row.move.pose.position;
  const solver::Vector3 u = motion == Axis::x   ? solver::Vector3::UnitX()
                            : motion == Axis::y ? solver::Vector3::UnitY()
                                                : solver::Vector3(-r.y(), r.x(), 0.0);
  // Nobody knows how the base heads to axes that do not turn with it.
  if (row.in.body != 0 || row.in_world) return row.axis != Axis::z && u.norm() > least;
  return std::abs((row.in.pose.rotation.transpose() * u)(static_cast<int>(row.axis))) > least;
}

/// What the task drives along the axis; nullptr: nothing, or a rest.
const PlannedAxis* driver_along(const PlannedTask& plan, Axis motion) {
  constexpr double least = 0.01;  // [m/s] or [rad/s] slower motion counts as rest at an end, too
  for (const PlannedAxis& driver : plan.axes) {
    const bool is_moving = driver.driver == Quantity::velocity && !driver.is_yield && driver.target &&
                           std::abs(*driver.target) > least;
    const bool is_own = driver.move.body == 0 && !driver.is_feature() &&
                        (driver.turns() || (driver.in.body == 0 && !driver.in_world));
    const bool is_alike = driver.turns() == (motion == Axis::rz);
    if (is_moving && is_own && is_alike && is_moved(driver, motion)) return &driver;
  }
  return nullptr;
}

class CoastingQuestion {
 public:
  CoastingQuestion(const AllTasks& all, Remarks& remarks) : all_(all), remarks_(remarks) {}

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
      const PlannedAxis* driver = driver_along(before, which);
      if (driver == nullptr || !is_left_over(*next, which)) continue;
      remarks_.add(wording::coasts_on(
          target.span, {before.task->name.text, driver->path, *driver->target, driver->turns(), target.text},
          driver->driver_span()));
      return;
    }
  }

  static bool is_left_over(const PlannedTask& plan, Axis motion) {
    return std::none_of(plan.axes.begin(), plan.axes.end(), [motion](const PlannedAxis& row) {
      // A range of velocities says how fast the base may go on.
      const bool speaks = row.driver || (row[Quantity::velocity] && !row.is_norm);
      return speaks && row.text != nullptr && is_moved(row, motion);
    });
  }

  const AllTasks& all_;
  Remarks& remarks_;
};

}  // namespace

void ask_coasting(const CheckContext& context, const PlannedTask& plan, const AllTasks& all,
                  const std::vector<Condition>& conditions, Remarks& remarks) {
  if (context.diagnostics.has_errors()) return;
  CoastingQuestion question(all, remarks);
  for (std::size_t i = 0; i < plan.task->exits.size(); ++i)
    question.ask_exit(plan, plan.task->exits[i].target, &conditions[i]);
  if (plan.task->timeout && !plan.task->timeout->is_never)
    question.ask_exit(plan, plan.task->timeout->target, nullptr);
}

}  // namespace zwang::lang
