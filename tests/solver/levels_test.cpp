// The solver's levels, softness and torque limits where a formula answers: a carriage of 10 kg on a rail, and
// a skid-steered base that cannot push sideways.
#include <gtest/gtest.h>

#include <limits>

#include "oracle/random_problem.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::oracle {
namespace {

using solver::Row;
using solver::RowKind;

constexpr double unlimited = std::numeric_limits<double>::infinity();

solver::Model carriage(double max_effort) {
  solver::ModelBuilder builder(
      solver::BaseType::fixed, "rail",
      solver::RigidInertia::from_com(1.0, solver::Vector3::Zero(), solver::Matrix3::Identity()));
  solver::Joint joint;
  joint.name = "slide";
  joint.type = solver::JointType::prismatic;
  joint.actuated = true;
  joint.max_effort = max_effort;
  builder.add_link(
      "carriage", "rail", {}, joint,
      solver::RigidInertia::from_com(10.0, solver::Vector3::Zero(), solver::Matrix3::Identity()));
  return builder.build();
}

Row along_x(RowKind kind, double b_or_force, double bound, int level, double fade = 1.0) {
  Row row;
  row.kind = kind;
  row.body = 1;
  row.a.linear = solver::Vector3::UnitX();
  (kind == RowKind::force ? row.force : row.b) = b_or_force;
  row.lo = kind == RowKind::lower ? 0.0 : -bound;
  row.hi = kind == RowKind::upper ? 0.0 : bound;
  row.level = level;
  row.fade = fade;
  return row;
}

solver::Solution solve_carriage(const std::vector<Row>& rows, double max_effort = unlimited) {
  const solver::Model model = carriage(max_effort);
  solver::Solver solver(model);
  solver::Solution solution(model);
  EXPECT_EQ(solver.solve(solver::State(model), rows, solution), solver::Status::ok);
  return solution;
}

TEST(Levels, ASaturatedForceIsNotAddedToFromBelow) {
  const auto s =
      solve_carriage({along_x(RowKind::driver, 5.0, 15.0, 0), along_x(RowKind::driver, 9.0, 50.0, 1)});
  EXPECT_NEAR(s.tau[0], 15.0, 1e-12);
}

TEST(Levels, ALimitAboveHoldsAgainstMoreForceThanItsOwn) {
  // The limit's own force is 5 N at most; a push of 40 N from below would be 4 m/s^2.
  const auto s =
      solve_carriage({along_x(RowKind::upper, 1.0, 5.0, 0), along_x(RowKind::force, 40.0, 40.0, 1)});
  EXPECT_NEAR(s.qdd[0], 1.0, 1e-12);
}

TEST(Levels, AFadingDriverAboveStillResistsAForceBelow) {
  // L = R = 0.1: L (mu + 4) + R mu = 2, so mu = 8 and 12 N in all.
  const auto s =
      solve_carriage({along_x(RowKind::driver, 2.0, 50.0, 0, 0.5), along_x(RowKind::force, 4.0, 4.0, 1)});
  EXPECT_NEAR(s.tau[0], 12.0, 1e-12);
}

TEST(Levels, AFadingForceAboveResistsAForceBelow) {
  // 0.5 * 6 N above; L (mu + 4) + R mu = 0 below, so mu = -2 and 5 N in all.
  const auto s =
      solve_carriage({along_x(RowKind::force, 6.0, 6.0, 0, 0.5), along_x(RowKind::force, 4.0, 4.0, 1)});
  EXPECT_NEAR(s.tau[0], 5.0, 1e-12);
}

TEST(Levels, ALevelThatAsksNothingChangesNothing) {
  const Row nothing = along_x(RowKind::force, 0.0, 0.0, 1);
  for (const double fade : {1.0, 0.5, 0.1}) {
    for (const double bound : {500.0, 4.0}) {
      for (const RowKind kind : {RowKind::driver, RowKind::lower}) {
        const Row row = along_x(kind, 2.0, bound, 0, fade);
        const auto alone = solve_carriage({row});
        const auto both = solve_carriage({row, nothing});
        EXPECT_NEAR(both.tau[0], alone.tau[0], 1e-12) << "fade " << fade << ", bound " << bound << ", "
                                                      << (kind == RowKind::lower ? "lower" : "driver");
      }
    }
  }
}

TEST(TorqueLimits, ALimitAboveBrakesAForceThatTheMotorAloneCouldNotMake) {
  // 40 N pushed and 30 N held back leave 10 N for a motor of 12 N.
  const auto s =
      solve_carriage({along_x(RowKind::upper, 1.0, 500.0, 0), along_x(RowKind::force, 40.0, 40.0, 1)}, 12.0);
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
