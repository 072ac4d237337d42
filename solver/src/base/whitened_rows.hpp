/// One factorisation of the Delassus matrix L for rows in the order ground, joints, task: L = W W'.
///
/// Cholesky with pivoting inside each block; a row is taken as it comes while the ones before leave a tenth
/// of it. The first columns of W span what the ground holds, the next ones the motions that it leaves: their
/// number is the mobility. So for any two rows i, k beyond the ground
///
///   A_i Mc A_k' = B_i . B_k,   Mc = M^-1 - M^-1 Jp' (Jp M^-1 Jp')^+ Jp M^-1,   B_i = the last columns of row
///   i of W
///
/// and a generalised force f along them becomes p = sum B_i f_i: forces and accelerations of the constrained
/// robot live in one small space with the identity as its inertia. Redundant ground rows (two wheels on one
/// axle) are passed over.
///
/// W stands where L was copied to, its lines in the order of elimination: line k < rank() is the row that was
/// the k-th pivot, so the pivots' lines are a lower triangle.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sweep/sweeps.hpp"

namespace zwang::solver {

class WhitenedRows {
 public:
  explicit WhitenedRows(int row_capacity);

  /// `L`: lower triangle. Rows [0, ground) are the ground's, [ground, ground + joints) span all motions, the
  /// rest follow. A row counts as dependent when the ones before leave less than `tolerance` of its L_ii.
  void factorise(const RowMajorMatrix& L, int ground, int joints, int rows,
                 double tolerance = motion_tolerance) noexcept;
  static constexpr double motion_tolerance = 1e-8;   ///< the share below which a row counts as unreachable
  static constexpr double ground_tolerance = 1e-10;  ///< rounding leaves about 1e-15 on a dependent row

  int mobility() const noexcept { return rank_ - ground_rank_; }
  int ground_rank() const noexcept { return ground_rank_; }
  int rank() const noexcept { return rank_; }
  /// B_i, of a row beyond the ground.
  auto motion(int row) const noexcept { return W_.row(line_of(row)).segment(ground_rank_, mobility()); }
  /// A_i Mc A_i' over A_i M^-1 A_i': how much of a row the ground leaves.
  double free_share(int row, const RowMajorMatrix& L) const noexcept;

  /// Rows [ground, rows), which factorise() took as its second block: nu of least norm among those that bring
  /// their accelerations, rhs = b - g - held_acceleration by row, nearest to 0.
  void motion_multipliers(const Eigen::VectorXd& rhs, int ground, int rows, Eigen::VectorXd& nu) noexcept;

  /// What holding the ground rows at `bias` (desired minus free acceleration, by row) adds to the
  /// acceleration of a row beyond the ground.
  void hold_ground(const Eigen::VectorXd& bias) noexcept;
  double held_acceleration(int row) const noexcept { return held_acceleration_(row); }
  /// Ground multipliers for the forces `f` on the rows beyond (the ones of hold_ground included). Zero on
  /// redundant rows.
  void ground_multipliers(const Eigen::VectorXd& forces, int ground, int rows, Eigen::VectorXd& nu) noexcept;

 private:
  int line_of(int row) const noexcept { return line_of_[static_cast<std::size_t>(row)]; }
  int row_at(int line) const noexcept { return row_at_[static_cast<std::size_t>(line)]; }
  const double* line(int k) const noexcept { return &W_(k, 0); }
  int next_pivot(int last, double tolerance) const noexcept;
  void eliminate(int last, int candidates, double tolerance) noexcept;
  void exchange(int c, int k) noexcept;
  void least_squares(const Eigen::VectorXd& rhs, int ground, int rows, Eigen::VectorXd& nu) noexcept;

  RowMajorMatrix W_;  ///< columns from rank() on: what the ones before leave of L; a line to spare
  RowMajorMatrix gram_;
  Eigen::VectorXd left_;               ///< by line: the diagonal of what is left of L
  Eigen::VectorXd inverse_diagonal_;   ///< by line: 1 / L_ii, 0 on a row that is no candidate
  Eigen::VectorXd column_;             ///< the one that is being eliminated, by line
  Eigen::VectorXd inverse_root_;       ///< by column of W: 1 over its pivot
  Eigen::VectorXd held_;               ///< by column of W: what the held ground adds
  Eigen::VectorXd held_acceleration_;  ///< by row
  Eigen::VectorXd substitution_;
  std::vector<int> line_of_, row_at_;
  int rows_ = 0;
  int ground_rank_ = 0;
  int rank_ = 0;
};

}  // namespace zwang::solver
