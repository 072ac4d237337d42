/// The gravity of a robot that has no model yet.
#pragma once

namespace zwang::lang {

inline constexpr double gravity = 9.81;  ///< [m/s^2] as a solver::Model has it

}  // namespace zwang::lang
