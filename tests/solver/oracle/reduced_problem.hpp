/// A robot on its ground in the coordinates of its free motion, on dense matrices in extended precision.
#pragma once

#include "oracle/dense_dynamics.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::oracle {

/// The parts of the problem that the levels have in common.
struct ReducedProblem {
  ReducedProblem(const solver::Model& model, const solver::State& state, bool project_velocity);

  solver::Model model;
  DenseDynamics dynamics;  ///< at the velocity that the rows see
  Matrix B;                ///< n x mobility, B B' = Mc
  Vector free;             ///< free motion: feed-forward, bias, ground
  Matrix apparent;         ///< M^-1, without the ground
  Matrix G;                ///< B' S', mobility x joints; columns of joints without motor are 0
};

/// B of the constrained inverse inertia: columns span the motions that `rows` leave, B' M B = 1.
Matrix constrained_basis(const Matrix& M, const Matrix& rows);

/// How far the ground amplifies rounding: the ratio of the largest eigenvalue of Jp M^-1 Jp', its diagonal
/// made 1, to the smallest that is not 0. A base whose wheels nearly contradict each other has a large one. 1
/// without a ground.
Real ground_condition(const solver::Model& model, const solver::State& state);

}  // namespace zwang::oracle
