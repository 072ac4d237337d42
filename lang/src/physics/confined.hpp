/// Where the regions in force leave the base.
#pragma once

#include "physics/questions.hpp"

namespace zwang::lang {

/// A group `inside` whose region stands in the world and whose frame the base carries.
struct Confinement {
  std::string path;                      ///< "fence", "always.fence"
  Span span;                             ///< of the group's name
  std::vector<solver::Vector3> corners;  ///< of the region, in the world [m]; empty: a circle
  solver::Vector3 centre = solver::Vector3::Zero();
  double radius = 0.0;                              ///< [m] of a circle
  bool moves_footprint = false;                     ///< else `point`
  solver::Vector3 point = solver::Vector3::Zero();  ///< in the base [m]
};

std::vector<Confinement> confinements(const CheckContext& context, const PlannedTask& plan);

/// How far the region goes in the direction, from the world's origin. [m]
double farthest_along(const Confinement& confinement, const solver::Vector3& direction);

/// By so much a point of the base may lie outside; negative: it lies at least as deep inside, however the
/// base is turned. [m]
double most_outside(const Confinement& confinement, const Robot& robot, const solver::Vector3& point);

/// The range [m] that a region leaves of an axis's position. nullopt: the axis moves no point of the base, or
/// does not stand in the world.
std::optional<solver::Range> left_of_position(const Confinement& confinement, const PlannedAxis& axis,
                                              const Robot& robot);

/// The longest path [m] of the base's origin in the region, if the task drives it straight on and never back.
/// Infinite: the base may turn or come back. `is_first`: the task begins at the start pose.
double longest_way(const Confinement& confinement, const PlannedTask& plan, Probe& probe, bool is_first);

}  // namespace zwang::lang
