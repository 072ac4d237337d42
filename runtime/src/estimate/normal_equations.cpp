#include "estimate/normal_equations.hpp"

#include <cmath>

namespace zwang::runtime {

NormalEquations::NormalEquations(Eigen::Index most_columns)
    : L_(Eigen::MatrixXd::Zero(most_columns, most_columns)) {}

void NormalEquations::factorise(const Eigen::MatrixXd& A, Eigen::Index rows, Eigen::Index columns) noexcept {
  size_ = columns;
  double trace = 0.0;
  for (Eigen::Index a = 0; a < columns; ++a) {
    for (Eigen::Index b = 0; b <= a; ++b) L_(a, b) = dot(A.col(a).data(), A.col(b).data(), rows);
    trace += L_(a, a);
  }
  const auto row = [this](Eigen::Index a) { return L_.data() + a * L_.cols(); };
  for (Eigen::Index a = 0; a < columns; ++a) {
    double* L_a = row(a);
    for (Eigen::Index b = 0; b < a; ++b) L_a[b] = (L_a[b] - dot(L_a, row(b), b)) * row(b)[b];
    L_a[a] = 1.0 / std::sqrt(L_a[a] + damping * trace - dot(L_a, L_a, a));
  }
}

void NormalEquations::solve(const Eigen::VectorXd& right, Eigen::VectorXd& out) const noexcept {
  const auto row = [this](Eigen::Index a) { return L_.data() + a * L_.cols(); };
  double* x = out.data();
  for (Eigen::Index a = 0; a < size_; ++a) x[a] = (right(a) - dot(row(a), x, a)) * row(a)[a];
  for (Eigen::Index a = size_ - 1; a >= 0; --a) {
    x[a] *= row(a)[a];
    for (Eigen::Index b = 0; b < a; ++b) x[b] -= row(a)[b] * x[a];
  }
}

}  // namespace zwang::runtime
