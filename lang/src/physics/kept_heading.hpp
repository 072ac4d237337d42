/// Of a base that keeps the heading of its start.
#pragma once

#include "physics/planned_axis.hpp"
#include "physics/probe.hpp"

namespace zwang::lang {

/// Of two planar axes of the base in the task that starts the run: 1 where they point the same way at the
/// heading that the task keeps, -1 where opposite, else 0.
int aligned_at_start(const PlannedTask& plan, const PlannedAxis& axis, const PlannedAxis& other,
                     const Probe& probe);

}  // namespace zwang::lang
