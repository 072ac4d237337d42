/// Cholesky's factor of a small symmetric matrix, A = G G', by rows and in place.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "pairs.hpp"

namespace zwang::solver {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Row k of G from row k of A, the ones above being factorised: G_kc = (A_kc - G_k . G_c) / G_cc. Writes all
/// but the diagonal and returns the pivot that is left there, the square of G_kk.
inline double eliminate_row(RowMajorMatrix& A, int k) noexcept {
  double* const row = &A(k, 0);
  double pivot = row[k];
  for (int c = 0; c < k; ++c) {
    row[c] = (row[c] - dot(c, row, &A(c, 0))) / A(c, c);
    pivot -= row[c] * row[c];
  }
  return pivot;
}

/// The leading n x n block; false, and not finished, when a pivot is not above `least_pivot`.
inline bool factorise(RowMajorMatrix& A, int n, double least_pivot) noexcept {
  for (int k = 0; k < n; ++k) {
    const double pivot = eliminate_row(A, k);
    if (!(pivot > least_pivot)) return false;
    A(k, k) = std::sqrt(pivot);
  }
  return true;
}

/// x := G^-1 x
inline void solve_lower(const RowMajorMatrix& G, int n, double* x) noexcept {
  for (int k = 0; k < n; ++k) x[k] = (x[k] - dot(k, &G(k, 0), x)) / G(k, k);
}

/// x := G'^-1 x
inline void solve_upper(const RowMajorMatrix& G, int n, double* x) noexcept {
  for (int k = n - 1; k >= 0; --k) {
    x[k] /= G(k, k);
    add_multiple(k, -x[k], &G(k, 0), x);
  }
}

}  // namespace zwang::solver
