// Outputs: set by tasks, kept, and what their `stop` says from the end or a stop on.
#include <gtest/gtest.h>

#include "scheduler_bench.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

/// `gripper` keeps what it is, `lamp` is 1 at a stop.
lang::Program with_outputs(std::vector<lang::Task> tasks) {
  lang::Program p = program(std::move(tasks));
  p.outputs = {{.name = "gripper", .start = 0.0},
               {.name = "lamp", .is_number = true, .start = 0.2, .stop = 1.0}};
  return p;
}

std::vector<AxisStatements> stands() {
  return {drive("go.x", Axis::x, Quantity::velocity, 0.0), drive("go.y", Axis::y, Quantity::velocity, 0.0),
          drive("go.rz", Axis::rz, Quantity::velocity, 0.0)};
}

lang::SetAction to(int output, double value) {
  return {.kind = lang::SetKind::output, .index = output, .value = {.constant = value}};
}

std::vector<double> outputs_of(const Scheduler& scheduler) {
  return {scheduler.outputs().begin(), scheduler.outputs().end()};
}

TEST(Outputs, AreSetByTasksAndKept) {
  lang::Task a = task("a", stands()), b = task("b", stands()), c = task("c", stands());
  a.set_on_entry = {to(0, 1.0)};
  a.exits = {exit(after(0.010), to_task(1))};
  a.exits[0].set = {to(1, 0.5)};
  b.exits = {exit(when(apply(Op::greater, name(Op::output, 1), number(0.4))), to_task(2))};
  Bench bench(with_outputs({a, b, c}));
  EXPECT_EQ(outputs_of(bench.scheduler), (std::vector{0.0, 0.2}));
  bench.tick();
  EXPECT_EQ(outputs_of(bench.scheduler), (std::vector{1.0, 0.2}));
  bench.ticks_more(10);
  EXPECT_EQ(bench.scheduler.task(), 1);
  EXPECT_EQ(outputs_of(bench.scheduler), (std::vector{1.0, 0.5}));
  bench.ticks_more(2);
  EXPECT_EQ(bench.scheduler.task(), 2) << "a condition reads it";
  EXPECT_EQ(outputs_of(bench.scheduler), (std::vector{1.0, 0.5}));
}

TEST(Outputs, AreWhatTheirStopSaysFromTheEndOn) {
  lang::Task a = task("a", stands());
  a.exits = {exit(after(0.010), to_done)};
  a.exits[0].set = {to(0, 1.0), to(1, 0.5)};
  Bench bench(with_outputs({a}));
  bench.ticks_more(12);
  ASSERT_EQ(bench.scheduler.outcome(), Outcome::done);
  EXPECT_EQ(outputs_of(bench.scheduler), (std::vector{1.0, 1.0}));
}

TEST(Outputs, AreWhatTheirStopSaysAfterAProtectiveStop) {
  lang::Task a = task("a", stands());
  a.set_on_entry = {to(0, 1.0), to(1, 0.5)};
  Runner runner(with_outputs({a}));
  PlanarBase base;
  Sensed sensed(mecanum_robot().model);
  for (int i = 0; i < 10; ++i) {
    base.sense(sensed);
    base.step(runner.step(sensed));
  }
  EXPECT_EQ(runner.outputs()[0], 1.0);
  EXPECT_EQ(runner.outputs()[1], 0.5);
  runner.guard().stop(EventCode::solver, -1, 0.0);
  base.sense(sensed);
  runner.step(sensed);
  EXPECT_EQ(runner.outputs()[0], 1.0);
  EXPECT_EQ(runner.outputs()[1], 1.0);
  EXPECT_EQ(runner.command().outputs, (std::vector{1.0, 1.0}));
}

// A gripper does not open because a file was saved.
TEST(Outputs, OfTheSameNameStayOverASwapOfPrograms) {
  lang::Task a = task("a", stands());
  a.set_on_entry = {to(0, 1.0)};
  Runner runner(with_outputs({a}));
  lang::Program other = program({task("b", stands())});
  other.outputs = {{.name = "horn", .start = 0.3}, {.name = "gripper", .start = 0.0}};
  Runner next(other);
  PlanarBase base;
  Sensed sensed(mecanum_robot().model);
  const auto tick = [&] {
    base.sense(sensed);
    base.step(runner.step(sensed));
  };
  for (int i = 0; i < 10; ++i) tick();
  ASSERT_TRUE(runner.swap_program(next));
  tick();
  EXPECT_EQ(runner.command().outputs, (std::vector{0.3, 1.0}));
}

}  // namespace
}  // namespace zwang::runtime
