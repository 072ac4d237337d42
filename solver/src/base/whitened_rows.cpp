#include "base/whitened_rows.hpp"

#include <algorithm>
#include <cmath>

#include "base/cholesky.hpp"
#include "pairs.hpp"

namespace zwang::solver {

WhitenedRows::WhitenedRows(int row_capacity)
    : W_(Eigen::MatrixXd::Zero(row_capacity + 1, row_capacity)),
      gram_(RowMajorMatrix::Zero(row_capacity, row_capacity)),
      left_(Eigen::VectorXd::Zero(row_capacity + 1)),
      inverse_diagonal_(Eigen::VectorXd::Zero(row_capacity)),
      inverse_root_(Eigen::VectorXd::Zero(row_capacity)),
      held_(Eigen::VectorXd::Zero(row_capacity)),
      held_acceleration_(Eigen::VectorXd::Zero(row_capacity)),
      substitution_(Eigen::VectorXd::Zero(row_capacity)),
      pivots_(static_cast<std::size_t>(row_capacity)) {}

void WhitenedRows::factorise(const RowMajorMatrix& L, int ground, int joints, int rows,
                             double tolerance) noexcept {
  rows_ = rows;
  rank_ = 0;
  for (int i = 0; i < rows; ++i) {
    left_(i) = L(i, i);
    inverse_diagonal_(i) = L(i, i) > 0.0 ? 1.0 / L(i, i) : 0.0;
  }
  eliminate(L, 0, ground, ground_tolerance);
  ground_rank_ = rank_;
  eliminate(L, ground, ground + joints, tolerance);
}

/// The row of [first, last) of which the columns so far leave the largest share; -1 when none has one.
int WhitenedRows::next_pivot(int first, int last, double tolerance) const noexcept {
  int pivot = -1;
  double best = tolerance;
  for (int i = first; i < last; ++i) {
    const double share = left_(i) * inverse_diagonal_(i);
    if (share > best) {
      best = share;
      pivot = i;
    }
  }
  return pivot;
}

/// A column of W for each pivot:  W_k = (L_kp - sum over earlier columns W_kc W_pc) / root,  and 0 on the
/// rows that were pivots before. Two rows at a time, the last one alone or beside a row of zeros.
void WhitenedRows::eliminate(const RowMajorMatrix& L, int first, int last, double tolerance) noexcept {
  const int first_column = rank_;
  for (;;) {
    const int pivot = next_pivot(first, last, tolerance);
    if (pivot < 0) return;
    double* const column = &W_(0, rank_);
    for (int k = first; k <= pivot; ++k) column[k] = L(pivot, k);
    for (int k = pivot + 1; k < rows_; ++k) column[k] = L(k, pivot);
    column[rows_] = 0.0;
    const double inverse_root = 1.0 / std::sqrt(left_(pivot));
    const double* const pivot_row = &W_(pivot, 0);
    double* const left = left_.data();
    for (int k = first; k < rows_; k += 2) {
      Eigen::Array2d value = ConstPair(column + k);
      const double* earlier = &W_(k, 0);
      for (int c = 0; c < rank_; ++c) value -= pivot_row[c * W_.rows()] * ConstPair(earlier + c * W_.rows());
      value *= inverse_root;
      Pair(column + k) = value;
      Pair(left + k) -= value * value;
    }
    for (int c = first_column; c < rank_; ++c) {
      const int before = pivots_[static_cast<std::size_t>(c)];
      column[before] = left[before] = 0.0;
    }
    left[pivot] = 0.0;
    inverse_root_(rank_) = inverse_root;
    pivots_[static_cast<std::size_t>(rank_++)] = pivot;
  }
}

double WhitenedRows::free_share(int row, const RowMajorMatrix& L) const noexcept {
  return L(row, row) > 0.0 ? motion(row).squaredNorm() / L(row, row) : 0.0;
}

void WhitenedRows::motion_multipliers(const Eigen::VectorXd& rhs, int ground, int rows,
                                      Eigen::VectorXd& nu) noexcept {
  const int r = mobility();
  const int g = ground_rank_;
  if (r < rows - ground) {
    least_squares(rhs, ground, rows, nu);
    return;
  }
  const int* const pivot = pivots_.data() + g;
  const double* const inverse_root = inverse_root_.data() + g;
  double* const y = substitution_.data();
  for (int c = 0; c < r; ++c) {
    double rest = rhs(pivot[c]);
    for (int k = 0; k < c; ++k) rest -= W_(pivot[c], g + k) * y[k];
    y[c] = rest * inverse_root[c];
  }
  for (int c = r - 1; c >= 0; --c) {
    const double* const column = &W_(0, g + c);
    double rest = y[c];
    for (int k = c + 1; k < r; ++k) rest -= column[pivot[k]] * y[k];
    y[c] = rest * inverse_root[c];
    nu(pivot[c]) = y[c];
  }
}

/// The rows' L is B B' with B of full column rank: its pseudo-inverse is B (B'B)^-2 B'.
void WhitenedRows::least_squares(const Eigen::VectorXd& rhs, int ground, int rows,
                                 Eigen::VectorXd& nu) noexcept {
  const int r = mobility();
  const int n = rows - ground;
  const auto B = [this, ground](int column) { return &W_(ground, ground_rank_ + column); };
  double* const y = substitution_.data();
  for (int k = 0; k < r; ++k) {
    for (int c = 0; c <= k; ++c) gram_(k, c) = dot(n, B(k), B(c));
    y[k] = dot(n, B(k), rhs.data() + ground);
  }
  cholesky(gram_, r, 0.0);
  for (int pass = 0; pass < 2; ++pass) {
    solve_lower(gram_, r, y);
    solve_upper(gram_, r, y);
  }
  std::fill_n(nu.data() + ground, n, 0.0);
  for (int k = 0; k < r; ++k) add_multiple(n, y[k], B(k), nu.data() + ground);
}

void WhitenedRows::hold_ground(const Eigen::VectorXd& bias) noexcept {
  held_acceleration_.head(rows_).setZero();
  for (int c = 0; c < ground_rank_; ++c) {
    const int pivot = pivots_[static_cast<std::size_t>(c)];
    held_(c) = (bias(pivot) - held_acceleration_(pivot)) * inverse_root_(c);
    add_multiple(rows_, held_(c), &W_(0, c), held_acceleration_.data());
  }
}

void WhitenedRows::ground_multipliers(const Eigen::VectorXd& forces, int ground, int rows,
                                      Eigen::VectorXd& nu) noexcept {
  for (int c = 0; c < ground_rank_; ++c) {
    substitution_(c) = held_(c) - dot(rows - ground, &W_(ground, c), forces.data() + ground);
  }
  nu.head(ground).setZero();
  for (int c = ground_rank_ - 1; c >= 0; --c) {
    double rest = substitution_(c);
    for (int k = c + 1; k < ground_rank_; ++k) {
      const int later = pivots_[static_cast<std::size_t>(k)];
      rest -= W_(later, c) * nu(later);
    }
    const int pivot = pivots_[static_cast<std::size_t>(c)];
    nu(pivot) = rest * inverse_root_(c);
  }
}

}  // namespace zwang::solver
