#include "base/whitened_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/cholesky.hpp"
#include "pairs.hpp"

namespace zwang::solver {

namespace {

/// y_k = (rhs(k) - sum over c < k of G_kc y_c) / G_kk for the pivots' lower triangle at `first`, one by one:
/// a pair with the y that was stored a moment ago would wait for it.
template <class Rhs>
void substitute(const RowMajorMatrix& W, int first, int count, const double* inverse_root, Rhs rhs,
                double* y) noexcept {
  for (int k = 0; k < count; ++k) {
    const double* const line = &W(first + k, first);
    double rest = rhs(k);
    for (int c = 0; c < k; ++c) rest -= line[c] * y[c];
    y[k] = rest * inverse_root[k];
  }
}

/// x := G'^-1 (y), y := 0 on the way, for the pivots' lower triangle at `first` with the diagonal's inverse
/// at hand; `take(k, x_k)` from the last to the first.
template <class Take>
void substitute_back(const RowMajorMatrix& W, int first, int count, const double* inverse_root, double* y,
                     Take take) noexcept {
  for (int k = count - 1; k >= 0; --k) {
    const double x = y[k] * inverse_root[k];
    add_multiple(k, -x, &W(first + k, first), y);
    take(k, x);
  }
}

}  // namespace

WhitenedRows::WhitenedRows(int row_capacity)
    : W_(RowMajorMatrix::Zero(row_capacity + 1, spaced(row_capacity))),
      gram_(RowMajorMatrix::Zero(row_capacity, row_capacity)),
      left_(Eigen::VectorXd::Zero(row_capacity + 1)),
      inverse_diagonal_(Eigen::VectorXd::Zero(row_capacity)),
      column_(Eigen::VectorXd::Zero(row_capacity + 1)),
      inverse_root_(Eigen::VectorXd::Zero(row_capacity)),
      held_(Eigen::VectorXd::Zero(row_capacity)),
      held_acceleration_(Eigen::VectorXd::Zero(row_capacity)),
      substitution_(Eigen::VectorXd::Zero(row_capacity)),
      line_of_(static_cast<std::size_t>(row_capacity)),
      row_at_(static_cast<std::size_t>(row_capacity)) {}

void WhitenedRows::factorise(const RowMajorMatrix& L, int ground, int joints, int rows,
                             double tolerance) noexcept {
  rows_ = rows;
  rank_ = 0;
  for (int i = 0; i < rows; ++i) {
    copy(i, &L(i, 0), &W_(i, 0));
    left_(i) = L(i, i);
    inverse_diagonal_(i) = L(i, i) > 0.0 ? 1.0 / L(i, i) : 0.0;
    row_at_[static_cast<std::size_t>(i)] = i;
  }
  set_zero(rows, &W_(rows, 0));
  column_(rows) = 0.0;
  const int candidates = ground + joints;
  eliminate(ground, candidates, ground_tolerance);
  ground_rank_ = rank_;
  for (int k = rank_; k < ground; ++k) inverse_diagonal_(k) = 0.0;
  eliminate(candidates, candidates, tolerance);
  for (int k = ground_rank_; k < rank_; ++k) set_zero(rank_ - k - 1, &W_(k, k) + 1);
  for (int k = 0; k < rows; ++k) line_of_[static_cast<std::size_t>(row_at(k))] = k;
}

/// The next line of [rank, last) if the columns so far leave an ample share of it; else the one of which they
/// leave the largest, and -1 when none has one.
int WhitenedRows::next_pivot(int last, double tolerance) const noexcept {
  constexpr double ample = 0.1;
  int pivot = -1;
  double best = tolerance;
  for (int k = rank_; k < last; ++k) {
    const double share = left_(k) * inverse_diagonal_(k);
    if (share > best) {
      best = share;
      pivot = k;
    }
    if (k == rank_ && share > ample) return k;
  }
  return pivot;
}

/// Takes the pivots out of [rank, last): each time a column of W and, for the lines that may still become
/// pivots, what that column leaves of L, two lines at a time (there is one to spare):
///   w = L_p / root(L_pp)        L -= w w'
void WhitenedRows::eliminate(int last, int candidates, double tolerance) noexcept {
  double* const w = column_.data();
  double* const left = left_.data();
  const Eigen::Index stride = W_.outerStride();
  for (int pivot = next_pivot(last, tolerance); pivot >= 0; pivot = next_pivot(last, tolerance)) {
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
    add_square(c + 1, candidates, -1.0, w, W_.data(), stride);
    for (int k = candidates; k < rows_; k += 2) {
      add_to_two_lines(-w[k], -w[k + 1], w, c + 1, candidates, &W_(k, 0), &W_(k + 1, 0));
    }
  }
}

/// Exchanges two lines and the columns that belong to them in what is left of L; c < k.
void WhitenedRows::exchange(int c, int k) noexcept {
  std::swap(row_at_[static_cast<std::size_t>(c)], row_at_[static_cast<std::size_t>(k)]);
  std::swap(left_(c), left_(k));
  std::swap(inverse_diagonal_(c), inverse_diagonal_(k));
  for (int i = 0; i < c; ++i) std::swap(W_(c, i), W_(k, i));
  for (int i = c + 1; i < k; ++i) std::swap(W_(i, c), W_(k, i));
  for (int i = k + 1; i < rows_; ++i) std::swap(W_(i, c), W_(i, k));
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
  double* const y = substitution_.data();
  substitute(
      W_, g, r, inverse_root_.data() + g, [&](int c) { return rhs(row_at(g + c)); }, y);
  substitute_back(W_, g, r, inverse_root_.data() + g, y, [&](int c, double x) { nu(row_at(g + c)) = x; });
}

/// The rows' L is B B' with B of full column rank: its pseudo-inverse is B (B'B)^-2 B'.
void WhitenedRows::least_squares(const Eigen::VectorXd& rhs, int ground, int rows,
                                 Eigen::VectorXd& nu) noexcept {
  const int r = mobility();
  double* const y = substitution_.data();
  for (int k = 0; k < r; ++k) set_zero(k + 1, &gram_(k, 0));
  set_zero(r, y);
  for (int i = ground; i < rows; ++i) {
    const double* const B = line(line_of(i)) + ground_rank_;
    for (int k = 0; k < r; ++k) add_multiple(k + 1, B[k], B, &gram_(k, 0));
    add_multiple(r, rhs(i), B, y);
  }
  cholesky(gram_, r, 0.0);
  for (int pass = 0; pass < 2; ++pass) {
    solve_lower(gram_, r, y);
    solve_upper(gram_, r, y);
  }
  for (int i = ground; i < rows; ++i) nu(i) = dot(r, line(line_of(i)) + ground_rank_, y);
}

void WhitenedRows::hold_ground(const Eigen::VectorXd& bias) noexcept {
  const int g = ground_rank_;
  substitute(
      W_, 0, g, inverse_root_.data(), [&](int c) { return bias(row_at(c)); }, held_.data());
  for (int k = g; k < rows_; ++k) held_acceleration_(row_at(k)) = dot(g, line(k), held_.data());
}

void WhitenedRows::ground_multipliers(const Eigen::VectorXd& forces, int ground, int rows,
                                      Eigen::VectorXd& nu) noexcept {
  const int g = ground_rank_;
  double* const y = substitution_.data();
  copy(g, held_.data(), y);
  for (int i = ground; i < rows; ++i) add_multiple(g, -forces(i), line(line_of(i)), y);
  nu.head(ground).setZero();
  substitute_back(W_, 0, g, inverse_root_.data(), y, [&](int c, double x) { nu(row_at(c)) = x; });
}

}  // namespace zwang::solver
