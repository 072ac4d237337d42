// The solver's levels, softness and torque limits against formulas. The robots are a carriage of 10 kg on a
// rail, and a skid-steered base that cannot push sideways.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "carriage.hpp"
#include "oracle/random_problem.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::oracle {
namespace {

using solver::Row;
using solver::RowKind;
using solver::test::along_rail;

constexpr double unlimited = solver::infinity;

solver::Solution solve_carriage(const std::vector<Row>& rows, double max_effort = unlimited) {
  const solver::Model model = solver::test::carriage(max_effort);
  solver::Solver solver(model);
  solver::Solution solution(model);
  EXPECT_EQ(solver.solve(solver::State(model), rows, solution), solver::Status::ok);
  return solution;
}

TEST(Levels, ASaturatedForceIsNotAddedToFromBelow) {
  const auto s =
      solve_carriage({along_rail(RowKind::driver, 5.0, 15.0, 0), along_rail(RowKind::driver, 9.0, 50.0, 1)});
  EXPECT_NEAR(s.tau[0], 15.0, 1e-12);
}

TEST(Levels, ALimitAboveHoldsAgainstMoreForceThanItsOwn) {
  // The limit's own force is 5 N at most; a push of 40 N from below would be 4 m/s^2.
  const auto s =
      solve_carriage({along_rail(RowKind::upper, 1.0, 5.0, 0), along_rail(RowKind::force, 40.0, 40.0, 1)});
  EXPECT_NEAR(s.qdd[0], 1.0, 1e-12);
}

TEST(Levels, ALevelThatAsksNothingChangesNothing) {
  const Row nothing = along_rail(RowKind::force, 0.0, 0.0, 1);
  for (const double bound : {500.0, 4.0}) {
    for (const RowKind kind : {RowKind::driver, RowKind::lower}) {
      const Row row = along_rail(kind, 2.0, bound, 0);
      const auto alone = solve_carriage({row});
      const auto both = solve_carriage({row, nothing});
      EXPECT_NEAR(both.tau[0], alone.tau[0], 1e-12)
          << "bound " << bound << ", " << (kind == RowKind::lower ? "lower" : "driver");
    }
  }
}

solver::Row weighted(double b, double weight) {
  Row row = along_rail(RowKind::driver, b, 1000.0, 1);
  row.weight = weight;
  return row;
}

TEST(Weights, TheFractionOfTheMassesIsMet) {
  // w / (w + Lambda) of b, Lambda the 10 kg of the carriage.
  for (const double w : {1.0, 10.0, 90.0}) {
    const auto s = solve_carriage({weighted(2.0, w)});
    EXPECT_NEAR(s.qdd[0], 2.0 * w / (w + 10.0), 1e-12);
    EXPECT_EQ(s.rows[0].status, solver::RowStatus::held);
  }
}

TEST(Weights, TwoWishesMeetWhereTheirMassesSay) {
  // min of 1/2 m a^2 + sum 1/2 w (a - b)^2.
  const auto s = solve_carriage({weighted(2.0, 30.0), weighted(-1.0, 10.0)});
  EXPECT_NEAR(s.qdd[0], (30.0 * 2.0 - 10.0) / 50.0, 1e-12);
}

TEST(Weights, WhatASoftRowReachedIsKeptAgainstTheLevelsBelow) {
  const auto s = solve_carriage({weighted(2.0, 10.0), along_rail(RowKind::force, 40.0, 40.0, 2)});
  EXPECT_NEAR(s.qdd[0], 1.0, 1e-12);
  EXPECT_EQ(s.rows[1].status, solver::RowStatus::blocked);
}

TEST(Sums, LimitWhatAllRowsPressWithTogether) {
  const Row sum = along_rail(RowKind::sum, 0.0, 40.0, 0);
  const Row pull = along_rail(RowKind::driver, 3.0, 25.0, 1);
  const auto s = solve_carriage({sum, pull, along_rail(RowKind::force, 30.0, 30.0, 1)});
  EXPECT_NEAR(s.tau[0], 30.0, 1e-12) << "30 N of 40 pushed are 3 m/s^2 by themselves";
  const auto hard =
      solve_carriage({sum, along_rail(RowKind::driver, 6.0, 25.0), along_rail(RowKind::driver, 6.0, 25.0)});
  EXPECT_NEAR(hard.tau[0], 40.0, 1e-12);
  EXPECT_NEAR(hard.rows[0].nu, 40.0, 1e-12);
  EXPECT_TRUE(hard.rows[0].saturated);
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_NEAR(hard.rows[i].nu, 20.0, 1e-12) << "equals share";
    EXPECT_TRUE(hard.rows[i].saturated);
    EXPECT_EQ(hard.rows[i].status, solver::RowStatus::force_limited);
  }
}

