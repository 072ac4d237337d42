/// Least squares of a few unknowns.
#pragma once

#include <Eigen/Core>

namespace zwang::runtime {

/// (A'A + e I) x = r by Cholesky: small, and nothing to pivot for. `damping` of the trace, e, keeps a matrix
/// that lacks a direction invertible, and the answer along it small. Does not allocate, lock, throw or print
/// after construction.
class NormalEquations {
 public:
  explicit NormalEquations(Eigen::Index most_columns);

  /// A: the first `rows` and `columns` of the matrix.
  void factorise(const Eigen::MatrixXd& A, Eigen::Index rows, Eigen::Index columns) noexcept;
  /// The first `columns` entries of both; `x` may be `right`.
  void solve(const Eigen::VectorXd& right, Eigen::VectorXd& x) const noexcept;

  static constexpr double damping = 1e-9;

 private:
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> L_;  ///< on its diagonal 1 / L_aa
  Eigen::Index size_ = 0;
};

/// Of a few numbers: nothing to be set up for.
inline double dot(const double* a, const double* b, Eigen::Index count) noexcept {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace zwang::runtime
