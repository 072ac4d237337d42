/// Numbers that most tests use.
#pragma once

#include <numbers>

#include "zwang/runtime/runner.hpp"  // first: an enumerator `period` behind the constant would shadow it, says GCC

namespace zwang::runtime {

inline constexpr double ms = 1e-3;          ///< [s]
inline constexpr double period = 1.0 * ms;  ///< of the control, in a test that is not about it
inline constexpr double degree = std::numbers::pi / 180.0;  ///< [rad]

}  // namespace zwang::runtime
