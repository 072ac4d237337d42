#include "oracle/reduced_problem.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>

namespace zwang::oracle {

namespace {

using Eigen::Index;

Vector projected_velocity(const solver::Model& model, const solver::State& state, bool project) {
  const DenseDynamics measured(model, state);
  if (!project) return measured.velocity;
  const Matrix B = constrained_basis(measured.M, measured.ground().jacobian);
  return B * (B.transpose() * (measured.M * measured.velocity));
}

}  // namespace

Matrix constrained_basis(const Matrix& M, const Matrix& rows) {
  Matrix N = Matrix::Identity(M.rows(), M.cols());
  if (rows.rows() > 0) {
    Eigen::ColPivHouseholderQR<Matrix> qr(rows.transpose());
    qr.setThreshold(1e-10L);
    N = (Matrix(qr.householderQ()).rightCols(M.rows() - qr.rank())).eval();
  }
  const Matrix inertia = N.transpose() * M * N;
  const Eigen::LLT<Matrix> llt(inertia);
  // B' M B = 1 with B = N L'^-1
  return llt.matrixL().solve(N.transpose()).transpose();
}

ReducedProblem::ReducedProblem(const solver::Model& m, const solver::State& state, bool project)
    : model(m), dynamics(model, state, projected_velocity(model, state, project)) {
  const LinearRows ground = dynamics.ground();
  B = constrained_basis(dynamics.M, ground.jacobian);
  const Index n = dynamics.freedoms();
  const Index joints = dynamics.joints;
  Vector generalised = -dynamics.h;
  generalised.tail(joints) += state.tau_ff.cast<Real>();
  Vector particular = Vector::Zero(n);
  if (ground.rhs.size() > 0) {
    Eigen::CompleteOrthogonalDecomposition<Matrix> cod;
    cod.setThreshold(1e-10L);
    cod.compute(ground.jacobian);
    particular = cod.solve(ground.rhs);
  }
  free = particular + B * (B.transpose() * (generalised - dynamics.M * particular));
  apparent = dynamics.M.inverse();
  G = B.transpose().rightCols(joints);
  for (Index j = 0; j < joints; ++j) {
    if (!model.joint(static_cast<int>(j)).actuated) G.col(j).setZero();
  }
}

Real ground_condition(const solver::Model& model, const solver::State& state) {
  const DenseDynamics dynamics(model, state);
  const Matrix J = dynamics.ground().jacobian;
  if (J.rows() == 0) return 1;
  Matrix L = J * dynamics.M.inverse() * J.transpose();
  const Vector scale = L.diagonal().cwiseSqrt().cwiseInverse();
  L = (scale.asDiagonal() * L * scale.asDiagonal()).eval();
  const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(L, Eigen::EigenvaluesOnly).eigenvalues();
  const Real largest = values[values.size() - 1];
  Real smallest = largest;
  for (const Real value : values) {
    if (value > 1e-10L * largest) smallest = std::min(smallest, value);
  }
  return largest / smallest;
}

}  // namespace zwang::oracle
