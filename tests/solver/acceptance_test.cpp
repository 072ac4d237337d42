// The figures that the solver promises, one test each, printed.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "carriage.hpp"
#include "law_problem.hpp"
#include "oracle_comparison.hpp"

namespace zwang::oracle {
namespace {

using solver::Row;
using solver::RowKind;
using solver::Status;

solver::Solution solve_all(const LawProblem& p, const std::vector<Row>& rows) {
  solver::Solver solver(p.model);
  solver::Solution solution(p.model);
  EXPECT_EQ(solver.solve(p.state, rows, solution), Status::ok);
  return solution;
}

/// B'(S'tau - A'nu) relative to B'A'nu: the motors make the motion that the rows' forces would.
double wrench_map_residual(const LawProblem& p, const std::vector<Row>& rows, const solver::Solution& s) {
  const ReducedProblem reduced(p.model, p.state, false);
  const LinearRows linear = reduced.dynamics.rows(rows);
  Vector wanted = Vector::Zero(reduced.B.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto r = static_cast<Eigen::Index>(i);
    wanted += reduced.B.transpose() * linear.jacobian.row(r).transpose() * static_cast<Real>(s.rows[i].nu);
  }
  const Vector made = reduced.G * (s.tau - p.state.tau_ff).cast<Real>();
  return static_cast<double>((made - wanted).norm() / (1e-3L + wanted.norm()));
}

TEST(Acceptance, WrenchMapResidualOnEveryExactBase) {
  for (const Robot robot : {Robot::mecanum, Robot::omni, Robot::differential, Robot::kelo, Robot::mecanum_arm,
                            Robot::differential_arm, Robot::kelo_arm, Robot::car}) {
    double worst = 0.0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      LawProblem p(robot, seed);
      const std::vector<Row> rows =
          p.rows({.count = 4, .one_sided = 0, .force = 0, .duplicate = 0, .weight = 0, .sum = 0});
      // A passive joint (a caster's) has no motor; its feed-forward is a force of the world.
      worst = std::max(worst, wrench_map_residual(p, rows, solve_all(p, rows)));
    }
    std::printf("wrench map residual, %s: %.1e\n", to_string(robot), worst);
    EXPECT_LT(worst, 1e-9) << to_string(robot);
  }
}

TEST(Acceptance, StrictForcePriority) {
  // 15 N stay 15 N under 50 N of a lower level, pushed or driven, saturated or not.
  const solver::Model model = solver::test::carriage();
  solver::Solver solver(model);
  solver::Solution s(model);
  double worst = 0.0;
  for (const RowKind above : {RowKind::force, RowKind::driver}) {
    for (const RowKind below : {RowKind::force, RowKind::driver}) {
      const std::vector<Row> rows{
          solver::test::along_rail(above, above == RowKind::force ? 15.0 : 9.0, 15.0, 1),
          solver::test::along_rail(below, below == RowKind::force ? 50.0 : 9.0, 50.0, 2)};
      ASSERT_EQ(solver.solve(solver::State(model), rows, s), Status::ok);
      worst = std::max(worst, std::abs(s.tau[0] - 15.0));
    }
  }
  std::printf("force priority: 15 N +- %.1e N\n", worst);
  EXPECT_LT(worst, 1e-9);
}

TEST(Acceptance, TorqueLimitsAreNeverExceeded) {
  double highest = 0.0;
  long at_limit = 0;
  for (const Robot robot : all_robots) {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      LawProblem p(robot, seed, 6.0);
      const std::vector<Row> rows = p.rows({.count = 8, .levels = 3, .force = 0.3, .bound = 300.0});
      const solver::Solution s = solve_all(p, rows);
      double largest = 0.0;
      for (int j = 0; j < p.model.joint_count(); ++j) {
        if (p.model.joint(j).actuated) largest = std::max(largest, std::abs(s.tau[j]) / 6.0);
      }
      highest = std::max(highest, largest);
      if (largest > 1.0 - 1e-9) ++at_limit;
    }
  }
  std::printf("torque: at most %.17g of the limit; at it in %ld of %zu problems\n", highest, at_limit,
              300 * std::size(all_robots));
  EXPECT_LE(highest, 1.0);
  EXPECT_GT(at_limit, 500) << "nothing proved where no motor is at its limit";
}

