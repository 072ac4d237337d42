#pragma once

#include "zwang/lang/program.hpp"

namespace zwang::lang {

/// W914: ranges of positions and regions of `always` and of the first task that the robot starts outside of,
/// where the program's scene has it. Frames that hang on a signal are nowhere yet, and not asked.
void check_start_inside(const Program& program, Diagnostics& diagnostics);

}  // namespace zwang::lang
