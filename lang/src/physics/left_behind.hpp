/// The motion that the tasks before a task may leave to it.
#pragma once

#include <vector>

#include "physics/questions.hpp"

namespace zwang::lang {

/// The tasks from which a way leads to the plan's task, itself left out. Empty for `always`.
std::vector<const PlannedTask*> tasks_before(const CheckContext& context, const PlannedTask& plan,
                                             const std::vector<PlannedTask>& all);

/// All but the plan's own: no fewer than those before it.
std::vector<const PlannedTask*> other_tasks(const PlannedTask& plan, const std::vector<PlannedTask>& all);

/// Velocities to which one of the tasks drives a motion that the axis is, or is a part of.
Bounds velocities_left(const std::vector<const PlannedTask*>& before, const PlannedAxis& axis, Probe& probe);
Bounds velocities_left(const DrivenByAny& any, const PlannedAxis& axis, Probe& probe);
DrivenByAny driven_by_any(const std::vector<PlannedTask>& all, Probe& probe);
/// The speed, or of `turning` the rate of turn, to which one of the tasks drives the base; 0 where none does.
double speed_left(const std::vector<const PlannedTask*>& before, bool turning, Probe& probe);
/// Positions to which one of the tasks drives the same axis.
Bounds positions_left(const std::vector<const PlannedTask*>& before, const PlannedAxis& axis);

}  // namespace zwang::lang
