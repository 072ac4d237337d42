// Properties that a control loop relies on: no heap call inside the step, and the same bits for the same
// input.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <random>
#include <span>

#include "law_problem.hpp"
#include "malloc_counter.hpp"
#include "robots.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::solver {
namespace {

/// A busy problem of three levels. It has a force row with a velocity range, bounded drivers and a soft row.
/// The sum of forces and the speed are limited, and torque limits are in reach.
void pose(const Model& model, std::mt19937& random, State& state, ConstraintSet& set) {
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  state.base_twist.linear = {0.2 * number(random), 0.2 * number(random), 0.0};
  state.base_twist.angular.z() = number(random);
  for (int j = 0; j < model.joint_count(); ++j) state.qd(j) = 3.0 * number(random);
  set.clear();
  AxisConstraint constraint;
  constraint.move.body = 0;
  constraint.in.body = 0;
  constraint.driver = Driver{.quantity = Quantity::force, .target = 200.0 * number(random)};
  constraint.velocity = Range{-0.1, 0.1};
  ASSERT_TRUE(set.add(constraint));
  constraint.axis = Axis::y;
  constraint.velocity.reset();
  constraint.driver =
      Driver{.quantity = Quantity::velocity, .target = number(random), .force = {-40.0, 40.0}};
  ASSERT_TRUE(set.add(constraint));
  constraint.axis = Axis::rz;
  constraint.level = 2;
  ASSERT_TRUE(set.add(constraint));
  constraint.in.body = -1;
  constraint.axis = Axis::x;
  constraint.driver = Driver{.quantity = Quantity::position, .target = number(random)};
  constraint.weight = 20.0;
  ASSERT_TRUE(set.add(constraint));
  AxisConstraint sum;
  sum.move.body = sum.in.body = 0;
  sum.force = Range{-50.0, 50.0};
  sum.level = 0;
  ASSERT_TRUE(set.add(sum));
  AxisConstraint speed;
  speed.move.body = 0;
  speed.measure = Measure::speed;
  speed.velocity = Range{0.0, 0.2};
  speed.level = 0;
  ASSERT_TRUE(set.add(speed));
}

TEST(RealTime, TheStepMakesNoHeapCall) {
  if (!zwang::test::can_count_heap_calls()) GTEST_SKIP() << "a sanitizer owns malloc";
  const Model model = test::mecanum({});
  State state(model);
  ConstraintSet set;
  Solver solver(model);
  Solution solution(model);
  std::mt19937 random(7);
  zwang::test::start_counting_heap_calls();
  void* volatile block = std::malloc(8);
  std::free(block);
  EXPECT_GT(zwang::test::stop_counting_heap_calls(), 0) << "the counter does not count";

  long calls = 0;
  long opposed = 0;
  bool solved = true;
  std::vector<int> opposing(8);
  for (int i = 0; i < 2000; ++i) {
    pose(model, random, state, set);
    zwang::test::start_counting_heap_calls();
    solved = solver.project_velocity(state) == Status::ok && solved;
    solved = set.fill(model, state) && solved;
    solved = solver.solve(state, set.rows(), solution) == Status::ok && solved;
    for (int row = 0; row < static_cast<int>(set.rows().size()); ++row)
      opposed += solver.opposing(row, opposing);
    calls += zwang::test::stop_counting_heap_calls();
  }
  EXPECT_EQ(calls, 0);
  EXPECT_TRUE(solved);
  EXPECT_GT(opposed, 1000) << "rows that get all they ask make no busy problem";
}

TEST(RealTime, TheSameInputGivesTheSameBits) {
  const Model model = test::mecanum({});
  const auto run = [&model] {
    State state(model);
    ConstraintSet set;
    Solver solver(model);
    Solution solution(model);
    std::mt19937 random(11);
    std::vector<double> bits;
    for (int i = 0; i < 200; ++i) {
      pose(model, random, state, set);
      EXPECT_TRUE(set.fill(model, state));
      EXPECT_EQ(solver.solve(state, set.rows(), solution), Status::ok);
      bits.insert(bits.end(), solution.tau.begin(), solution.tau.end());
      bits.insert(bits.end(), solution.qdd.begin(), solution.qdd.end());
    }
    return bits;
  };
  const std::vector<double> first = run();
  const std::vector<double> second = run();
  ASSERT_EQ(first.size(), second.size());
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(double)), 0);
}

