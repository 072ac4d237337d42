/// Loops over a few neighbouring numbers, two at a time as every x86-64 and arm64 processor can. For the short
/// vectors of the solver they cost less than the set-up of Eigen's loops for vectors of any size.
#pragma once

#include <Eigen/Core>

namespace zwang::solver {

using Pair = Eigen::Map<Eigen::Array2d>;
using ConstPair = Eigen::Map<const Eigen::Array2d>;

/// x = 0, for `count` numbers.
inline void set_zero(int count, double* x) {
  int k = 0;
  for (; k + 2 <= count; k += 2) Pair(x + k).setZero();
  if (k < count) x[k] = 0.0;
}

/// y += s x, for `count` numbers.
inline void add_multiple(int count, double s, const double* x, double* y) {
  int k = 0;
  for (; k + 2 <= count; k += 2) Pair(y + k) += s * ConstPair(x + k);
  if (k < count) y[k] += s * x[k];
}

/// x . y, for `count` numbers.
inline double dot(int count, const double* x, const double* y) {
  Eigen::Array2d sum = Eigen::Array2d::Zero();
  int k = 0;
  for (; k + 2 <= count; k += 2) sum += ConstPair(x + k) * ConstPair(y + k);
  const double rest = k < count ? x[k] * y[k] : 0.0;
  return sum(0) + sum(1) + rest;
}

}  // namespace zwang::solver
