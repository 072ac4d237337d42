// Odd input: each kind has its status, and a refusal leaves the outputs as they were.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

#include "law_problem.hpp"

namespace zwang::oracle {
namespace {

using solver::Row;
using solver::RowKind;
using solver::RowStatus;
using solver::Solution;
using solver::State;
using solver::Status;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Row forward(double b = 0.5) {
  Row row;
  row.a.linear = solver::Vector3::UnitX();
  row.b = b;
  row.lo = -1000.0;
  row.hi = 1000.0;
  return row;
}

struct Input {
  State state;
  std::vector<Row> rows;
};

struct Odd {
  const char* name;
  Status status;
  std::function<void(Input&)> spoil;
};

class Refused : public testing::TestWithParam<Odd> {};

TEST_P(Refused, WithItsStatusAndOutputsUntouched) {
  LawProblem p(Robot::mecanum, 3, 20.0);
  solver::Solver solver(p.model, {.row_capacity = 4});
  Solution solution(p.model, 4);
  Input good{p.state, {forward()}};
  ASSERT_EQ(solver.solve(good.state, good.rows, solution), Status::ok);
  const Solution before = solution;

  Input bad = good;
  GetParam().spoil(bad);
  EXPECT_EQ(solver.solve(bad.state, bad.rows, solution), GetParam().status);
  EXPECT_EQ(solution.tau, before.tau);
  EXPECT_EQ(solution.qdd, before.qdd);
  EXPECT_EQ(solution.rows.size(), before.rows.size());
  EXPECT_EQ(solution.rows.front().nu, before.rows.front().nu);
  for (std::size_t i = 0; i < before.acceleration.size(); ++i) {
    EXPECT_EQ(solution.acceleration[i].vector(), before.acceleration[i].vector());
  }
  // And nothing of it stays behind.
  ASSERT_EQ(solver.solve(good.state, good.rows, solution), Status::ok);
  EXPECT_EQ(solution.tau, before.tau);
}

INSTANTIATE_TEST_SUITE_P(
    Inputs, Refused,
    testing::Values(
        Odd{"nan_position", Status::invalid_input, [](Input& i) { i.state.q[1] = nan; }},
        Odd{"infinite_velocity", Status::invalid_input, [](Input& i) { i.state.qd[0] = no_limit; }},
        Odd{"nan_pose", Status::invalid_input, [](Input& i) { i.state.base_pose.rotation(0, 1) = nan; }},
        Odd{"infinite_twist", Status::invalid_input,
            [](Input& i) { i.state.base_twist.linear.y() = -no_limit; }},
        Odd{"nan_wrench", Status::invalid_input, [](Input& i) { i.state.f_ext[2].angular.x() = nan; }},
        Odd{"nan_feed_forward", Status::invalid_input, [](Input& i) { i.state.tau_ff[3] = nan; }},
        Odd{"velocity_beyond_numbers", Status::degenerate_model,
            [](Input& i) { i.state.base_twist.angular.z() = 1e300; }},
        Odd{"too_few_joints", Status::wrong_size, [](Input& i) { i.state.q.conservativeResize(3); }},
        Odd{"too_many_wrenches", Status::wrong_size, [](Input& i) { i.state.f_ext.emplace_back(); }},
        Odd{"no_such_body", Status::wrong_size, [](Input& i) { i.rows[0].body = 5; }},
        Odd{"the_world_moved", Status::wrong_size, [](Input& i) { i.rows[0].body = -1; }},
        Odd{"no_such_reference", Status::wrong_size, [](Input& i) { i.rows[0].reference_body = -2; }},
        Odd{"nan_direction", Status::invalid_input, [](Input& i) { i.rows[0].a.linear.x() = nan; }},
        Odd{"infinite_set_point", Status::invalid_input, [](Input& i) { i.rows[0].b = no_limit; }},
        Odd{"bounds_without_zero", Status::invalid_input, [](Input& i) { i.rows[0].lo = 1.0; }},
        Odd{"no_weight", Status::invalid_input, [](Input& i) { i.rows[0].weight = 0.0; }},
        Odd{"nan_weight", Status::invalid_input, [](Input& i) { i.rows[0].weight = nan; }},
        Odd{"nan_bound", Status::invalid_input, [](Input& i) { i.rows[0].hi = nan; }},
        Odd{"too_many_rows", Status::capacity_exceeded, [](Input& i) { i.rows.resize(5, forward()); }}),
    [](const auto& drawn) { return drawn.param.name; });

class OddRows : public testing::Test {
 protected:
  void solve(const std::vector<Row>& rows) {
    ASSERT_EQ(solver.solve(State(p.model), rows, solution), Status::ok);
    EXPECT_TRUE(solution.tau.allFinite());
    EXPECT_TRUE(solution.qdd.allFinite());
    EXPECT_LE(solution.tau.cwiseAbs().maxCoeff(), 20.0);
  }
  double forward_acceleration() const { return solution.acceleration.front().linear.x(); }
  LawProblem p{Robot::mecanum, 3, 20.0};
  solver::Solver solver{p.model};
  Solution solution{p.model};
};

TEST_F(OddRows, AZeroRowIsUnreachable) {
  Row zero = forward(1.0);
  zero.a = {};
  solve({zero, forward()});
  EXPECT_EQ(solution.rows[0].status, RowStatus::unreachable);
  EXPECT_EQ(solution.rows[0].nu, 0.0);
  EXPECT_NEAR(forward_acceleration(), 0.5, 1e-9);
}

TEST_F(OddRows, DuplicatesShareTheForce) {
  solve({forward()});
  const double alone = solution.rows[0].nu;
  solve({forward(), forward(), forward()});
  for (const solver::RowSolution& row : solution.rows) EXPECT_NEAR(row.nu, alone / 3.0, 1e-9);
  EXPECT_NEAR(forward_acceleration(), 0.5, 1e-9);
}

TEST_F(OddRows, ContradictionsEndAtTheirBounds) {
  Row weak = forward(-0.5);
  weak.lo = -7.0;
  solve({forward(0.5), weak});
  EXPECT_NEAR(solution.rows[1].nu, -7.0, 1e-12);
  EXPECT_NEAR(solution.rows[1].residual, 1.0, 1e-9);
  EXPECT_EQ(solution.rows[1].status, RowStatus::force_limited);
  EXPECT_EQ(solution.rows[0].status, RowStatus::held);
}

TEST_F(OddRows, NearlyParallelOnesDoNotBlowUp) {
  Row turned = forward(0.4);
  turned.a.linear = {1.0, 1e-9, 0.0};
  solve({forward(0.5), turned});
  EXPECT_LT(solution.qdd.cwiseAbs().maxCoeff(), 1e3);
}

TEST_F(OddRows, ARowAgainstItsOwnBodyIsUnreachable) {
  Row own = forward(1.0);
  own.reference_body = own.body;
  own.a_reference = own.a;
  solve({own});
  EXPECT_EQ(solution.rows[0].status, RowStatus::unreachable);
}

TEST_F(OddRows, ASolutionOfAnotherModelIsRefused) {
  const LawProblem other(Robot::arm, 1);
  Solution small(other.model);
  EXPECT_EQ(solver.solve(State(p.model), {forward()}, small), Status::wrong_size);
}

class OddModels : public testing::Test {
 protected:
  static solver::RigidInertia body(double mass, double inertia = 0.1) {
    return solver::RigidInertia::from_com(mass, solver::Vector3::Zero(),
                                          inertia * solver::Matrix3::Identity());
  }
  static void build(const solver::RigidInertia& inertia, const solver::Vector3& axis) {
    solver::ModelBuilder builder(solver::BaseType::fixed, "base", body(1.0));
    solver::Joint joint;
    joint.name = "joint";
    joint.type = solver::JointType::revolute;
    joint.axis = axis;
    builder.add_link("link", "base", {}, joint, inertia);
    (void)builder.build();
  }
  const solver::Vector3 z = solver::Vector3::UnitZ();
};

TEST_F(OddModels, AreRefusedLoudly) {
  EXPECT_NO_THROW(build(body(1.0), z));
  EXPECT_THROW(build(body(0.0), z), std::invalid_argument);
  EXPECT_THROW(build(body(-1.0), z), std::invalid_argument);
  EXPECT_THROW(build(body(nan), z), std::invalid_argument);
  EXPECT_THROW(build(body(1.0, -0.1), z), std::invalid_argument);
  EXPECT_THROW(build(body(1.0), solver::Vector3::Zero()), std::invalid_argument);
  solver::RigidInertia thin = body(1.0);
  thin.rotational = solver::Vector3(0.1, 0.1, 0.5).asDiagonal();
  EXPECT_THROW(build(thin, z), std::invalid_argument) << "no body has more about z than about x and y";
}

TEST_F(OddModels, SettingsThatAreNoneAreRefusedLoudly) {
  const LawProblem p(Robot::arm, 1);
  EXPECT_THROW(solver::Solver(p.model, {.row_capacity = 0}), std::invalid_argument);
  EXPECT_THROW(solver::Solver(p.model, {.max_iterations = 0}), std::invalid_argument);
  EXPECT_THROW(solver::PopovVereshchagin(p.model, {.damping = -1.0}), std::invalid_argument);
  EXPECT_THROW(solver::PopovVereshchagin(p.model, {.damping = nan}), std::invalid_argument);
}

}  // namespace
}  // namespace zwang::oracle
