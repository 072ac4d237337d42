/// The program on the robot that the runner moves.
#pragma once

#include "zwang/lang/program.hpp"

namespace zwang::runtime {

/// Of a robot that feels, the virtual robot's: its inertias, rotors included, and its motors' limits are
/// Drive::mass_factor times the real ones. Frames, joints and wheels keep their numbers.
lang::Program led_program(const lang::Program& program);

}  // namespace zwang::runtime