/// Turning wheels keep what was computed of the robot only when their turning moves no mass.
TEST(RealTime, AnEccentricWheelIsNotTakenForARoundOne) {
  const auto tau_of_first_wheel = [](const test::MecanumFigures& figures,
                                     std::initializer_list<double> angles) {
    const Model model = test::mecanum(figures);
    State state(model);
    state.base_twist.angular.z() = 1.0;
    std::mt19937 random(3);
    ConstraintSet set;
    pose(model, random, state, set);
    Solver solver(model);
    Solution solution(model);
    for (const double angle : angles) {
      state.q(0) = angle;
      EXPECT_TRUE(set.fill(model, state));
      EXPECT_EQ(solver.solve(state, set.rows(), solution), Status::ok);
    }
    return solution.tau(0);
  };
  const test::MecanumFigures round;
  EXPECT_EQ(tau_of_first_wheel(round, {0.0, 1.0}), tau_of_first_wheel(round, {0.0}));
  const test::MecanumFigures eccentric{.eccentricity = 0.02};
  EXPECT_EQ(tau_of_first_wheel(eccentric, {0.0, 1.0}), tau_of_first_wheel(eccentric, {1.0}));
  EXPECT_NE(tau_of_first_wheel(eccentric, {0.0, 1.0}), tau_of_first_wheel(eccentric, {0.0}));
}

TEST(RealTime, AccelerationsThatNobodyWantsAreNotWritten) {
  const Model model = test::mecanum({});
  State state(model);
  std::mt19937 random(5);
  ConstraintSet set;
  pose(model, random, state, set);
  state.q.setLinSpaced(0.3, 1.2);
  AxisConstraint on_wheel;  // its axes turn with the wheel
  on_wheel.move.body = on_wheel.in.body = 2;
  on_wheel.driver = Driver{.quantity = Quantity::acceleration, .target = 0.1, .force = {-1.0, 1.0}};
  ASSERT_TRUE(set.add(on_wheel));
  ASSERT_TRUE(set.fill(model, state));
  Solver every(model), some(model, {.every_acceleration = false});
  Solution all(model), few(model);
  const Vector6 untouched = Vector6::Constant(7.0);
  for (MotionVector& a : few.acceleration) a = {untouched.head<3>(), untouched.tail<3>()};
  ASSERT_EQ(every.solve(state, set.rows(), all), Status::ok);
  ASSERT_EQ(some.solve(state, set.rows(), few), Status::ok);
  EXPECT_EQ(all.tau, few.tau);
  EXPECT_EQ(all.qdd, few.qdd);
  for (const std::size_t body : {0u, 2u}) {
    EXPECT_EQ(all.acceleration[body].vector(), few.acceleration[body].vector()) << body;
    EXPECT_NE(all.acceleration[body].vector(), untouched) << body;
  }
  for (const std::size_t body : {1u, 3u, 4u}) EXPECT_EQ(few.acceleration[body].vector(), untouched) << body;
}

/// A random robot of its kind with rows of every kind, solved in two states in turn.
struct BusyRobot : oracle::LawProblem {
  BusyRobot(oracle::Robot robot, std::uint64_t seed)
      : LawProblem(robot, seed, 1.0 + static_cast<double>(seed % 40)),
        states{state, oracle::random_state(model, random)},
        rows{LawProblem::rows(oracle::everything), LawProblem::rows(oracle::everything)},
        equalities{oracle::acceleration_rows(rows[0]), oracle::acceleration_rows(rows[1])} {}

  std::array<State, 2> states;
  std::array<std::vector<Row>, 2> rows;
  std::array<std::vector<AccelerationRow>, 2> equalities;
};

