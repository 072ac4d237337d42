/// The tasks that every program has beside its own: the brakes of `done` and `failed`, and the robot's
/// limits.
#pragma once

#include <vector>

#include "zwang/lang/program.hpp"

namespace zwang::runtime {

/// Distance of the footprint's farthest corner from the base's origin, which turns a force at the rim into a
/// torque. [m]
double footprint_radius(const lang::Robot& robot);

/// Whether a frame is the base itself.
bool is_base(const std::vector<lang::FrameDeclaration>& frames, int frame);

/// The base's mass along x, y and rz, wheels and rotors included, where every joint is at 0. [kg, kg, kg m^2]
solver::Vector3 effective_mass_of(const lang::Robot& robot);

/// The index of the frame that is the base itself; it is appended when the program does not have it.
int base_frame(std::vector<lang::FrameDeclaration>& frames, const lang::Robot& robot);

/// Brings the base to rest as the robot file's `stop` allows. Level 1 has the drivers. Level 0 has the stop's
/// deceleration, before which position ranges give way, and the robot's limits.
lang::Task brake_task(const char* name, const lang::Robot& robot, int base);

/// Adds the robot file's limits to a task, as level-0 ranges on the base, where neither the task nor `always`
/// gives any.
void add_limits(lang::Task& task, const lang::Always& always, const lang::Robot& robot, int base,
                const std::vector<lang::FrameDeclaration>& frames);

}  // namespace zwang::runtime
