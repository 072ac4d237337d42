/// Rows that act along the same axis, and rows with invalid numbers.
#pragma once

#include "linear/pairs.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::solver {

inline bool is_same(const ForceVector& one, const ForceVector& other) {
  return are_same<6>(one.angular.data(), other.angular.data());
}

inline bool has_same_axis(const Row& one, const Row& other) {
  return one.body == other.body && one.reference_body == other.reference_body && is_same(one.a, other.a) &&
         (one.reference_body < 0 || is_same(one.a_reference, other.a_reference));
}

/// All rows of a constraint act along its axis.
inline bool is_of_same_constraint(const Row& one, const Row& other) {
  return one.constraint >= 0 && one.constraint == other.constraint;
}

/// One number to tell axes by: equal for equal ones, and for few others.
inline double key_of(const Row& row) {
  const double* const a = row.a.angular.data();
  const Two sum = two(a) * Two{1.0, 1.1} + two(a + 2) * Two{1.3, 1.7} + two(a + 4) * Two{1.9, 2.3};
  return sum[0] + sum[1];
}

/// Whether its numbers are valid, whatever its axis is.
inline bool has_valid_numbers(const Row& row) {
  const bool is_finite = row.b * 0.0 + row.force * 0.0 == 0.0;
  return is_finite & (row.weight > 0.0) & (row.lo <= 0.0) & (row.hi >= 0.0);  // false for NaN, too
}

}  // namespace zwang::solver
