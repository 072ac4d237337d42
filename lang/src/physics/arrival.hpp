/// How fast the base arrives at what it hits.
#pragma once

#include <vector>

#include "physics/questions.hpp"

namespace zwang::lang {

struct Arrival {
  double speed = 0.0;                   ///< [m/s] 0: nobody knows, or it never arrives
  bool is_bound = false;                ///< it may be slower
  const SceneObject* object = nullptr;  ///< that lies ahead; nullptr: it may be any
};

/// Of an axis that drives the base. `is_first`: the task begins where the scene says.
Arrival arrival_of(const PlannedTask& plan, const PlannedAxis& axis, const AxisFigures& figures,
                   const std::optional<Scene>& scene, bool is_first, Probe& probe);

/// The largest force of the axis's driver against something that stops it: m a, and no more than the motors
/// make. a is that of its target, or the acceleration limit. [N]
double pressed_without_range(const PlannedTask& plan, const PlannedAxis& axis, const AxisFigures& figures);

}  // namespace zwang::lang