TEST(Sums, LimitForceRowsToo) {
  const auto s =
      solve_carriage({along_rail(RowKind::sum, 0.0, 12.0, 1), along_rail(RowKind::force, 40.0, 40.0, 1)});
  EXPECT_NEAR(s.rows[1].phi, 0.3, 1e-12);
  EXPECT_EQ(s.rows[1].status, solver::RowStatus::force_limited);
  EXPECT_NEAR(s.tau[0], 12.0, 1e-12);
}

TEST(Sums, CountTheirOwnLevelAndThoseBelow) {
  // 15 N at level 0 stay outside; below, 5 of 50 N remain, in spite of the level between.
  const auto s =
      solve_carriage({along_rail(RowKind::force, 15.0, 15.0, 0), along_rail(RowKind::sum, 0.0, 5.0, 1)});
  EXPECT_NEAR(s.tau[0], 15.0, 1e-12);
  const auto free =
      solve_carriage({along_rail(RowKind::upper, 9.0, 500.0, 0), along_rail(RowKind::sum, 0.0, 5.0, 1),
                      along_rail(RowKind::driver, 2.0, 50.0, 2)});
  EXPECT_NEAR(free.tau[0], 5.0, 1e-12);
  EXPECT_NEAR(free.rows[1].nu, 5.0, 1e-12);
}

TEST(Sums, ABrakeOfAHigherLevelCountsAgainstAPushBelow) {
  // The limit takes 30 of the 40 N away again: 10 N press, whatever the rows say each.
  const auto s =
      solve_carriage({along_rail(RowKind::upper, 1.0, 500.0, 0), along_rail(RowKind::sum, 0.0, 20.0, 0),
                      along_rail(RowKind::force, 40.0, 40.0, 1)});
  EXPECT_NEAR(s.rows[2].phi, 1.0, 1e-12);
  EXPECT_NEAR(s.tau[0], 10.0, 1e-12);
  EXPECT_NEAR(s.rows[1].nu, 10.0, 1e-12);
}

std::vector<int> opposing(const std::vector<Row>& rows, int row, std::size_t capacity = 8) {
  const solver::Model model = solver::test::carriage();
  solver::Solver solver(model);
  solver::Solution solution(model);
  EXPECT_EQ(solver.solve(solver::State(model), rows, solution), solver::Status::ok);
  std::vector<int> out(capacity);
  out.resize(static_cast<std::size_t>(solver.opposing(row, out)));
  return out;
}

TEST(Opposing, NamesTheLimitsThatHoldADriverBackTheStrongestFirst) {
  // The driver ends at its 40 N; 30 N of them are held.
  const Row drive = along_rail(RowKind::driver, 5.0, 40.0);
  const Row tight = along_rail(RowKind::upper, 1.0, 1000.0);
  const Row loose = along_rail(RowKind::upper, 3.0, 1000.0);
  EXPECT_EQ(opposing({drive, loose, tight}, 0), (std::vector<int>{2}));
  const Row weak = along_rail(RowKind::upper, 1.0, 7.0);
  EXPECT_EQ(opposing({drive, weak, tight}, 0), (std::vector<int>{2, 1}));
  EXPECT_EQ(opposing({drive, weak, tight}, 0, 1), (std::vector<int>{2}))
      << "the strongest, where only one fits";
  EXPECT_TRUE(opposing({drive, loose, tight}, 1).empty()) << "that one is met";
  EXPECT_TRUE(opposing({drive}, 3).empty()) << "no such row";
}

