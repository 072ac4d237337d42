/// How fast a base can go by what its wheels' motors can turn: the URDF's <limit velocity>.
#pragma once

#include "zwang/lang/robot.hpp"

namespace zwang::lang {

/// The wheels' bound on a motion of the base.
struct WheelSpeed {
  double most = solver::infinity;  ///< [m/s] or [rad/s] of the base; infinite where nobody says
  int joint = -1;                  ///< of the wheel that is at its limit first
};

/// Along `linear` or about `turn` in the base's own axes: a unit vector in the plane, or 1 with no `linear`.
/// Nothing is known (infinite) where fixed wheels hold the motion.
WheelSpeed wheel_speed(const Robot& robot, const solver::Vector3& linear, double turn);
/// Along one of the base's own axes x, y, rz.
WheelSpeed wheel_speed_along(const Robot& robot, solver::Axis axis);
/// In the direction in which the base is fastest: what it can reach whatever way it heads.
WheelSpeed wheel_speed_at_best(const Robot& robot);
/// The force [N] or moment [N m] with which the dry friction of wheels holds a base that stands, along
/// `linear` or about `turn` as above. Wheels on swivels and free wheels add nothing.
double dry_friction_along(const Robot& robot, const solver::Vector3& linear, double turn);
/// W611 of the robot file's own limits.
void check_speed_limits(const Robot& robot, Diagnostics& diagnostics);

}  // namespace zwang::lang
