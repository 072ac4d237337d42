// A mecanum base against closed formulas: what a push, a limit and a torque limit do to it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "robots.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::solver {
namespace {

using test::MecanumFigures;

AxisConstraint on_base(Axis axis) {
  AxisConstraint constraint;
  constraint.move.body = 0;
  constraint.in.body = 0;
  constraint.axis = axis;
  return constraint;
}

AxisConstraint drive(Axis axis, Quantity quantity, double target, Range force = {}) {
  AxisConstraint constraint = on_base(axis);
  constraint.driver = Driver{.quantity = quantity, .target = target, .force = force};
  return constraint;
}

class MecanumTest : public ::testing::Test {
 protected:
  Status solve(std::initializer_list<AxisConstraint> constraints) {
    set.clear();
    for (const AxisConstraint& constraint : constraints) EXPECT_TRUE(set.add(constraint));
    EXPECT_TRUE(set.fill(model, state));
    return solver.solve(state, set.rows(), solution);
  }
  MotionVector base() const { return solution.acceleration.front(); }

  MecanumFigures figures;
  Model model = test::mecanum(figures);
  State state{model};
  Solver solver{model};
  Solution solution{model};
  ConstraintSet set;
};

TEST_F(MecanumTest, HasThreeFreedoms) {
  ASSERT_EQ(solve({}), Status::ok);
  EXPECT_EQ(solution.mobility, 3);
}

TEST_F(MecanumTest, PushAcceleratesTheApparentMass) {
  ASSERT_EQ(solve({drive(Axis::x, Quantity::force, 20.0)}), Status::ok);
  EXPECT_NEAR(base().linear.x(), 20.0 / figures.apparent_mass(), 1e-10);
  EXPECT_NEAR(base().linear.y(), 0.0, 1e-10);
  EXPECT_NEAR(base().angular.z(), 0.0, 1e-10);
  // Four equal wheels roll the push: each carries a quarter of the force at its radius.
  for (int j = 0; j < 4; ++j) EXPECT_NEAR(solution.tau(j), 20.0 * figures.radius / 4.0, 1e-9);
  EXPECT_NEAR(solution.rows[0].nu, 20.0, 1e-12);
}

TEST_F(MecanumTest, TurnMovesTheApparentInertia) {
  ASSERT_EQ(solve({drive(Axis::rz, Quantity::acceleration, 0.7)}), Status::ok);
  EXPECT_NEAR(base().angular.z(), 0.7, 1e-10);
  EXPECT_NEAR(solution.rows[0].nu, 0.7 * figures.apparent_yaw_inertia(), 1e-8);
  EXPECT_EQ(solution.rows[0].status, RowStatus::held);
}

TEST_F(MecanumTest, ForceRangeBoundsTheMultiplier) {
  ASSERT_EQ(solve({drive(Axis::x, Quantity::acceleration, 1.0, {-15.0, 15.0})}), Status::ok);
  EXPECT_NEAR(base().linear.x(), 15.0 / figures.apparent_mass(), 1e-10);
  EXPECT_TRUE(solution.rows[0].saturated);
  EXPECT_EQ(solution.rows[0].status, RowStatus::force_limited);
  EXPECT_NEAR(solution.rows[0].residual, 15.0 / figures.apparent_mass() - 1.0, 1e-10);
}

TEST_F(MecanumTest, VelocityRangeHoldsBackAPush) {
  state.base_twist.linear.x() = 0.0799;
  for (int j = 0; j < 4; ++j) state.qd(j) = 0.0799 / figures.radius;
  AxisConstraint push = drive(Axis::x, Quantity::force, 20.0);
  push.velocity = Range{-0.05, 0.08};
  ASSERT_EQ(solve({push}), Status::ok);
  EXPECT_NEAR(base().linear.x(), (0.08 - 0.0799) / limit_horizon, 1e-9);
  EXPECT_NEAR(solution.rows[0].nu, 20.0, 1e-12);
}

TEST_F(MecanumTest, TorqueLimitScalesPhi) {
  const double most = 4.0 * figures.effort / figures.radius;
  ASSERT_EQ(solve({drive(Axis::x, Quantity::force, 2.0 * most)}), Status::ok);
  EXPECT_NEAR(solution.rows[0].phi, 0.5, 1e-9);
  EXPECT_TRUE(solution.rows[0].saturated);
  for (int j = 0; j < 4; ++j) EXPECT_NEAR(solution.tau(j), figures.effort, 1e-9);
}

TEST_F(MecanumTest, TorqueLimitIsNeverExceededByDrivers) {
  ASSERT_EQ(
      solve({drive(Axis::x, Quantity::acceleration, 50.0), drive(Axis::y, Quantity::acceleration, -30.0),
             drive(Axis::rz, Quantity::acceleration, 80.0)}),
      Status::ok);
  for (int j = 0; j < 4; ++j) EXPECT_LE(std::abs(solution.tau(j)), figures.effort);
  EXPECT_EQ(solution.rows[0].status, RowStatus::torque_limited);
}

TEST_F(MecanumTest, HigherLevelForceKeepsItsPush) {
  AxisConstraint first = drive(Axis::x, Quantity::acceleration, 1.0, {-15.0, 15.0});
  first.level = 0;
  AxisConstraint second = drive(Axis::x, Quantity::acceleration, 3.0, {-50.0, 50.0});
  ASSERT_EQ(solve({first, second}), Status::ok);
  EXPECT_NEAR(base().linear.x(), 15.0 / figures.apparent_mass(), 1e-10);
  EXPECT_EQ(solution.rows[1].status, RowStatus::blocked);
}

TEST_F(MecanumTest, DuplicateRowsShareTheForceEvenly) {
  ASSERT_EQ(solve({drive(Axis::x, Quantity::acceleration, 0.5), drive(Axis::x, Quantity::acceleration, 0.5)}),
            Status::ok);
  EXPECT_NEAR(base().linear.x(), 0.5, 1e-10);
  EXPECT_NEAR(solution.rows[0].nu, 0.25 * figures.apparent_mass(), 1e-8);
  EXPECT_NEAR(solution.rows[1].nu, 0.25 * figures.apparent_mass(), 1e-8);
}

/// Two axes that are a small angle apart tell the acceleration across with a precision of rounding / angle,
/// where V V' of both leaves rounding / angle^2.
TEST(MecanumAxes, ThatAreNearlyOneKeepTheDigitsThatTheirAngleLeaves) {
  const Model model = test::mecanum({.effort = infinity});
  for (const double angle : {0.03, 0.01}) {
    Row along;
    along.a.linear = Vector3::UnitX();
    along.b = 1.0;
    along.lo = -1e6;
    along.hi = 1e6;
    Row askew = along;
    askew.a.linear = {std::cos(angle), std::sin(angle), 0.0};
    askew.b = std::cos(angle) + 0.5 * std::sin(angle);
    Row turn = along;
    turn.a.linear.setZero();
    turn.a.angular.z() = 1.0;
    Solver solver(model);
    Solution s(model);
    ASSERT_EQ(solver.solve(State(model), {along, askew, turn}, s), Status::ok);
    const double rounding = 16.0 * std::numeric_limits<double>::epsilon() / 2.0 / angle;
    EXPECT_NEAR(s.acceleration[0].linear.y(), 0.5, rounding) << angle;
  }
}

TEST_F(MecanumTest, HeightIsTheGrounds) {
  ASSERT_EQ(solve({drive(Axis::z, Quantity::acceleration, 1.0)}), Status::ok);
  EXPECT_EQ(solution.rows[0].status, RowStatus::unreachable);
}

TEST_F(MecanumTest, ProjectionKeepsRollingMotionAndRemovesSlip) {
  state.base_twist.linear = {0.3, -0.2, 0.0};
  for (int j = 0; j < 4; ++j) {
    const double sign = j == 0 || j == 3 ? -1.0 : 1.0;
    state.qd(j) = (0.3 + sign * -0.2) / figures.radius;
  }
  State rolling = state;
  ASSERT_EQ(solver.project_velocity(rolling), Status::ok);
  EXPECT_LT((rolling.qd - state.qd).norm(), 1e-10);
  EXPECT_LT((rolling.base_twist.linear - state.base_twist.linear).norm(), 1e-10);

  State slipping = state;
  slipping.qd(2) += 0.05;
  slipping.base_twist.linear.z() = 0.01;
  ASSERT_EQ(solver.project_velocity(slipping), Status::ok);
  State again = slipping;
  ASSERT_EQ(solver.project_velocity(again), Status::ok);
  EXPECT_LT((again.qd - slipping.qd).norm(), 1e-12);
  EXPECT_NEAR(slipping.base_twist.linear.z(), 0.0, 1e-12);
}

TEST_F(MecanumTest, RefusesNumbersThatAreNotFinite) {
  state.qd(1) = std::nan("");
  const Eigen::VectorXd before = solution.tau;
  EXPECT_EQ(solver.solve(state, std::vector<Row>{}, solution), Status::invalid_input);
  EXPECT_EQ(before, solution.tau);
}

}  // namespace
}  // namespace zwang::solver