TEST(Opposing, NamesTheLevelsAboveAndTheSums) {
  const Row still = along_rail(RowKind::driver, 0.0, 1000.0, 0);
  const Row drive = along_rail(RowKind::driver, 1.0, 1000.0, 1);
  EXPECT_EQ(opposing({still, drive}, 1), (std::vector<int>{0})) << "at rest without any force";
  EXPECT_EQ(opposing({along_rail(RowKind::sum, 0.0, 4.0, 0), drive}, 1), (std::vector<int>{0}));
}

/// The carriage with rows that contradict each other: what it does, how each row ends, and who is to blame.
class Contradictions : public testing::Test {
 protected:
  void solve(const std::vector<Row>& rows, double max_effort = unlimited) {
    rows_ = rows;
    const solver::Model model = solver::test::carriage(max_effort);
    solver_.emplace(model);
    solution_.emplace(model);
    ASSERT_EQ(solver_->solve(solver::State(model), rows, *solution_), solver::Status::ok);
  }
  double acceleration() const { return solution_->qdd[0]; }
  void expect(int row, solver::RowStatus status, double nu, const std::vector<int>& opposing) const {
    const solver::RowSolution& got = solution_->rows[static_cast<std::size_t>(row)];
    const Row& asked = rows_[static_cast<std::size_t>(row)];
    EXPECT_EQ(got.status, status) << to_string(got.status) << ", row " << row;
    EXPECT_NEAR(got.nu, nu, 1e-9) << "row " << row;
    const double missed = acceleration() - asked.b;
    const double residual = asked.kind == RowKind::upper   ? std::max(missed, 0.0)
                            : asked.kind == RowKind::lower ? std::min(missed, 0.0)
                                                           : missed;
    EXPECT_NEAR(got.residual, residual, 1e-9) << "row " << row;
    std::vector<int> names(4);
    names.resize(static_cast<std::size_t>(solver_->opposing(row, names)));
    EXPECT_EQ(names, opposing) << "row " << row;
  }

  static Row equal(double b, double bound, int level = 1) {
    return along_rail(RowKind::driver, b, bound, level);
  }
  static Row at_most(double b, double bound, int level = 1) {
    return along_rail(RowKind::upper, b, bound, level);
  }
  static Row at_least(double b, double bound, int level = 1) {
    return along_rail(RowKind::lower, b, bound, level);
  }

 private:
  std::vector<Row> rows_;
  std::optional<solver::Solver> solver_;
  std::optional<solver::Solution> solution_;
};

using solver::RowStatus;

TEST_F(Contradictions, TwoEqualitiesOfOneForceCancel) {
  // Together they ask nothing of the motor, however weak it is.
  for (const double max_effort : {1e-3, 30.0, 1e9, unlimited}) {
    solve({equal(1.0, 40.0), equal(-1.0, 40.0)}, max_effort);
    EXPECT_NEAR(acceleration(), 0.0, 1e-12);
    expect(0, RowStatus::force_limited, 40.0, {1});
    expect(1, RowStatus::force_limited, -40.0, {0});
  }
}

TEST_F(Contradictions, OfTwoEqualitiesTheOneWithMoreForceWins) {
  // 10 kg at 1 m/s^2, and 7 N against it.
  solve({equal(1.0, 40.0), equal(-1.0, 7.0)});
  expect(0, RowStatus::held, 17.0, {});
  expect(1, RowStatus::force_limited, -7.0, {0});
}

TEST_F(Contradictions, OfTwoEqualitiesOnTwoLevelsTheHigherOneHolds) {
  solve({equal(1.0, 40.0, 1), equal(-1.0, 1000.0, 2)});
  expect(0, RowStatus::held, 10.0, {});
  expect(1, RowStatus::blocked, 0.0, {0});
  solve({equal(-1.0, 1000.0, 2), equal(3.0, 20.0, 1)});
  expect(0, RowStatus::blocked, 0.0, {1});
  expect(1, RowStatus::force_limited, 20.0, {});
}

