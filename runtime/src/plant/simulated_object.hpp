/// One object of the scene inside the simulation: where its numbers are, and what moves it besides contacts.
#pragma once

#include <optional>

#include "caster_friction.hpp"
#include "floor_friction.hpp"
#include "object_geometry.hpp"
#include "object_guide.hpp"
#include "zwang/runtime/mujoco_plant.hpp"

namespace zwang::runtime {

struct SimulatedObject {
  lang::SceneObject described;
  ObjectGeometry geometry;
  int body = 0;
  /// Of its joints x, y, turn in qpos and qvel, or of its guide's one; -1: it is fixed.
  int position = -1, velocity = -1;
  std::optional<FloorFriction> friction;  ///< of one that slides on the floor
  std::optional<CasterFriction> casters;  ///< of one that rolls on it
  std::optional<ObjectGuide> guide;       ///< of one on a hinge or a slide that is not locked
};

/// Where the centre of its body is then. [m]
solver::Vector3 scripted_centre(const SimulatedObject& object, const ScriptedPose& now) noexcept;

/// Puts a scripted object where it is at this time. Its joints are measured from where it was written, along
/// the axes that it had there.
void follow_script(const SimulatedObject& object, double time, double* qpos, double* qvel) noexcept;

/// One with a mass follows no script any more that is over at this time: the floor holds it again.
void let_go(SimulatedObject& object, double time) noexcept;

/// Adds the forces of floor or guide on it; moves its bristles by one step of `period` [s].
void add_resistance(SimulatedObject& object, double period, const double* qpos, const double* qvel,
                    double* force) noexcept;

/// Where the object's `at` is when its body is there.
void place_truth(const SimulatedObject& object, const solver::Vector3& centre,
                 const solver::Matrix3& rotation, ObjectTruth& truth) noexcept;

/// Whether the hook, a point in the world, is near enough to the dock to latch; `truth` is its owner's.
bool is_in_reach(const lang::Dock& dock, const ObjectTruth& truth, const solver::Vector3& hook) noexcept;

}  // namespace zwang::runtime
