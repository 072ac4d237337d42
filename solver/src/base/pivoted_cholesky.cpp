#include "base/pivoted_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linear/cholesky.hpp"

namespace zwang::solver {

PivotedCholesky::PivotedCholesky(int row_capacity)
    : W_(RowMajorMatrix::Zero(row_capacity + 1, spaced(row_capacity))),
      G_(RowMajorMatrix::Zero(row_capacity, spaced(row_capacity))),
      inverse_D_(Eigen::VectorXd::Zero(row_capacity)),
      gram_(RowMajorMatrix::Zero(row_capacity, row_capacity)),
      size_(Eigen::VectorXd::Zero(row_capacity)),
      left_(Eigen::VectorXd::Zero(row_capacity + 1)),
      inverse_diagonal_(Eigen::VectorXd::Zero(row_capacity)),
      column_(Eigen::VectorXd::Zero(row_capacity + 1)),
      inverse_root_(Eigen::VectorXd::Zero(row_capacity)),
      substitution_(Eigen::VectorXd::Zero(row_capacity)),
      row_at_(static_cast<std::size_t>(row_capacity)) {}

void PivotedCholesky::factorise(double tolerance) noexcept {
  is_in_order_ = factorise_in_order();
  if (is_in_order_) return;
  rank_ = 0;
  for (int i = 0; i < rows_; ++i) {
    left_(i) = W_(i, i);
    inverse_diagonal_(i) = size_(i) > 0.0 ? 1.0 / size_(i) : 0.0;
    row_at_[static_cast<std::size_t>(i)] = i;
  }
  set_zero(rows_, &W_(rows_, 0));
  column_(rows_) = 0.0;
  eliminate(tolerance);
}

/// Row by row, with t = G_i D:
///   t_k = L_ik - sum_c<k t_c G_kc        G_ik = t_k / D_k        D_i = L_ii - sum_k<i t_k G_ik
/// False, and L is unchanged, if the rows before leave too little of one to be sure of the rank.
bool PivotedCholesky::factorise_in_order() noexcept {
  constexpr double ample = 1e-3;
  double* const t = column_.data();
  for (int i = 0; i < rows_; ++i) {
    const double* const L = &W_(i, 0);
    std::copy_n(L, i, t);
    const double left = eliminate_row(G_, inverse_D_, i, L[i], t);
    if (!(left > ample * size_(i))) return false;
    inverse_D_(i) = 1.0 / left;
  }
  rank_ = rows_;
  return true;
}

/// The next line if the columns so far leave an ample share of it; else the one of which they
/// leave the largest, and -1 when none has one.
int PivotedCholesky::next_pivot(double tolerance) const noexcept {
  constexpr double ample = 0.1;
  int pivot = -1;
  double best = tolerance;
  for (int k = rank_; k < rows_; ++k) {
    const double share = left_(k) * inverse_diagonal_(k);
    if (share > best) {
      best = share;
      pivot = k;
    }
    if (k == rank_ && share > ample) return k;
  }
  return pivot;
}

/// Takes the pivots out. Each step takes a column of W and its remainder of L, two lines at a time (there is
/// one to spare):
///   w = L_p / root(L_pp)        L -= w w'
void PivotedCholesky::eliminate(double tolerance) noexcept {
  double* const w = column_.data();
  double* const left = left_.data();
  const Eigen::Index stride = W_.outerStride();
  for (int pivot = next_pivot(tolerance); pivot >= 0; pivot = next_pivot(tolerance)) {
    if (pivot != rank_) exchange(rank_, pivot);
    const int c = rank_++;
    const double root = std::sqrt(left[c]);
    const double inverse_root = root * (1.0 / left[c]);  // the two do not wait for one another
    inverse_root_(c) = inverse_root;
    W_(c, c) = root;
    double* line = &W_(c + 1, c);
    for (int k = c + 1; k < rows_; k += 2) {
      double* const next = line + stride;
      const Eigen::Array2d value = inverse_root * Eigen::Array2d(*line, *next);
      *line = value(0);
      *next = value(1);
      Pair(w + k) = value;
      Pair(left + k) -= value * value;
      line = next + stride;
    }
    add_square(c + 1, rows_, -1.0, w, W_.data(), stride);
  }
}

/// Exchanges two lines and the columns that belong to them in what is left of L; c < k.
void PivotedCholesky::exchange(int c, int k) noexcept {
  std::swap(row_at_[static_cast<std::size_t>(c)], row_at_[static_cast<std::size_t>(k)]);
  std::swap(left_(c), left_(k));
  std::swap(inverse_diagonal_(c), inverse_diagonal_(k));
  for (int i = 0; i < c; ++i) std::swap(W_(c, i), W_(k, i));
  for (int i = c + 1; i < k; ++i) std::swap(W_(i, c), W_(k, i));
  for (int i = k + 1; i < rows_; ++i) std::swap(W_(i, c), W_(i, k));
}

/// By substitution where every row is a pivot, one number after the other: a pair with the y that was stored
/// a moment ago would wait for it.
void PivotedCholesky::solve(const double* rhs, double* nu) noexcept {
  if (is_in_order_) {
    std::copy_n(rhs, rows_, nu);
    substitute(G_, inverse_D_, rows_, nu);
    return;
  }
  if (rank_ < rows_) {
    least_squares(rhs, nu);
    return;
  }
  double* const y = substitution_.data();
  for (int k = 0; k < rank_; ++k) {
    double rest = rhs[row_at(k)];
    for (int c = 0; c < k; ++c) rest -= W_(k, c) * y[c];
    y[k] = rest * inverse_root_(k);
  }
  for (int k = rank_ - 1; k >= 0; --k) {
    const double x = y[k] * inverse_root_(k);
    add_multiple(k, -x, &W_(k, 0), y);
    nu[row_at(k)] = x;
  }
}

/// L is W W' with W of full column rank: its pseudo-inverse is W (W'W)^-2 W'.
void PivotedCholesky::least_squares(const double* rhs, double* nu) noexcept {
  double* const y = substitution_.data();
  for (int k = 0; k < rank_; ++k) {
    set_zero(rank_ - k - 1, &W_(k, k) + 1);
    set_zero(k + 1, &gram_(k, 0));
  }
  set_zero(rank_, y);
  for (int i = 0; i < rows_; ++i) {
    const double* const line = &W_(i, 0);
    for (int k = 0; k < rank_; ++k) add_multiple(k + 1, line[k], line, &gram_(k, 0));
    add_multiple(rank_, rhs[row_at(i)], line, y);
  }
  cholesky(gram_, rank_, 0.0);
  for (int pass = 0; pass < 2; ++pass) {
    solve_lower(gram_, rank_, y);
    solve_upper(gram_, rank_, y);
  }
  for (int i = 0; i < rows_; ++i) nu[row_at(i)] = dot(rank_, &W_(i, 0), y);
}

}  // namespace zwang::solver
