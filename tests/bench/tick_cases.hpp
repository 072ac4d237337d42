/// The tasks whose ticks are timed: shipped ones, and made ones that grow in one number.
#pragma once

#include <string>
#include <vector>

#include "zwang/lang/program.hpp"

namespace zwang::bench {

lang::Program shipped(const std::string& task, const std::string& robot);

/// A base that drives ahead beside `count` groups of one task, each with ranges along x, y and rz.
lang::Program groups(int count);
/// The same with `count` exits, each with three terms, of which none becomes true.
lang::Program exits(int count);
/// The same inside a star of `count` vertices.
lang::Program star(int count);

/// A file of `count` tasks, each with the groups of one; the first one is active.
lang::Program tasks(int count);
/// A base that drives ahead and turns on `count` wheels: 2 of a differential base, 3 omni wheels, 4 mecanum
/// wheels, or 8 on four casters.
lang::Program wheels(int count);

/// Of a name as the table has it: "hospital", "16 groups", "256 exits", "1000 vertices", "8 wheels".
lang::Program program_of(const std::string& name);

}  // namespace zwang::bench
