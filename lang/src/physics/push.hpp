/// The push of a task, and the levers by which a wall turns the base.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "physics/planned_axis.hpp"
#include "physics/probe.hpp"

namespace zwang::lang {

/// The axis that presses the base ahead or sideways, and its largest force.
struct Push {
  const PlannedAxis* axis = nullptr;  ///< nullptr: nothing does
  double force = 0.0;                 ///< [N]
};
Push push_of(const PlannedTask& plan, Probe& probe);

/// The footprint's corners about the axle, where wheels hold the base sideways, else about the base's origin.
/// They are turned so that the push goes along +x. [m]
std::vector<Eigen::Vector2d> outline_along(const Push& push, Probe& probe);
/// A place in the base, likewise. [m]
Eigen::Vector2d along_push(const solver::Vector3& place, const Push& push, Probe& probe);

/// Beside the line of the push through the base's origin, the farthest corner of the footprint. [m]
double longest_lever(const Push& push, Probe& probe);
/// The lever [m] of the corner that touches a wall first, if the base comes `askew` [rad] to the wall. It is
/// the shorter one of both sides.
double lever_askew(const Push& push, double askew, Probe& probe);

}  // namespace zwang::lang
