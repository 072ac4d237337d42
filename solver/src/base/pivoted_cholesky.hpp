/// L nu = rhs for a symmetric positive semidefinite L of any rank.
///
/// Mostly every row has an ample share of its own. Then L = G D G' in the rows' given order, with G a lower
/// triangle of diagonal 1. No row has to be searched or exchanged, and no root is taken. If a row has too
/// little of its own, Cholesky with pivoting finds the rank, L = W W'. W stands in the place of L, its lines
/// in the order of elimination. Line k < rank() is the row that was the k-th pivot, so the pivots' lines are
/// a lower triangle.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "linear/pairs.hpp"
#include "sweep/columns.hpp"

namespace zwang::solver {

class PivotedCholesky {
 public:
  explicit PivotedCholesky(int row_capacity);

  void resize(int rows) noexcept { rows_ = rows; }
  double& L(int row, int column) noexcept { return W_(row, column); }  ///< to be set: the lower triangle
  /// The scale of a row, at least L_ii.
  double& size(int row) noexcept { return size_(row); }
  /// A row counts as dependent when the ones before leave less than `tolerance` of its size.
  void factorise(double tolerance) noexcept;
  int rank() const noexcept { return rank_; }

  /// The nu of least norm among those that come nearest to rhs.
  void solve(const double* rhs, double* nu) noexcept;

 private:
  bool factorise_in_order() noexcept;
  int row_at(int line) const noexcept { return row_at_[static_cast<std::size_t>(line)]; }
  int next_pivot(double tolerance) const noexcept;
  void eliminate(double tolerance) noexcept;
  void exchange(int c, int k) noexcept;
  void least_squares(const double* rhs, double* nu) noexcept;

  RowMajorMatrix W_;           ///< columns from rank() on: what the ones before leave of L; a line to spare
  RowMajorMatrix G_;           ///< below its diagonal
  bool is_in_order_ = false;   ///< L = G D G', else W W'
  Eigen::VectorXd inverse_D_;  ///< by row
  RowMajorMatrix gram_;
  Eigen::VectorXd size_;              ///< by row
  Eigen::VectorXd left_;              ///< by line: the diagonal of what is left of L
  Eigen::VectorXd inverse_diagonal_;  ///< by line: 1 / size, 0 on a row that is no candidate
  Eigen::VectorXd column_;            ///< the one that is being eliminated, by line
  Eigen::VectorXd inverse_root_;      ///< by column of W: 1 over its pivot
  Eigen::VectorXd substitution_;
  std::vector<int> row_at_;
  int rows_ = 0;
  int rank_ = 0;
};

}  // namespace zwang::solver
