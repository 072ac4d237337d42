// Sums over lines, not products of matrices of all lines: these take ten times as long to compile.
#include "estimate/instrumental_variables.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace zwang::runtime {

namespace {

/// A = V D V', without what is less than rounding.
Eigen::MatrixXd inverse_of(const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>& A) {
  constexpr double least = 1e-13;  // of the largest eigenvalue
  const Eigen::VectorXd& values = A.eigenvalues();
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(values.size(), values.size());
  for (Eigen::Index n = 0; n < values.size(); ++n) {
    if (!(values(n) > least * values(values.size() - 1))) continue;
    const Eigen::VectorXd v = A.eigenvectors().col(n);
    inverse += v * v.transpose() / values(n);
  }
  return inverse;
}

/// The lines at columns of unit length.
TwinLines scaled(const TwinLines& lines, const Eigen::VectorXd& norms) {
  TwinLines result = lines;
  for (std::size_t i = 0; i < lines.x.size(); ++i) {
    result.x[i] = lines.x[i].cwiseQuotient(norms);
    result.z[i] = lines.z[i].cwiseQuotient(norms);
  }
  return result;
}

}  // namespace

InstrumentalVariables::InstrumentalVariables(const TwinLines& all) {
  const std::size_t count = all.x.size();
  const Eigen::Index size = all.x.front().size();
  Eigen::VectorXd norms = Eigen::VectorXd::Zero(size);
  for (std::size_t i = 0; i < count; ++i) norms += all.x[i].cwiseProduct(all.z[i]);
  lacks_a_column_ = !(norms.minCoeff() > 0.0);
  for (double& norm : norms) norm = norm > 0.0 ? std::sqrt(norm) : 1.0;

  const TwinLines lines = scaled(all, norms);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::VectorXd &x = lines.x[i], &z = lines.z[i];
    A += 0.5 * (z * x.transpose() + x * z.transpose());
    right += 0.5 * (lines.y_x[i] * z + lines.y_z[i] * x);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(A);
  const double least = eigen.eigenvalues()(0), most = eigen.eigenvalues()(size - 1);
  condition_ = least > 0.0 ? most / least : std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd inverse = inverse_of(eigen);
  const Eigen::VectorXd b = inverse * right;

  Eigen::VectorXd variances = Eigen::VectorXd::Zero(size);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::VectorXd &x = lines.x[i], &z = lines.z[i];
    const double off_x = lines.y_x[i] - x.dot(b), off_z = lines.y_z[i] - z.dot(b);
    const Eigen::VectorXd moved = inverse * (0.5 * (off_x * z + off_z * x));  // A^-1 s
    variances += moved.cwiseAbs2();
    misfit_ += off_x * off_z;
  }
  variances *=
      static_cast<double>(count) / std::max(1.0, static_cast<double>(count) - static_cast<double>(size));
  b_ = b.cwiseQuotient(norms);
  errors_ = variances.cwiseSqrt().cwiseQuotient(norms);
}

}  // namespace zwang::runtime
