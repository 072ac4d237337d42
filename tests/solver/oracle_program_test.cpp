// The oracle's own proof: its quadratic programs against the enumeration of every active set, and its levels
// against cases that a formula answers.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "carriage.hpp"
#include "oracle/lexicographic.hpp"
#include "oracle/quadratic_program.hpp"
#include "oracle/random_problem.hpp"

namespace zwang::oracle {
namespace {

/// The least objective over every choice of bounds whose stationary point is feasible: always the optimum.
Real least_by_enumeration(const QuadraticProgram& p) {
  const Eigen::Index n = p.g.size();
  const Eigen::Index m = p.e.size();
  Real least = unbounded;
  long choices = 1;
  for (Eigen::Index i = 0; i < n; ++i) choices *= 3;
  for (long choice = 0; choice < choices; ++choice) {
    Matrix K = Matrix::Zero(n + m, n + m);
    Vector rhs(n + m);
    rhs << p.g, p.e;
    K.topLeftCorner(n, n) = p.H;
    K.topRightCorner(n, m) = p.E.transpose();
    K.bottomLeftCorner(m, n) = p.E;
    long rest = choice;
    bool usable = true;
    for (Eigen::Index i = 0; i < n; ++i, rest /= 3) {
      if (rest % 3 == 0) continue;
      const Real bound = rest % 3 == 1 ? p.lo[i] : p.hi[i];
      usable = usable && std::isfinite(bound);
      K.row(i).setZero();
      K(i, i) = 1;
      rhs[i] = bound;
    }
    if (!usable) continue;
    const Vector s = K.completeOrthogonalDecomposition().solve(rhs);
    if ((K * s - rhs).norm() > 1e-12L * (1 + rhs.norm())) continue;
    const Vector x = s.head(n);
    if ((x - p.lo).minCoeff() < -1e-12L || (p.hi - x).minCoeff() < -1e-12L) continue;
    least = std::min(least, x.dot(p.H * x) / 2 - p.g.dot(x));
  }
  return least;
}

TEST(OracleProgram, MatchesTheEnumerationOfActiveSets) {
  Random random(21);
  for (int i = 0; i < 150; ++i) {
    const Eigen::Index n = random.pick(2, 6);
    const Eigen::Index m = random.pick(0, static_cast<int>(n) - 1);
    const Eigen::Index rank = random.pick(1, static_cast<int>(n));
    QuadraticProgram p(n, m);
    Matrix C(rank, n);
    Vector inside(n);
    for (Eigen::Index c = 0; c < n; ++c) {
      for (Eigen::Index r = 0; r < rank; ++r) C(r, c) = random.uniform(-1.0, 1.0);
      for (Eigen::Index r = 0; r < m; ++r) p.E(r, c) = random.chance(0.3) ? 0.0 : random.uniform(-1.0, 1.0);
      inside[c] = random.uniform(-1.0, 1.0);
      p.g[c] = random.uniform(-5.0, 5.0);
      p.lo[c] = inside[c] - random.uniform(0.0, 2.0);
      p.hi[c] = inside[c] + random.uniform(0.0, 2.0);
      if (random.chance(0.2)) inside[c] = p.lo[c];  // optima on corners, feasible sets without interior
    }
    if (m > 1 && random.chance(0.3)) p.E.row(1) = 2 * p.E.row(0);
    p.H = C.transpose() * C;
    p.e = p.E * inside;
    const QuadraticSolution s = solve(p);
    EXPECT_LT(s.error, 1e-15L) << "problem " << i;
    const Real cost = s.x.dot(p.H * s.x) / 2 - p.g.dot(s.x);
    EXPECT_NEAR(static_cast<double>(cost - least_by_enumeration(p)), 0.0, 1e-11) << "problem " << i;
  }
}

constexpr double none = solver::infinity;

solver::Row drive(double b, double bound, int level) {
  return solver::test::along_rail(solver::RowKind::driver, b, bound, level);
}

OracleSolution solve_carriage(double max_effort, const std::vector<solver::Row>& rows) {
  const solver::Model model = solver::test::carriage(max_effort);
  const solver::State state(model);
  OracleSolution s = solve(model, state, rows);
  EXPECT_LT(s.error, 1e-15L);
  return s;
}

double value(Real x) {
  return static_cast<double>(x);
}

TEST(OracleLevels, ForceInsideItsBoundMovesAndABoundLimits) {
  OracleSolution s = solve_carriage(none, {drive(2.0, 50.0, 1)});
  EXPECT_NEAR(value(s.rows[0].nu), 20.0, 1e-14);
  EXPECT_NEAR(value(s.tau[0]), 20.0, 1e-14);
  s = solve_carriage(none, {drive(2.0, 15.0, 1)});
  EXPECT_NEAR(value(s.rows[0].nu), 15.0, 1e-14);
  EXPECT_NEAR(value(s.rows[0].residual), -0.5, 1e-15);
  s = solve_carriage(12.0, {drive(2.0, 15.0, 1)});
  EXPECT_NEAR(value(s.tau[0]), 12.0, 1e-14);
  EXPECT_NEAR(value(s.rows[0].nu), 12.0, 1e-14);
}

TEST(OracleLevels, ASaturatedRowKeepsItsForceUnderALowerOne) {
  const OracleSolution s = solve_carriage(none, {drive(5.0, 15.0, 0), drive(9.0, 50.0, 1)});
  EXPECT_NEAR(value(s.rows[0].nu), 15.0, 1e-14);
  EXPECT_NEAR(value(s.tau[0]), 15.0, 1e-13);
}

TEST(OracleLevels, AForceRowIsPushedAsFarAsTheMotorGoes) {
  solver::Row push = drive(0.0, 20.0, 1);
  push.kind = solver::RowKind::force;
  push.force = 20.0;
  OracleSolution s = solve_carriage(none, {push});
  EXPECT_NEAR(value(s.rows[0].phi), 1.0, 1e-15);
  EXPECT_NEAR(value(s.tau[0]), 20.0, 1e-14);
  s = solve_carriage(15.0, {push});
  EXPECT_NEAR(value(s.rows[0].phi), 0.75, 1e-15);
  EXPECT_NEAR(value(s.rows[0].nu), 15.0, 1e-14);
}

TEST(OracleLevels, AOneSidedRowAboveBrakesADriverBelow) {
  solver::Row limit = drive(1.0, 500.0, 0);
  limit.kind = solver::RowKind::upper;
  limit.hi = 0.0;
  const OracleSolution s = solve_carriage(none, {limit, drive(3.0, 100.0, 1)});
  EXPECT_NEAR(value(s.vdot[0]), 1.0, 1e-15);
  EXPECT_NEAR(value(s.tau[0]), 10.0, 1e-14);
}

TEST(OracleLevels, DuplicateRowsShareTheirForce) {
  const OracleSolution s = solve_carriage(none, {drive(2.0, 50.0, 1), drive(2.0, 50.0, 1)});
  EXPECT_NEAR(value(s.rows[0].nu), 10.0, 1e-14);
  EXPECT_NEAR(value(s.rows[1].nu), 10.0, 1e-14);
}

TEST(OracleLevels, RandomProblemsAreSolvedToTheirOptimalityConditions) {
  Random random(22);
  Real worst = 0;
  for (int i = 0; i < 45; ++i) {
    const Robot robot = all_robots[static_cast<std::size_t>(i) % std::size(all_robots)];
    const solver::Model model = random_model(robot, random, random.uniform(2.0, 40.0));
    const solver::State state = random_state(model, random);
    RowOptions options;
    options.count = random.pick(1, 8);
    options.levels = random.pick(1, 3);
    const OracleSolution s = solve(model, state, random_rows(model, options, random));
    worst = std::max(worst, s.error);
    EXPECT_LT(s.error, 1e-12L) << to_string(robot) << " " << i;
  }
  RecordProperty("worst_optimality_error", std::to_string(value(worst)));
}

}  // namespace
}  // namespace zwang::oracle
