// A task is entered with the motion that the task before it leaves. What that task drives counts:
//
//   a driver of velocity        its value
//   a driver of anything else   the ranges of velocities in force, either way; without one any speed
#include "physics/left_behind.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::lang {

namespace {

using solver::Quantity;

void include(Bounds& bounds, double value) {
  bounds.low = std::min(bounds.low, value);
  bounds.high = std::max(bounds.high, value);
}

constexpr Bounds nothing{solver::infinity, -solver::infinity};

/// The velocities to which the driver brings its axis.
Bounds velocities_driven(const PlannedTask& plan, const PlannedAxis& driver, Probe& probe) {
  double most = plan.speed_limit(driver);
  const double base =
      driver.turns() ? most_turning(plan, probe).most : most_speed(plan, driver.move, probe).most;
  most = std::min(most, base);
  if (driver.driver != solver::Quantity::velocity || !driver.target) return {-most, most};
  const double asked = std::clamp(*driver.target, -most, most);
  return {std::min(0.0, asked), std::max(0.0, asked)};
}

}  // namespace

std::vector<const PlannedTask*> tasks_before(const CheckContext& context, const PlannedTask& plan,
                                             const std::vector<PlannedTask>& all) {
  std::vector<const PlannedTask*> before;
  if (plan.task == nullptr) return before;
  for (const PlannedTask& other : all) {
    const bool leads_here =
        leads_back(context) || is_entered_after(context, plan.task->name.text, other.task->name.text);
    if (other.task != plan.task && leads_here) before.push_back(&other);
  }
  return before;
}

Bounds velocities_left(const std::vector<const PlannedTask*>& before, const PlannedAxis& axis, Probe& probe) {
  Bounds left = nothing;
  for (const PlannedTask* plan : before) {
    for (const PlannedAxis& driver : plan->axes) {
      const bool is_alike = driver.move.body == axis.move.body && driver.turns() == axis.turns();
      if (!driver.driver || !is_alike) continue;
      const Bounds driven = velocities_driven(*plan, driver, probe);
      const int sign = probe.alignment(axis, driver);
      // Two axes of one frame do not share a motion; axes of different frames may, at some heading.
      const bool is_across =
          sign == 0 && driver.in_name == axis.in_name && !driver.is_feature() && !axis.is_feature();
      if (is_across) continue;
      include(left, sign >= 0 ? driven.low : -driven.high);
      include(left, sign >= 0 ? driven.high : -driven.low);
      if (sign != 0) continue;
      include(left, -driven.low);
      include(left, -driven.high);
    }
  }
  return left;
}

double speed_left(const std::vector<const PlannedTask*>& before, bool turning, Probe& probe) {
  double most = 0.0;
  for (const PlannedTask* plan : before) {
    double squares = 0.0;
    for (const PlannedAxis& driver : plan->axes) {
      if (!driver.driver || driver.move.body != 0 || driver.turns() != turning) continue;
      const Bounds driven = velocities_driven(*plan, driver, probe);
      squares += std::pow(std::max(-driven.low, driven.high), 2);
    }
    most = std::max(most, std::sqrt(squares));
  }
  return most;
}

Bounds positions_left(const std::vector<const PlannedTask*>& before, const PlannedAxis& axis) {
  Bounds left = nothing;
  for (const PlannedTask* plan : before) {
    for (const PlannedAxis& driver : plan->axes) {
      const bool is_same = driver.move_name == axis.move_name && driver.in_name == axis.in_name &&
                           driver.measure == axis.measure && driver.axis == axis.axis;
      if (!is_same || driver.driver != solver::Quantity::position) continue;
      include(left, driver.target.value_or(-solver::infinity));
      include(left, driver.target.value_or(solver::infinity));
    }
  }
  return left;
}

}  // namespace zwang::lang
