// What a control loop relies on: no heap call inside the step, and the same bits for the same input.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <random>

#include "malloc_counter.hpp"
#include "robots.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::solver {
namespace {

/// A busy problem: three levels, a force row with a velocity range, bounded drivers, a fading and a soft row,
/// limits on the sum of forces and on the speed, torque limits in reach.
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
  constraint.alpha = 0.7;
  ASSERT_TRUE(set.add(constraint));
  constraint.axis = Axis::rz;
  constraint.alpha = 1.0;
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

}  // namespace
}  // namespace zwang::solver
