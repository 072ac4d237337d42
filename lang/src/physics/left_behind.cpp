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

bool is_alike(const PlannedAxis& driver, const PlannedAxis& axis) {
  return driver.move.body == axis.move.body && driver.turns() == axis.turns();
}

/// What the driver leaves along the axis.
void include_motion(Bounds& left, const PlannedAxis& axis, const PlannedAxis& driver, const Bounds& driven,
                    Probe& probe) {
  const int sign = probe.alignment(axis, driver);
  // Two axes of one frame do not share a motion; axes of different frames may, at some heading.
  const bool is_across =
      sign == 0 && driver.in_name == axis.in_name && !driver.is_feature() && !axis.is_feature();
  if (is_across) return;
  include(left, sign >= 0 ? driven.low : -driven.high);
  include(left, sign >= 0 ? driven.high : -driven.low);
  if (sign != 0) return;
  include(left, -driven.low);
  include(left, -driven.high);
}

/// The speed, or of `turning` the rate of turn, to which the task drives the base.
double speed_driven(const PlannedTask& plan, bool turning, Probe& probe) {
  double squares = 0.0;
  for (const PlannedAxis& driver : plan.axes) {
    if (!driver.driver || driver.move.body != 0 || driver.turns() != turning) continue;
    const Bounds driven = velocities_driven(plan, driver, probe);
    squares += std::pow(std::max(-driven.low, driven.high), 2);
  }
  return std::sqrt(squares);
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

std::vector<const PlannedTask*> other_tasks(const PlannedTask& plan, const std::vector<PlannedTask>& all) {
  std::vector<const PlannedTask*> others;
  for (const PlannedTask& other : all) {
    if (plan.task != nullptr && other.task != plan.task) others.push_back(&other);
  }
  return others;
}

Bounds velocities_left(const std::vector<const PlannedTask*>& before, const PlannedAxis& axis, Probe& probe) {
  Bounds left = nothing;
  for (const PlannedTask* plan : before) {
    for (const PlannedAxis& driver : plan->axes) {
      if (driver.driver && is_alike(driver, axis))
        include_motion(left, axis, driver, velocities_driven(*plan, driver, probe), probe);
    }
  }
  return left;
}

Bounds velocities_left(const DrivenByAny& any, const PlannedAxis& axis, Probe& probe) {
  Bounds left = nothing;
  for (const auto& [key, driven] : any.motions) {
    if (is_alike(*driven.axis, axis)) include_motion(left, axis, *driven.axis, driven.velocities, probe);
  }
  return left;
}

double speed_left(const std::vector<const PlannedTask*>& before, bool turning, Probe& probe) {
  double most = 0.0;
  for (const PlannedTask* plan : before) most = std::max(most, speed_driven(*plan, turning, probe));
  return most;
}

DrivenByAny driven_by_any(const std::vector<PlannedTask>& all, Probe& probe) {
  DrivenByAny any;
  for (const PlannedTask& plan : all) {
    any.speed = std::max(any.speed, speed_driven(plan, false, probe));
    any.turning = std::max(any.turning, speed_driven(plan, true, probe));
    for (const PlannedAxis& driver : plan.axes) {
      if (!driver.driver) continue;
      const std::string key = driver.move_name + " in " + driver.in_name + " " +
                              std::to_string(static_cast<int>(driver.axis)) + " " +
                              std::to_string(static_cast<int>(driver.measure));
      DrivenMotion& motion = any.motions.try_emplace(key, DrivenMotion{&driver, nothing}).first->second;
      const Bounds driven = velocities_driven(plan, driver, probe);
      include(motion.velocities, driven.low);
      include(motion.velocities, driven.high);
    }
  }
  return any;
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
