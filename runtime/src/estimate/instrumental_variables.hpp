/// Least squares of lines whose columns are noisy.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace zwang::runtime {

/// Each line twice, from measurements whose noise is not correlated: x . b = y_x and z . b = y_z.
struct TwinLines {
  std::vector<Eigen::VectorXd> x, z;
  std::vector<double> y_x, y_z;
};

/// Least squares estimate a noisy column too small. In products of both twins there is no noise:
///
///     A = (Z'X + X'Z)/2,   b = A^-1 (Z'y_X + X'y_Z)/2,
///     s = (z (y_X - x b) + x (y_Z - z b))/2 of each line,   covariance of b = A^-1 (sum s s') A^-1.
///
/// (Instrumental variables: Soderstrom, Stoica, System Identification, 1989, chapter 8.)
class InstrumentalVariables {
 public:
  /// Of at least one line. Directions of b that no line tells anything of are left at 0.
  explicit InstrumentalVariables(const TwinLines& lines);

  const Eigen::VectorXd& values() const { return b_; }
  const Eigen::VectorXd& errors() const { return errors_; }  ///< standard errors of the values
  /// Of A at unit columns, the largest eigenvalue by the least; infinite where noise exceeds what is told.
  double condition() const { return condition_; }
  /// A column has no more than noise.
  bool lacks_a_column() const { return lacks_a_column_; }
  /// sum (y_X - x b)(y_Z - z b)
  double misfit() const { return misfit_; }

 private:
  Eigen::VectorXd b_, errors_;
  double condition_ = 0.0, misfit_ = 0.0;
  bool lacks_a_column_ = false;
};

}  // namespace zwang::runtime
