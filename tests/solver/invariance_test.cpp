// The solution must not depend on the place of the world's frame, the order of rows, or the units.
#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <numeric>
#include <string>

#include "law_problem.hpp"

namespace zwang::oracle {
namespace {

using solver::AxisConstraint;
using solver::Driver;
using solver::JointType;
using solver::Pose;
using solver::Quantity;
using solver::Range;

/// A task in the world's frame that drives, pushes and limits.
std::vector<AxisConstraint> world_task(const Pose& world, const solver::Model& model, Random& random) {
  std::vector<AxisConstraint> task;
  AxisConstraint c;
  c.move = {model.has_fixed_base() ? model.body_count() - 1 : 0, {}};
  c.in = {-1, world};
  c.axis = solver::Axis::x;
  c.driver = Driver{.quantity = Quantity::position, .target = random.uniform(-1.0, 1.0)};
  c.velocity = Range{-0.3, 0.3};
  task.push_back(c);
  c.axis = solver::Axis::y;
  c.driver = Driver{.quantity = Quantity::velocity, .target = 0.2, .force = {-30.0, 30.0}};
  c.velocity.reset();
  c.acceleration = Range{-0.5, 0.5};
  task.push_back(c);
  c.axis = solver::Axis::rz;
  c.driver = Driver{.quantity = Quantity::force, .target = 3.0};
  c.acceleration.reset();
  c.level = 2;
  task.push_back(c);
  return task;
}

solver::Solution solve_task(const solver::Model& model, const solver::State& state,
                            const std::vector<AxisConstraint>& task) {
  solver::ConstraintSet set;
  for (const AxisConstraint& constraint : task) EXPECT_TRUE(set.add(constraint));
  EXPECT_TRUE(set.fill(model, state));
  solver::Solver solver(model);
  solver::Solution solution(model);
  EXPECT_EQ(solver.solve(state, set.rows(), solution), solver::Status::ok);
  return solution;
}

class Invariance : public testing::TestWithParam<Robot> {};

TEST_P(Invariance, TurningAndShiftingTheWorldAboutTheVerticalChangesNoTorque) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    LawProblem p(GetParam(), seed, 15.0);
    const Pose frame{solver::rotation_from_rpy(0.0, 0.0, p.random.uniform(-3.0, 3.0)), p.random.vector(1.0)};
    const Pose shift{solver::rotation_from_rpy(0.0, 0.0, p.random.uniform(-3.0, 3.0)), p.random.vector(5.0)};
    Random drawn(seed);
    Random again(seed);
    const solver::Solution here = solve_task(p.model, p.state, world_task(frame, p.model, drawn));
    solver::State there = p.state;
    there.base_pose = shift * p.state.base_pose;
    const solver::Solution moved = solve_task(p.model, there, world_task(shift * frame, p.model, again));
    EXPECT_LT(relative_difference(moved.tau, here.tau), 1e-9) << "seed " << seed;
    EXPECT_LT(relative_difference(moved.qdd, here.qdd), 1e-9) << "seed " << seed;
  }
}

TEST_P(Invariance, TheOrderOfRowsDoesNotMatter) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    LawProblem p(GetParam(), seed, 15.0);
    const std::vector<solver::Row> rows = p.rows({.count = 7, .levels = 3});
    std::vector<std::size_t> order(rows.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = order.size() - 1; i > 0; --i) {
      std::swap(order[i], order[static_cast<std::size_t>(p.random.pick(0, static_cast<int>(i)))]);
    }
    std::vector<solver::Row> shuffled;
    for (const std::size_t i : order) shuffled.push_back(rows[i]);

    solver::Solver solver(p.model);
    solver::Solution first(p.model);
    solver::Solution second(p.model);
    ASSERT_EQ(solver.solve(p.state, rows, first), solver::Status::ok);
    ASSERT_EQ(solver.solve(p.state, shuffled, second), solver::Status::ok);
    EXPECT_LT(relative_difference(second.tau, first.tau), 1e-9) << "seed " << seed;
    EXPECT_LT(relative_difference(second.qdd, first.qdd), 1e-9) << "seed " << seed;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const solver::RowSolution& a = first.rows[order[i]];
      const solver::RowSolution& b = second.rows[i];
      EXPECT_NEAR(a.nu, b.nu, 1e-8 * (1.0 + std::abs(a.nu))) << "seed " << seed << " row " << order[i];
      EXPECT_EQ(a.status, b.status) << "seed " << seed << " row " << order[i];
    }
  }
}

// A level is a rank. A robot's runtime holds the joints that no task uses above the levels of task files, at
// -1.
TEST_P(Invariance, OnlyTheOrderOfLevelsMatters) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    LawProblem p(GetParam(), seed, 15.0);
    const std::vector<solver::Row> rows = p.rows({.count = 7, .levels = 3});
    solver::Solver solver(p.model);
    solver::Solution first(p.model);
    ASSERT_EQ(solver.solve(p.state, rows, first), solver::Status::ok);
    for (const int by : {-1, -2, -100, 100}) {
      std::vector<solver::Row> shifted = rows;
      for (solver::Row& row : shifted) row.level += by;
      solver::Solution second(p.model);
      ASSERT_EQ(solver.solve(p.state, shifted, second), solver::Status::ok);
      EXPECT_EQ(second.tau, first.tau) << "seed " << seed << " by " << by;
    }
  }
}

