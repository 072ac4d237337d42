#include "base/whitened_rows.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::solver {

WhitenedRows::WhitenedRows(int row_capacity)
    : W_(RowMajorMatrix::Zero(row_capacity, row_capacity)),
      gram_(RowMajorMatrix::Zero(row_capacity, row_capacity)),
      left_(Eigen::VectorXd::Zero(row_capacity)),
      held_(Eigen::VectorXd::Zero(row_capacity)),
      substitution_(Eigen::VectorXd::Zero(row_capacity)),
      pivots_(static_cast<std::size_t>(row_capacity)),
      picked_(static_cast<std::size_t>(row_capacity)) {}

void WhitenedRows::factorise(const RowMajorMatrix& L, int ground, int joints, int rows,
                             double tolerance) noexcept {
  left_.head(rows) = L.diagonal().head(rows);
  std::fill_n(picked_.begin(), rows, char{0});
  rank_ = 0;
  eliminate(L, 0, ground, rows, ground_tolerance);
  ground_rank_ = rank_;
  eliminate(L, ground, ground + joints, rows, tolerance);
}

void WhitenedRows::eliminate(const RowMajorMatrix& L, int first, int last, int rows,
                             double tolerance) noexcept {
  for (;;) {
    int pivot = -1;
    double best = tolerance;
    for (int i = first; i < last; ++i) {
      const bool open = picked_[static_cast<std::size_t>(i)] == 0;
      const double share = L(i, i) > 0.0 ? left_(i) / L(i, i) : 0.0;
      if (open && share > best) {
        best = share;
        pivot = i;
      }
    }
    if (pivot < 0) return;
    picked_[static_cast<std::size_t>(pivot)] = 1;
    pivots_[static_cast<std::size_t>(rank_)] = pivot;
    const double root = std::sqrt(left_(pivot));
    for (int k = first; k < rows; ++k) {
      if (picked_[static_cast<std::size_t>(k)] != 0) {
        W_(k, rank_) = 0.0;
        continue;
      }
      const double explained = W_.row(k).head(rank_).dot(W_.row(pivot).head(rank_));
      W_(k, rank_) = (L(std::max(k, pivot), std::min(k, pivot)) - explained) / root;
      left_(k) -= W_(k, rank_) * W_(k, rank_);
    }
    W_(pivot, rank_) = root;
    ++rank_;
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
  const auto pivot = [&](int c) { return pivots_[static_cast<std::size_t>(g + c)]; };
  auto y = substitution_.head(r);
  for (int c = 0; c < r; ++c) {
    y(c) = (rhs(pivot(c)) - W_.row(pivot(c)).segment(g, c).dot(y.head(c))) / W_(pivot(c), g + c);
  }
  for (int c = r - 1; c >= 0; --c) {
    for (int k = c + 1; k < r; ++k) y(c) -= W_(pivot(k), g + c) * nu(pivot(k));
    nu(pivot(c)) = y(c) / W_(pivot(c), g + c);
  }
}

/// The rows' L is B B' with B of full column rank: its pseudo-inverse is B (B'B)^-2 B'.
void WhitenedRows::least_squares(const Eigen::VectorXd& rhs, int ground, int rows,
                                 Eigen::VectorXd& nu) noexcept {
  const int r = mobility();
  const auto B = W_.block(ground, ground_rank_, rows - ground, r);
  auto factor = gram_.topLeftCorner(r, r);
  for (int k = 0; k < r; ++k) {  // Cholesky of B'B, lower
    for (int i = k; i < r; ++i) {
      const double left = B.col(i).dot(B.col(k)) - factor.row(i).head(k).dot(factor.row(k).head(k));
      factor(i, k) = i == k ? std::sqrt(left) : left / factor(k, k);
    }
  }
  auto y = substitution_.head(r);
  for (int k = 0; k < r; ++k) y(k) = B.col(k).dot(rhs.segment(ground, rows - ground));
  for (int pass = 0; pass < 2; ++pass) {
    for (int k = 0; k < r; ++k) y(k) = (y(k) - factor.row(k).head(k).dot(y.head(k))) / factor(k, k);
    for (int k = r - 1; k >= 0; --k) {
      for (int i = k + 1; i < r; ++i) y(k) -= factor(i, k) * y(i);
      y(k) /= factor(k, k);
    }
  }
  for (int i = ground; i < rows; ++i) nu(i) = B.row(i - ground).dot(y);
}

void WhitenedRows::hold_ground(const Eigen::VectorXd& bias) noexcept {
  for (int c = 0; c < ground_rank_; ++c) {
    const int pivot = pivots_[static_cast<std::size_t>(c)];
    held_(c) = (bias(pivot) - W_.row(pivot).head(c).dot(held_.head(c))) / W_(pivot, c);
  }
}

void WhitenedRows::ground_multipliers(const Eigen::VectorXd& forces, int ground, int rows,
                                      Eigen::VectorXd& nu) noexcept {
  substitution_.head(ground_rank_) = held_.head(ground_rank_);
  for (int i = ground; i < rows; ++i) {
    if (forces(i) != 0.0) {
      substitution_.head(ground_rank_) -= W_.row(i).head(ground_rank_).transpose() * forces(i);
    }
  }
  nu.head(ground).setZero();
  for (int c = ground_rank_ - 1; c >= 0; --c) {
    double rest = substitution_(c);
    for (int k = c + 1; k < ground_rank_; ++k) {
      const int later = pivots_[static_cast<std::size_t>(k)];
      rest -= W_(later, c) * nu(later);
    }
    const int pivot = pivots_[static_cast<std::size_t>(c)];
    nu(pivot) = rest / W_(pivot, c);
  }
}

}  // namespace zwang::solver
