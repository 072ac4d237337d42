/// How fast the base arrives at what it hits, and what presses on behind it.
#pragma once

#include <optional>

#include "physics/ahead.hpp"
#include "physics/driven_hit.hpp"
#include "physics/questions.hpp"

namespace zwang::lang {

struct Arrival {
  double speed = 0.0;                      ///< [m/s] 0: nobody knows, or it never arrives
  bool is_bound = false;                   ///< it may be slower
  std::optional<solver::Vector3> forward;  ///< in the world, if the task begins where the scene says
  bool turns = false;                      ///< other drivers may turn the base on its way
  bool is_straight = false;                ///< nothing else moves the base, so `ahead` is what it meets
  Ahead ahead;
  std::optional<double> left;  ///< [m] of a position driver: from where it touches to its target
};

/// Of an axis that drives the base. `is_first`: the task begins where the scene says.
Arrival arrival_of(const PlannedTask& plan, const PlannedAxis& axis, const AxisFigures& figures,
                   const std::optional<Scene>& scene, bool is_first, Probe& probe);

/// The force of the axis's driver against something that stops it, no more than `bound`, if above 0.
DriverPush driver_push_of(const PlannedTask& plan, const PlannedAxis& axis, const AxisFigures& figures,
                          const Arrival& arrival, double bound, const Drive& drive);

}  // namespace zwang::lang
