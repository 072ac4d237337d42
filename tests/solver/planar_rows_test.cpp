// The rows that regions, sums, springs and speed limits need, and the curve that a range brakes along.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "law_problem.hpp"
#include "robots.hpp"

namespace zwang::oracle {
namespace {

using solver::Axis;
using solver::AxisConstraint;
using solver::Measure;
using solver::Quantity;
using solver::Range;
using solver::Row;
using solver::RowKind;
using solver::Vector3;

class PlanarRows : public testing::Test {
 protected:
  PlanarRows() {
    state.base_pose.rotation = solver::rotation_from_rpy(0.0, 0.0, 0.7);
    state.base_pose.position = {0.3, -0.2, 0.0};
    base.move.body = 0;
  }
  const solver::Coordinate& only() const { return set.coordinates()[0]; }
  solver::Model model = solver::test::mecanum({});
  solver::State state{model};
  solver::ConstraintSet set;
  AxisConstraint base;
};

TEST_F(PlanarRows, TheSpeedHasOneRowAlongTheMotion) {
  state.base_twist.linear = {0.3, 0.4, 0.0};
  base.measure = Measure::speed;
  base.velocity = Range{0.0, 0.6};
  ASSERT_TRUE(set.add(base));
  ASSERT_TRUE(set.fill(model, state));
  // The lower end, 0, says nothing of a length.
  ASSERT_EQ(set.rows().size(), 1u);
  const Row& row = set.rows()[0];
  EXPECT_EQ(row.kind, RowKind::upper);
  EXPECT_NEAR((row.a.linear - Vector3(0.6, 0.8, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(only().velocity, 0.5, 1e-12);
  EXPECT_NEAR(row.b + only().acceleration_bias, (0.6 - 0.5) / 0.010, 1e-9);
  state.base_twist.linear *= 0.5;
  ASSERT_TRUE(set.fill(model, state));
  EXPECT_TRUE(set.rows().empty()) << "0.25 m/s is below half of the limit";
}

TEST_F(PlanarRows, ACornerOfTheFootprintAtAnEdge) {
  // d = n.(p - e), kept at or above the margin: one lower row with the braking curve.
  const double slope = std::numbers::pi / 6.0;
  base.move.pose.position = {0.4, 0.25, 0.0};
  base.in.pose.position = {2.0, 0.0, 0.0};
  base.measure = Measure::direction;
  base.coefficients = {-std::cos(slope), -std::sin(slope), 0, 0, 0, 0};
  base.position = Range{0.1, solver::infinity};
  base.braking = 0.5;
  ASSERT_TRUE(set.add(base));
  ASSERT_TRUE(set.fill(model, state));
  ASSERT_EQ(set.rows().size(), 1u);
  const Vector3 corner = state.base_pose * base.move.pose.position;
  const double d = -std::cos(slope) * (corner.x() - 2.0) - std::sin(slope) * corner.y();
  EXPECT_NEAR(only().position, d, 1e-12);
  EXPECT_EQ(set.rows()[0].kind, RowKind::lower);
  EXPECT_NEAR(set.rows()[0].b, -solver::braking_speed(d - 0.1, 0.5, 0.010) / 0.010, 1e-9);
}

TEST_F(PlanarRows, OutsideOfAPositionRangeTheWayBackHasItsSpeed) {
  // d < 0: b = min(-v/h, max((-min(v_brk(|d|), v_ret) - v)/h, -a_brk)), v the speed outwards.
  state.base_twist.linear = {0.2, 0.0, 0.0};
  base.position = Range{-solver::infinity, 0.0};
  base.move.pose.position = {1000.0, 0.0, 0.0};
  ASSERT_TRUE(set.add(base));
  ASSERT_TRUE(set.fill(model, state));
  const double h = 0.010, v = only().velocity;
  for (const double braking : {0.5, 1e3}) {
    for (const double v_ret : {0.0, 0.1, solver::infinity}) {
      set[0].braking = braking;
      set[0].return_speed = v_ret;
      ASSERT_TRUE(set.fill(model, state));
      const double d = only().position;
      ASSERT_GT(d, 100.0);
      const double back = std::min(std::sqrt(2.0 * 0.72 * braking * d), v_ret);
      const double asked = set.rows()[0].b + only().acceleration_bias;
      EXPECT_NEAR(asked, std::min(-v / h, std::max((-back - v) / h, -braking)),
                  1e-3 * (1.0 + std::abs(asked)));
    }
  }
}

constexpr double horizon = 0.010;  // [s]

// Along the curve v dv/dd is the deceleration: 0.72 of what may be used, less where d < d0 = 16 a h^2.
TEST(BrakingCurve, DeceleratesWithItsShareAndStopsAtTheBound) {
  const double most = 0.5, a = 0.72 * most, d0 = 16.0 * a * horizon * horizon;
  const auto v = [&](double d) { return solver::braking_speed(d, most, horizon); };
  for (const double d : {1.01 * d0, 2.0 * d0, 0.1, 1.0, 10.0}) {
    EXPECT_NEAR(d, 0.5 * v(d) * v(d) / a + 0.5 * d0, 1e-12 * d) << "v^2 / 2a, and the end";
    const double step = 1e-5 * d;
    EXPECT_NEAR(v(d) * (v(d + step) - v(d - step)) / (2.0 * step), a, 1e-6 * a);
  }
  EXPECT_NEAR(v(0.5 * d0), 0.5 * d0 / (4.0 * horizon), 1e-15);
  EXPECT_NEAR(v(d0 * (1.0 - 1e-9)), v(d0 * (1.0 + 1e-9)), 1e-10);
  EXPECT_EQ(v(0.0), 0.0);
  EXPECT_EQ(v(-0.3), -v(0.3));
}

TEST(BrakingCurve, IsReadTheOtherWayByTheDistance) {
  for (const double braking : {0.05, 0.5, 3.0}) {
    for (const double v : {0.0, 1e-4, 0.003, 0.02, 0.3, 2.0, -0.3}) {
      const double d = solver::braking_distance(v, braking, horizon);
      EXPECT_NEAR(solver::braking_speed(d, braking, horizon), v, 1e-12 * std::abs(v)) << braking << " " << v;
    }
  }
}

/// How far a base gets past a bound when it does 1/heavier of what its row asks for, which is not more than
/// `most`. [m]
double past_the_bound(double heavier, double most) {
  const double tick = 0.001;
  double d = 1.0, v = 0.5, least = d;
  for (int i = 0; i < 10000; ++i) {
    const double asked = (solver::braking_speed(d, most, horizon) - v) / horizon;
    v += tick * std::clamp(asked, -most, 0.0) / heavier;
    d -= tick * v;
    least = std::min(least, d);
  }
  EXPECT_LT(least, 0.01) << "it never came there";
  return std::max(0.0, -least);
}

TEST(BrakingCurve, LeavesABaseThatIsThirtyPercentHeavierEnoughToFollowIt) {
  for (const double most : {0.3, 0.5, 1.0, 2.0}) {
    EXPECT_LE(past_the_bound(1.3, most), 1e-3) << most;
    EXPECT_LE(past_the_bound(1.0, most), 1e-4) << most;
    EXPECT_LE(past_the_bound(0.7, most), 1e-4) << most;
    EXPECT_GT(past_the_bound(1.5, most), 1e-3) << "1.5 x 0.72 is more than the range, " << most;
  }
}

TEST_F(PlanarRows, ACornerOfTheRegionAtAnEdgeOfTheFootprint) {
  // F in the world, T on the base: the row acts on the base with the opposite force.
  AxisConstraint c;
  c.move.pose.position = {1.5, 0.4, 0.0};
  c.in = {0, {solver::Matrix3::Identity(), {0.4, 0.0, 0.0}}};
  c.position = Range{0.05, solver::infinity};
  ASSERT_TRUE(set.add(c));
  ASSERT_TRUE(set.fill(model, state));
  ASSERT_EQ(set.rows().size(), 1u);
  const Row& row = set.rows()[0];
  EXPECT_EQ(row.body, 0);
  EXPECT_EQ(row.reference_body, -1);
  EXPECT_NEAR((row.a.linear - Vector3(-1.0, 0.0, 0.0)).norm(), 0.0, 1e-12);
  // Two frames of the world concern no body.
  set[0].in.body = -1;
  ASSERT_TRUE(set.fill(model, state));
  EXPECT_TRUE(set.rows().empty());
}

TEST_F(PlanarRows, AForceRangeWithoutADriverIsASum) {
  base.force = Range{-40.0, 40.0};
  base.level = 0;
  ASSERT_TRUE(set.add(base));
  ASSERT_TRUE(set.fill(model, state));
  ASSERT_EQ(set.rows().size(), 1u);
  EXPECT_EQ(set.rows()[0].kind, RowKind::sum);
  EXPECT_EQ(set.rows()[0].hi, 40.0);
  set[0].driver = solver::Driver{.target = 0.2, .force = {-60.0, 30.0}};
  ASSERT_TRUE(set.fill(model, state));
  ASSERT_EQ(set.rows().size(), 1u);
  EXPECT_EQ(set.rows()[0].kind, RowKind::driver);
  EXPECT_EQ(set.rows()[0].lo, -40.0);
  EXPECT_EQ(set.rows()[0].hi, 30.0);
}

TEST_F(PlanarRows, AnAxisAndItsSumPressWithTheSumAtMost) {
  AxisConstraint limit = base;
  limit.force = Range{-40.0, 40.0};
  limit.level = 0;
  AxisConstraint drive = base;
  drive.driver = solver::Driver{.target = 5.0, .force = {-60.0, 60.0}};
  AxisConstraint push = base;
  push.driver = solver::Driver{.quantity = Quantity::force, .target = 15.0};
  for (const AxisConstraint& c : {limit, drive, push}) ASSERT_TRUE(set.add(c));
  ASSERT_TRUE(set.fill(model, state));
  solver::Solver solver(model);
  solver::Solution solution(model);
  ASSERT_EQ(solver.solve(state, set.rows(), solution), solver::Status::ok);
  EXPECT_NEAR(solution.rows[0].nu, 40.0, 1e-9);
  EXPECT_NEAR(solution.rows[1].nu, 25.0, 1e-9);
  EXPECT_NEAR(solution.rows[2].nu, 15.0, 1e-9);
}

TEST_F(PlanarRows, ASpringIsAForceRow) {
  base.driver = solver::Driver{.quantity = Quantity::position, .target = 0.5, .force = {-30.0, 30.0}};
  base.driver->stiffness = 100.0;
  base.driver->damping = 20.0;
  state.base_twist.linear = {0.1, 0.0, 0.0};
  ASSERT_TRUE(set.add(base));
  ASSERT_TRUE(set.fill(model, state));
  ASSERT_EQ(set.rows().size(), 1u);
  EXPECT_EQ(set.rows()[0].kind, RowKind::force);
  EXPECT_NEAR(set.rows()[0].force, 100.0 * (0.5 - 0.3) - 20.0 * 0.1 * std::cos(0.7), 1e-12);
  set[0].driver->target = 3.0;
  ASSERT_TRUE(set.fill(model, state));
  EXPECT_EQ(set.rows()[0].force, 30.0);
}

}  // namespace
}  // namespace zwang::oracle
