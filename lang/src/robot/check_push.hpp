/// That motors are no stronger than what a floor can take up.
#pragma once

#include "robot/robot_file.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::lang {

/// The largest force [N] of the wheels of a robot of this mass on any floor.
double floor_holds(double mass);

/// W872: torques that only the URDF states, and that no floor can take up.
void check_push(const RobotFile& file, const Robot& robot, Diagnostics& diagnostics);

}  // namespace zwang::lang