TEST_F(Contradictions, EqualitiesWithoutBoundsOfTheirOwnConflict) {
  // Each ends at what the motor can do, which nobody intended.
  solve({equal(1.0, unlimited), equal(-1.0, unlimited)}, 30.0);
  EXPECT_NEAR(acceleration(), 0.0, 1e-12);
  expect(0, RowStatus::conflict, 30.0, {1});
  expect(1, RowStatus::conflict, -30.0, {0});
}

TEST_F(Contradictions, ADriverWithoutBoundsOfItsOwnIsTorqueLimited) {
  solve({equal(5.0, unlimited)}, 30.0);
  expect(0, RowStatus::torque_limited, 30.0, {});
}

TEST_F(Contradictions, TwoLimitsOfOneForceCancel) {
  solve({at_most(-1.0, 500.0), at_least(1.0, 500.0)});
  EXPECT_NEAR(acceleration(), 0.0, 1e-12);
  expect(0, RowStatus::conflict, -500.0, {1});
  expect(1, RowStatus::conflict, 500.0, {0});
}

TEST_F(Contradictions, OfTwoLimitsTheOneWithMoreForceWins) {
  solve({at_most(-1.0, 500.0), at_least(1.0, 30.0)});
  expect(0, RowStatus::held, -40.0, {});
  expect(1, RowStatus::conflict, 30.0, {0});
}

TEST_F(Contradictions, OfTwoLimitsWithoutBoundsAccelerationWinsOverPosition) {
  // A position's limit is given 4 times what the motor can do, an acceleration's more.
  Row position = at_most(-1.0, unlimited);
  position.quantity = solver::Quantity::position;
  Row acceleration = at_least(1.0, unlimited);
  acceleration.quantity = solver::Quantity::acceleration;
  solve({position, acceleration}, 30.0);
  expect(0, RowStatus::conflict, -120.0, {1});
  expect(1, RowStatus::held, 130.0, {});
}

TEST_F(Contradictions, OfTwoLimitsOnTwoLevelsTheHigherOneHolds) {
  solve({at_most(-1.0, 50.0, 0), at_least(1.0, 500.0, 1)});
  expect(0, RowStatus::held, -510.0, {});
  expect(1, RowStatus::conflict, 500.0, {0});
  solve({at_most(-1.0, 500.0, 1), at_least(1.0, 50.0, 0)});
  expect(0, RowStatus::conflict, -500.0, {1});
  expect(1, RowStatus::held, 510.0, {});
}

TEST_F(Contradictions, AnEqualityAgainstALimitIsForceLimitedByIt) {
  solve({equal(5.0, 40.0), at_most(1.0, 1000.0)});
  expect(0, RowStatus::force_limited, 40.0, {1});
  expect(1, RowStatus::held, -30.0, {});
}

TEST_F(Contradictions, ALowerLevelIsNeverToBlame) {
  // 5 N are all that the higher limit has: -0.5 m/s^2, with or without the lower one.
  solve({at_most(-1.0, 5.0, 0), at_least(1.0, 500.0, 1)});
  EXPECT_NEAR(acceleration(), -0.5, 1e-12);
  expect(0, RowStatus::conflict, -505.0, {});
  expect(1, RowStatus::conflict, 500.0, {0});
}

TEST(TorqueLimits, ALimitAboveBrakesAForceThatTheMotorAloneCouldNotMake) {
  // 40 N pushed and 30 N held back leave 10 N for a motor of 12 N.
  const auto s = solve_carriage(
      {along_rail(RowKind::upper, 1.0, 500.0, 0), along_rail(RowKind::force, 40.0, 40.0, 1)}, 12.0);
  EXPECT_NEAR(s.rows[1].phi, 1.0, 1e-12);
  EXPECT_NEAR(s.tau[0], 10.0, 1e-12);
  EXPECT_NEAR(s.qdd[0], 1.0, 1e-12);
}

