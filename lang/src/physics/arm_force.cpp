// W612: the force limit of a base is not its arm's. If a row moves a frame of the arm against the world, it
// pushes with all joints, the wheels' too. Its own force range is the only bound:
//
//   tau = J' f        J: of the arm's frame, |f| <= its own range, whatever the rows of the base may spend
//
// Between the arm and the base a row presses nothing against the ground. The base's own rows have to bear
// whatever the arm touches there.
#include <algorithm>
#include <set>

#include "diagnostic/wordings_physics.hpp"
#include "physics/questions.hpp"
#include "zwang/solver/wheels.hpp"

namespace zwang::lang {

namespace {

bool limits_force(const PlannedAxis& axis) {
  return axis.driver == solver::Quantity::force || axis[solver::Quantity::force].has_value();
}

bool counts_against_the_world(const PlannedAxis& axis) {
  return axis.in.body < 0 || axis.in.body == axis.move.body;
}

/// Its own range, or one alone on the same axis, which bounds the sum.
bool is_limited(const PlannedAxis& axis, const PlannedTask& plan) {
  return limits_force(axis) || std::any_of(plan.axes.begin(), plan.axes.end(), [&](const PlannedAxis& other) {
           return other[solver::Quantity::force] && !other.driver && other.move.body == axis.move.body &&
                  other.in.body == axis.in.body && other.axis == axis.axis && other.measure == axis.measure &&
                  other.in.pose.rotation.isApprox(axis.in.pose.rotation);
         });
}

std::string group_of(const PlannedAxis& axis) {
  return axis.is_feature() ? axis.path : axis.path.substr(0, axis.path.rfind('.'));
}

}  // namespace

void ask_arm_force(const PlannedTask& plan, const Robot& robot, Remarks& remarks) {
  const auto limited = std::find_if(plan.axes.begin(), plan.axes.end(), [](const PlannedAxis& axis) {
    return axis.move.body == 0 && axis.text != nullptr && !axis.turns() && limits_force(axis);
  });
  if (limited == plan.axes.end()) return;
  std::set<std::string> told;
  for (const PlannedAxis& axis : plan.axes) {
    const bool is_of_arm = axis.move.body > 0 && !solver::carries_wheel(robot.model, axis.move.body);
    if (!is_of_arm || !axis.driver || axis.turns() || !counts_against_the_world(axis)) continue;
    if (is_limited(axis, plan) || !told.insert(group_of(axis)).second) continue;
    remarks.add(wording::arm_without_limit(axis.driver_span(), axis.path, axis.move_name, limited->path,
                                           limited->span(solver::Quantity::force)));
  }
}

}  // namespace zwang::lang
