/// A convex quadratic program, solved in extended precision by an interior-point method. An exact solve on
/// the active set of its result polishes the solution. The solution is checked against the optimality
/// conditions.
#pragma once

#include <limits>

#include "oracle/real.hpp"

namespace zwang::oracle {

inline constexpr Real unbounded = std::numeric_limits<Real>::infinity();

/// minimise 1/2 x'Hx - g'x subject to E x = e, lo <= x <= hi. H positive semidefinite; E may lack rank if e
/// is consistent.
struct QuadraticProgram {
  QuadraticProgram(Eigen::Index variables, Eigen::Index equations)
      : H(Matrix::Zero(variables, variables)),
        g(Vector::Zero(variables)),
        E(Matrix::Zero(equations, variables)),
        e(Vector::Zero(equations)),
        lo(Vector::Constant(variables, -unbounded)),
        hi(Vector::Constant(variables, unbounded)) {}
  Matrix H;
  Vector g;
  Matrix E;
  Vector e;
  Vector lo;
  Vector hi;
};

struct QuadraticSolution {
  Vector x;
  /// The gradient of the Lagrangian, in units that make every variable's own curvature or equation 1.
  /// Positive: a lower bound carries force. Negative: an upper bound does. 0: between them.
  Vector bound_force;
  Real error = 0;  ///< largest violation of the optimality conditions, relative to the problem's size
  int iterations = 0;
};

QuadraticSolution solve(const QuadraticProgram& problem);

/// Largest violation of the conditions of optimality by (x, y), relative to the terms they are made of.
Real optimality_error(const QuadraticProgram& problem, const Vector& x, const Vector& y);

}  // namespace zwang::oracle