/// Both solvers and what they answer.
struct Answers {
  explicit Answers(const BusyRobot& problem)
      : p(problem), state(p.model), solver(p.model), popov(p.model), solution(p.model), motion(p.model) {}

  bool solve(std::size_t which) {
    opposed = 0;
    state = p.states[which];
    bool solved = solver.project_velocity(state) == Status::ok;
    solved = solver.solve(state, p.rows[which], solution) == Status::ok && solved;
    opposing.fill(-1);
    for (std::size_t row = 0; row < p.rows[which].size(); ++row)
      opposed += solver.opposing(static_cast<int>(row), std::span(opposing).subspan(named * row, named));
    solved = popov.solve(p.states[which], p.equalities[which], motion) == Status::ok && solved;
    if (!p.model.has_fixed_base()) return solved;
    return popov.solve(p.states[which], p.equalities[which], upwards, motion) == Status::ok && solved;
  }
  std::vector<double> bits(std::size_t which) const {
    std::vector<double> out(opposing.begin(), opposing.end());
    const auto add = [&out](const auto& numbers) { out.insert(out.end(), numbers.begin(), numbers.end()); };
    add(solution.tau);
    add(solution.qdd);
    for (const RowSolution& row : solution.rows) add(std::array{row.nu, row.phi, row.residual});
    add(motion.qdd);
    add(motion.nu.head(static_cast<Eigen::Index>(p.rows[which].size())));
    add(motion.tau_control);
    for (const MotionVector& a : solution.acceleration) add(a.vector());
    for (const MotionVector& a : motion.acceleration) add(a.vector());
    return out;
  }

  const BusyRobot& p;
  const MotionVector upwards{Vector3::Zero(), {0.0, 0.0, 9.81}};
  State state;
  Solver solver;
  PopovVereshchagin popov;
  Solution solution;
  ConstrainedMotion motion;
  static constexpr std::size_t named = 4;
  std::array<int, named* static_cast<std::size_t>(oracle::everything.count)> opposing{};  ///< by row
  int opposed = 0;
};

constexpr std::uint64_t seeds = 40;

class RealTimeOn : public testing::TestWithParam<oracle::Robot> {};

TEST_P(RealTimeOn, NeitherSolverMakesAHeapCall) {
  if (!zwang::test::can_count_heap_calls()) GTEST_SKIP() << "a sanitizer owns malloc";
  int opposed = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const BusyRobot problem(GetParam(), seed);
    Answers answers(problem);
    for (const std::size_t which : {0u, 1u, 0u}) {
      zwang::test::start_counting_heap_calls();
      const bool solved = answers.solve(which);
      EXPECT_EQ(zwang::test::stop_counting_heap_calls(), 0) << "seed " << seed;
      EXPECT_TRUE(solved) << "seed " << seed;
      opposed += answers.opposed;
    }
  }
  EXPECT_GT(opposed, 50) << "rows that get all they ask make no busy problem";
}

/// Twice, and whatever was solved before.
TEST_P(RealTimeOn, BothSolversGiveTheSameBits) {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const BusyRobot problem(GetParam(), seed);
    Answers fresh(problem);
    ASSERT_TRUE(fresh.solve(1)) << "seed " << seed;
    const std::vector<double> want = fresh.bits(1);
    ASSERT_TRUE(fresh.solve(1)) << "seed " << seed;
    const std::vector<double> again = fresh.bits(1);
    Answers used(problem);
    ASSERT_TRUE(used.solve(0) && used.solve(1)) << "seed " << seed;
    const std::vector<double> after = used.bits(1);
    const std::size_t size = want.size() * sizeof(double);
    ASSERT_TRUE(again.size() == want.size() && after.size() == want.size());
    EXPECT_EQ(std::memcmp(again.data(), want.data(), size), 0) << "seed " << seed << ", solved again";
    EXPECT_EQ(std::memcmp(after.data(), want.data(), size), 0) << "seed " << seed << ", after another one";
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, RealTimeOn, testing::ValuesIn(oracle::all_robots),
                         [](const auto& drawn) { return oracle::to_string(drawn.param); });

}  // namespace
}  // namespace zwang::solver
