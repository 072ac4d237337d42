/// The capabilities of a base, known before it moves: its mobility and its reachable axes. A further check
/// says whether its motors can make every wrench that a task may ask for.
#pragma once

#include <array>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/solver/constraint.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::solver {

/// One axis of a frame, alone, at one state.
struct AxisAnalysis {
  double kappa = 0.0;      ///< A Mc A' over A M^-1 A': the share of the axis that the ground leaves, 0 to 1
  bool reachable = false;  ///< the ground leaves it and the motors have a force along it
  double effective_mass = 0.0;  ///< 1 / A Mc A' [kg] or [kg m^2]; infinite where the ground holds the axis
  double largest_force =
      0.0;  ///< that the motors can make along it, exactly and with nothing beside it [N] or [N m]
};

/// The capabilities of a base at one state.
struct BaseAnalysis {
  int mobility = 0;         ///< freedoms of base and joints that the ground leaves
  int base_mobility = 0;    ///< of them, motions of the base: 3 for an omnidirectional one
  int motor_rank = 0;       ///< independent directions in which the motors push
  bool exact = false;       ///< the motors make every wrench along the mobility: motor_rank == mobility
  int internal_forces = 0;  ///< motors beyond their rank: directions in which they only squeeze the robot
  int redundant_ground_rows = 0;     ///< ground rows that others already imply
  std::array<AxisAnalysis, 3> axes;  ///< x, y, rz of the base, in its own axes

  /// Rollers at the ground that all point at (or around) the centre: x and y work, but no torque turns the
  /// base, or the wheels cannot hold it. The usual cause is a roller angle read from the top of the wheel,
  /// where it is mirrored.
  bool mirrored_rollers = false;
  /// Wheels whose axes do not meet in one point: the base cannot move until they are steered.
  bool locked = false;
};

/// At the positions of `state`; its velocities and forces do not count. Allocates; not for the control loop.
/// Throws std::invalid_argument on a state that does not fit the model, and on an inertia that cannot be
/// inverted.
ZWANG_EXPORT BaseAnalysis analyse_base(const Model& model, const State& state);

/// The same for whatever a constraint measures between its frames; its statements do not matter. A planar
/// speed has no direction at rest: analyse the directions that it may take. Throws std::invalid_argument,
/// too, if the measure makes no row at this state.
ZWANG_EXPORT AxisAnalysis analyse_axis(const Model& model, const State& state,
                                       const AxisConstraint& constraint);
/// The same for one axis of any frame on the robot.
ZWANG_EXPORT AxisAnalysis analyse_axis(const Model& model, const State& state, const AttachedFrame& move,
                                       const AttachedFrame& in, Axis axis);

}  // namespace zwang::solver