/// How many of the new unit one of the old is.
struct Units {
  double length, mass, time;
  double speed() const { return length / time; }
  double acceleration() const { return length / (time * time); }
  double force() const { return mass * acceleration(); }
  double torque() const { return force() * length; }
  double inertia() const { return mass * length * length; }
};

solver::RigidInertia in_units(const solver::RigidInertia& I, const Units& u) {
  return {I.mass * u.mass, I.first_moment * u.mass * u.length, I.rotational * u.inertia()};
}

Pose in_units(const Pose& pose, const Units& u) {
  return {pose.rotation, pose.position * u.length};
}

solver::Model in_units(const solver::Model& model, const Units& u) {
  const auto& bodies = model.bodies();
  solver::ModelBuilder builder(model.base_type(), bodies.front().name, in_units(bodies.front().inertia, u));
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const solver::Body& body = bodies[i];
    const bool slides = body.joint.type == JointType::prismatic;
    solver::Joint joint = body.joint;
    joint.rotor_inertia *= slides ? u.mass : u.inertia();
    joint.max_effort *= slides ? u.force() : u.torque();
    builder.add_link(body.name, bodies[static_cast<std::size_t>(body.parent)].name,
                     in_units(body.pose_in_parent, u), joint, in_units(body.inertia, u));
  }
  for (solver::Wheel wheel : model.wheels()) {
    wheel.radius *= u.length;
    builder.add_wheel(bodies[static_cast<std::size_t>(wheel.body)].joint.name, wheel);
  }
  builder.set_gravity(model.gravity() * u.acceleration());
  return builder.build();
}

bool slides(const solver::Model& model, Eigen::Index joint) {
  return model.joint(static_cast<int>(joint)).type == JointType::prismatic;
}

solver::State in_units(const solver::Model& model, const solver::State& state, const Units& u) {
  solver::State out = state;
  for (Eigen::Index j = 0; j < state.q.size(); ++j) {
    out.q[j] *= slides(model, j) ? u.length : 1.0;
    out.qd[j] *= slides(model, j) ? u.speed() : 1.0 / u.time;
    out.tau_ff[j] *= slides(model, j) ? u.force() : u.torque();
  }
  out.base_pose = in_units(state.base_pose, u);
  out.base_twist = {state.base_twist.angular / u.time, state.base_twist.linear * u.speed()};
  for (solver::ForceVector& f : out.f_ext) f = {f.angular * u.torque(), f.linear * u.force()};
  return out;
}

/// Every row as one on lengths: its moment has a lever in it.
std::vector<solver::Row> in_units(std::vector<solver::Row> rows, const Units& u) {
  for (solver::Row& row : rows) {
    row.a.angular *= u.length;
    row.a_reference.angular *= u.length;
    row.b *= u.acceleration();
    row.force *= u.force();
    row.lo *= u.force();
    row.hi *= u.force();
    row.weight *= u.mass;
  }
  return rows;
}

double condition_of_inertia(const solver::Model& model, const solver::State& state) {
  const Eigen::MatrixXd M = DenseDynamics(model, state).M.cast<double>();
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(M).singularValues();
  return values(0) / values(values.size() - 1);
}

TEST_P(Invariance, UnitsDoNotMatter) {
  const Units units[] = {{1000.0, 1.0, 1.0}, {1.0, 0.001, 1.0}, {1.0, 1.0, 60.0}, {39.37, 2.2046, 0.1}};
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    LawProblem p(GetParam(), seed, 15.0);
    const std::vector<solver::Row> rows = p.rows({.count = 4, .levels = 2});
    solver::Solver solver(p.model);
    solver::Solution si(p.model);
    ASSERT_EQ(solver.solve(p.state, rows, si), solver::Status::ok);
    for (const Units& u : units) {
      const solver::Model model = in_units(p.model, u);
      solver::Solver scaled(model);
      solver::Solution other(model);
      ASSERT_EQ(scaled.solve(in_units(p.model, p.state, u), in_units(rows, u), other), solver::Status::ok);
      Eigen::VectorXd tau = other.tau;
      Eigen::VectorXd qdd = other.qdd;
      for (Eigen::Index j = 0; j < tau.size(); ++j) {
        tau[j] /= slides(model, j) ? u.force() : u.torque();
        qdd[j] /= slides(model, j) ? u.acceleration() : 1.0 / (u.time * u.time);
      }
      // Two roundings of one problem differ by the condition of its mass matrix in either system of units.
      const double condition = std::max(condition_of_inertia(p.model, p.state),
                                        condition_of_inertia(model, in_units(p.model, p.state, u)));
      const double tolerance = condition < 1e5 ? 1e-9 : 1e-7;
      const auto problem = [&] {
        return "seed " + std::to_string(seed) + ", condition " + std::to_string(condition);
      };
      EXPECT_LT(relative_difference(tau, si.tau), tolerance) << problem();
      EXPECT_LT(relative_difference(qdd, si.qdd), tolerance) << problem();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, Invariance, testing::ValuesIn(all_robots),
                         [](const auto& drawn) { return to_string(drawn.param); });

}  // namespace
}  // namespace zwang::oracle
