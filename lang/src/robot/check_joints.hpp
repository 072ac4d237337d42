/// Joints that a robot file takes for what the URDF says they are not.
#pragma once

#include "robot/robot_file.hpp"
#include "robot/urdf.hpp"

namespace zwang::lang {

/// E861, W862: a <mimic> couples a joint to another one, which zwang does not.
void check_couplings(const RobotFile& file, const Urdf& urdf, Diagnostics& diagnostics);
/// E861: joints that are `coupled`, and that the floor does not keep in step.
void check_steps(const RobotFile& file, const Urdf& urdf, const Robot& robot, Diagnostics& diagnostics);
/// E809: a joint that the posture does not name starts at 0, outside of its travel.
void check_starts(const RobotFile& file, const Urdf& urdf, Diagnostics& diagnostics);
/// E802, E810: wheels whose axis points up, wheels behind joints that do not steer them, and wheels that do
/// not end at one height.
void check_wheels_stand(const RobotFile& file, const Urdf& urdf, const Robot& robot,
                        Diagnostics& diagnostics);
/// W809, W874: an arm's joint that starts close to an end of its travel, or whose motor cannot hold it.
void check_arms(const RobotFile& file, const Robot& robot, Diagnostics& diagnostics);
/// W868: rollers that are mirrored.
void check_rollers(const RobotFile& file, const Robot& robot, Diagnostics& diagnostics);
/// W877: wheels right below a free swivel, which nothing turns.
void check_trails(const RobotFile& file, const Robot& robot, Diagnostics& diagnostics);
/// W869: wheels that turn across their own cylinder.
void check_wheel_shapes(const RobotFile& file, const Urdf& urdf, Diagnostics& diagnostics);
/// W870: that a wheel, and what swivels it, turn as their mass can. URDFs that only draw a robot have 1 kg
/// m^2 everywhere. W875: that its centre of mass lies on its axle.
void check_wheel_inertias(const RobotFile& file, const Robot& robot, Diagnostics& diagnostics);

}  // namespace zwang::lang
