/// Cholesky's factor of a small symmetric matrix, A = G G', by rows and in place.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "linear/pairs.hpp"

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
inline bool cholesky(RowMajorMatrix& A, int n, double least_pivot) noexcept {
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

/// A = G D G' without roots, G with ones on its diagonal, which are not written. Row k of G from `t`, which
/// holds row k of A and then that of G D, the ones above being factorised. Returns what is left of `pivot`,
/// A_kk.
inline double eliminate_row(RowMajorMatrix& G, const Eigen::VectorXd& inverse_D, int k, double pivot,
                            double* t) noexcept {
  double* const row = &G(k, 0);
  for (int c = 0; c < k; ++c) {
    const double* const other = &G(c, 0);
    double rest = t[c];
    for (int e = 0; e < c; ++e) rest -= t[e] * other[e];
    t[c] = rest;
    row[c] = rest * inverse_D(c);
    pivot -= rest * row[c];
  }
  return pivot;
}

/// x := (G D G')^-1 x. One number after the other: a pair with one that was stored a moment ago would wait.
inline void substitute(const RowMajorMatrix& G, const Eigen::VectorXd& inverse_D, int n, double* x) noexcept {
  for (int k = 1; k < n; ++k) {
    const double* const row = &G(k, 0);
    double rest = x[k];
    for (int c = 0; c < k; ++c) rest -= row[c] * x[c];
    x[k] = rest;
  }
  for (int k = 0; k < n; ++k) x[k] *= inverse_D(k);
  for (int k = n - 1; k > 0; --k) {
    const double* const row = &G(k, 0);
    const double own = x[k];
    for (int c = 0; c < k; ++c) x[c] -= row[c] * own;
  }
}

}  // namespace zwang::solver
