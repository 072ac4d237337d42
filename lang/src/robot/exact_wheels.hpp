/// Wheels that nearly stand where the ground's directions depend on each other, put where they do exactly.
///
/// A plain wheel stands at P with its axis along a. So the base's planar twist V = (vx, vy, w) has no motion
/// along a:
///   (a, P x a) . V = 0.
/// Two wheels on one axle say this twice, and the base keeps two motions. A wheel 13 um or 0.05 deg beside
/// the axle says something else, in exact arithmetic: the base could only drive ahead. A drawing is rounded,
/// an axle is not, so the nearest place on one axle is what the drawing means:
///
///   1. An axis that is nearly level, or nearly along x or y of the base, is exactly so. The axis of a swivel
///      is upright.
///   2. Wheels that nearly share an axle on what carries them share it. An axle that nearly meets the axis
///      that steers it meets it. A wheel alone stands right below. Where a motor holds a steering that cannot
///      swing round as a caster does, a tenth of the wheel's radius is near: in exact arithmetic such a wheel
///      would turn the steering, and a steering that is held would hold the base.
///   3. Axles of base and steered wheels that nearly coincide while all joints are at 0 coincide. They run
///      through the base's origin if they nearly do.
///
/// Solver, odometry, guard and plant read one model, so that all of them see the same exact wheels.
#pragma once

#include <vector>

#include "diagnostic/wheel_places.hpp"
#include "robot/robot_file.hpp"
#include "robot/urdf.hpp"
#include "zwang/solver/model.hpp"

namespace zwang::lang {

/// Where a wheel, or what steers it, stands exactly.
struct ExactPlace {
  int body = 0;
  solver::Pose pose_in_parent;  ///< while its joint is at 0
  double distance = 0.0;        ///< [m] from where it is drawn
  double angle = 0.0;           ///< [rad] from how it is drawn

  bool is_told() const { return distance >= told_wheel_offset || angle >= told_axis_angle; }
};

/// The bodies that do not stand exactly; none of a model that is exact up to rounding.
std::vector<ExactPlace> exact_places(const solver::Model& model);

/// Puts the joints of the URDF, of which `drawn` is the model, on their exact places. W812 tells how far
/// that is.
void stand_wheels_exactly(const solver::Model& drawn, const RobotFile& file, Urdf& urdf,
                          Diagnostics& diagnostics);

}  // namespace zwang::lang
