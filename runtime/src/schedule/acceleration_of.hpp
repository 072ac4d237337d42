/// The acceleration of a solution along a row's axis.
#pragma once

#include "zwang/solver/solver.hpp"

namespace zwang::runtime {

/// [m/s^2] or [rad/s^2] `bias`: of the row's coordinate.
inline double acceleration_of(const solver::Row& row, const solver::Solution& solution,
                              double bias) noexcept {
  double a = dot(row.a, solution.acceleration[static_cast<std::size_t>(row.body)]) + bias;
  if (row.reference_body >= 0)
    a -= dot(row.a_reference, solution.acceleration[static_cast<std::size_t>(row.reference_body)]);
  return a;
}

}  // namespace zwang::runtime
