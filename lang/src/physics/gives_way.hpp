/// How an object gives way to what strikes it.
#pragma once

#include "physics/ahead.hpp"

namespace zwang::lang {

struct GivesWay {
  double inverse_mass = 0.0;           ///< [1/kg] at the point that is struck; 0: not at all
  double hold = 0.0;                   ///< [N] of dry friction and preload
  double stiffness = 0.0;              ///< [N/m] of its joint's spring
  double free_way = solver::infinity;  ///< [m] to its joint's stop, or to what stands behind it
};

/// Struck at `meeting`, along `forward`.
GivesWay gives_way(const Scene& scene, const SceneObject& object, const Meeting& meeting,
                   const solver::Vector3& forward, double height);
/// Dry friction of the floor under an object that no joint carries. [N]
double held_by_floor(const Scene& scene, const SceneObject& object);

}  // namespace zwang::lang