/// A serial arm of many joints, alternating axes.
solver::Model long_arm(int joints) {
  solver::ModelBuilder builder(solver::BaseType::fixed, "base", {});
  std::string parent = "base";
  for (int j = 0; j < joints; ++j) {
    solver::Joint joint;
    joint.name = "joint" + std::to_string(j);
    joint.type = solver::JointType::revolute;
    joint.axis = solver::Vector3::Unit(j % 3);
    joint.rotor_inertia = 0.05;
    joint.actuated = true;
    joint.max_effort = 1e6;
    const std::string name = "link" + std::to_string(j);
    builder.add_link(
        name, parent, {solver::Matrix3::Identity(), {0.05, 0.0, 0.05}}, joint,
        solver::RigidInertia::from_com(1.0, {0.01, 0.0, 0.02}, 0.01 * solver::Matrix3::Identity()));
    parent = name;
  }
  return builder.build();
}

TEST(Acceptance, SixtyFourRowsOnSixtyFourJoints) {
  const solver::Model model = long_arm(64);
  solver::State state(model);
  Random random(5);
  for (Eigen::Index j = 0; j < 64; ++j) {
    state.q[j] = random.uniform(-1.0, 1.0);
    state.qd[j] = random.uniform(-0.2, 0.2);
  }
  // A row for each joint's freedom, sixteen at a level. Together they leave one acceleration, whatever the
  // levels: J qdd = b - dJ/dt qd.
  std::vector<Row> rows;
  for (int i = 0; i < 64; ++i) {
    Row row;
    row.body = i + 1;
    row.a.angular = solver::Vector3::Unit(i % 3) + 0.3 * random.direction();
    row.reference_body = std::max(0, i - 1);
    row.a_reference.angular = 0.3 * random.direction();
    row.b = random.uniform(-0.5, 0.5);
    row.lo = -1e6;
    row.hi = 1e6;
    row.level = i % 4;
    rows.push_back(row);
  }
  solver::Solver solver(model, {.row_capacity = 64});
  solver::Solution got(model, 64);
  ASSERT_EQ(solver.solve(state, rows, got), Status::ok);
  const DenseDynamics dense(model, state);
  const LinearRows linear = dense.rows(rows);
  const Vector qdd = linear.jacobian.partialPivLu().solve(linear.rhs);
  const Vector tau = dense.M * qdd + dense.h;
  const double off = std::max(relative_difference(got.qdd, qdd.cast<double>()),
                              relative_difference(got.tau, tau.cast<double>()));
  std::printf("64 rows, 64 joints: %d iterations, worst difference %.1e, largest torque %.0f N m\n",
              got.iterations, off, got.tau.cwiseAbs().maxCoeff());
  EXPECT_LT(off, 1e-9);
  rows.push_back(rows.back());
  EXPECT_EQ(solver.solve(state, rows, got), Status::capacity_exceeded);
}

TEST(Acceptance, AWorkspaceWithoutRoomIsALoudError) {
  const solver::Model model = solver::test::carriage();
  for (const int capacity : {0, -1}) {
    EXPECT_THROW(solver::Solver(model, {.row_capacity = capacity}), std::invalid_argument);
    EXPECT_THROW(solver::PopovVereshchagin(model, {.row_capacity = capacity}), std::invalid_argument);
    EXPECT_THROW(solver::Solution(model, capacity), std::invalid_argument);
    EXPECT_THROW(solver::ConstrainedMotion(model, capacity), std::invalid_argument);
    EXPECT_THROW(solver::ConstraintSet(capacity, 8), std::invalid_argument);
    EXPECT_THROW(solver::ConstraintSet(8, capacity), std::invalid_argument);
  }
}

}  // namespace
}  // namespace zwang::oracle