TEST(TorqueLimits, ALimitAboveStaysKeptWhenTheTorqueThatBrakesRunsOut) {
  // A gantry of 10 kg along x and 5 kg along y. The limit on x + y can brake along y with 5 N only, so x has
  // 2 m/s^2 at most, whatever is asked of it.
  solver::ModelBuilder builder(
      solver::BaseType::fixed, "frame",
      solver::RigidInertia::from_com(1.0, solver::Vector3::Zero(), solver::Matrix3::Identity()));
  const auto slide = [](const char* name, const solver::Vector3& axis, double effort) {
    solver::Joint joint;
    joint.name = name;
    joint.type = solver::JointType::prismatic;
    joint.axis = axis;
    joint.actuated = true;
    joint.max_effort = effort;
    return joint;
  };
  const auto carriage =
      solver::RigidInertia::from_com(5.0, solver::Vector3::Zero(), solver::Matrix3::Identity());
  builder.add_link("bridge", "frame", {}, slide("x", solver::Vector3::UnitX(), unlimited), carriage);
  builder.add_link("trolley", "bridge", {}, slide("y", solver::Vector3::UnitY(), 5.0), carriage);
  const solver::Model model = builder.build();
  Row limit;
  limit.kind = RowKind::upper;
  limit.body = 2;
  limit.a.linear = {1.0, 1.0, 0.0};
  limit.b = 1.0;
  limit.lo = -1000.0;
  limit.hi = 0.0;
  limit.level = 0;
  Row drive;
  drive.body = 2;
  drive.a.linear = solver::Vector3::UnitX();
  drive.b = 9.0;
  drive.lo = -1000.0;
  drive.hi = 1000.0;
  solver::Solver solver(model);
  solver::Solution s(model);
  ASSERT_EQ(solver.solve(solver::State(model), {limit, drive}, s), solver::Status::ok);
  EXPECT_NEAR(s.qdd[0], 2.0, 1e-12);
  EXPECT_NEAR(s.qdd[1], -1.0, 1e-12);
  EXPECT_NEAR(s.tau[0], 20.0, 1e-11);
  EXPECT_NEAR(s.tau[1], -5.0, 1e-12);
  EXPECT_EQ(s.rows[0].status, solver::RowStatus::held);
  EXPECT_EQ(s.rows[1].status, solver::RowStatus::torque_limited);
}

TEST(TorqueLimits, ASidewaysDemandDoesNotDragAlongWhatASkidBaseCanDo) {
  Random random(31);
  const solver::Model model = random_model(Robot::skid, random, unlimited);
  Row forward;
  forward.a.linear = solver::Vector3::UnitX();
  forward.b = 1.0;
  forward.lo = -1000.0;
  forward.hi = 1000.0;
  // Sideways at the centre of mass of the whole robot: no wheel moves that.
  solver::Vector3 moment = solver::Vector3::Zero();
  for (const solver::Body& body : model.bodies()) {
    moment += body.inertia.first_moment + body.inertia.mass * body.pose_in_parent.position;
  }
  const double lever = moment.x() / model.total_mass();
  Row sideways = forward;
  sideways.a.linear = solver::Vector3::UnitY();
  sideways.a.angular.z() = lever;
  solver::Solver solver(model);
  solver::Solution alone(model);
  solver::Solution both(model);
  ASSERT_EQ(solver.solve(solver::State(model), {forward}, alone), solver::Status::ok);
  ASSERT_EQ(solver.solve(solver::State(model), {forward, sideways}, both), solver::Status::ok);
  EXPECT_EQ(both.rows[1].status, solver::RowStatus::unreachable);
  EXPECT_LT((both.tau - alone.tau).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(TorqueLimits, ASkidBaseCannotPushSideways) {
  Random random(31);
  const solver::Model model = random_model(Robot::skid, random, unlimited);
  Row row;
  row.body = 0;
  row.a.linear = solver::Vector3::UnitY();
  row.b = 1.0;
  row.lo = -100.0;
  row.hi = 100.0;
  solver::Solver solver(model);
  solver::Solution solution(model);
  ASSERT_EQ(solver.solve(solver::State(model), {row}, solution), solver::Status::ok);
  // The centre of mass lies beside the middle of the wheels, so a little yaw could be made; nothing like
  // this.
  EXPECT_LT(solution.tau.cwiseAbs().maxCoeff(), 100.0);
  EXPECT_TRUE(solution.qdd.allFinite());
  EXPECT_LT(solution.qdd.cwiseAbs().maxCoeff(), 100.0);
}

}  // namespace
}  // namespace zwang::oracle
