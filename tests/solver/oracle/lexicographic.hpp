/// The bounded problem of the solver, level by level, on dense matrices in extended precision.
///
/// M is the mass matrix, h the bias and Jp the ground. Every motion that the ground allows is vdot = free + B
/// c, with B B' = Mc. Then 1/2 c'c is Gauss's function, and rows are y_i = A_i B in these coordinates.
#pragma once

#include <vector>

#include "oracle/reduced_problem.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::oracle {

struct OracleRow {
  Real nu = 0;
  Real phi = 0;
  Real acceleration = 0;     ///< a . Xdd after the last level
  Real residual = 0;         ///< a . Xdd - b
  bool unique = true;        ///< nu is the only optimal one
  Real demand = 0;           ///< b less the acceleration that comes by itself
  bool unreachable = false;  ///< the ground holds the axis, or no motor moves it
  bool idle = false;         ///< unreachable, or the levels above leave it no freedom: nu is 0
};

struct OracleSolution {
  Vector tau;   ///< joints, feed-forward included
  Vector vdot;  ///< base (none on a fixed base), then joints
  std::vector<OracleRow> rows;
  int mobility = 0;
  bool motors_reach_all = false;             ///< every motion that the ground leaves
  Real error = 0;                            ///< worst violation of optimality among all stages
  std::vector<Vector> spatial_acceleration;  ///< of each body, body coordinates, angular first
};

OracleSolution solve(const solver::Model& model, const solver::State& state,
                     const std::vector<solver::Row>& rows, bool project_velocity = true);

}  // namespace zwang::oracle
