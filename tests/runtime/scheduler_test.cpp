// Each test is a sentence of the task language's section "The scheduler".
#include "zwang/runtime/scheduler.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "scheduler_bench.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

TEST(Tick, TheStartTaskIsEnteredOnTheFirstTick) {
  lang::Program p = program({task("a", ahead), task("b", ahead)});
  p.start = 1;
  Bench bench(p);
  bench.tick();
  EXPECT_EQ(bench.scheduler.task(), 1);
  ASSERT_EQ(bench.transitions.size(), 1u);
  EXPECT_EQ(bench.transitions[0].cause, Cause::start);
  EXPECT_EQ(bench.transitions[0].from, -1);
  EXPECT_EQ(bench.constraint(0).driver->target, 0.1);
}

TEST(Tick, TaskGuardsAreNotEvaluatedOnTheEntryTickAndElapsedIsZeroThere) {
  lang::Task a = task("a", ahead), b = task("b", ahead);
  a.exits = {exit(always_true(), to_task(1))};
  b.exits = {exit(always_true(), to_task(0))};
  Bench bench(program({a, b}));
  // No zero-time loop: one switch a tick, never two.
  for (int i = 0; i < 6; ++i) {
    bench.tick();
    EXPECT_EQ(bench.scheduler.task(), i % 2);
    EXPECT_EQ(bench.scheduler.elapsed(), 0.0);
    EXPECT_EQ(bench.transitions.size(), static_cast<std::size_t>(i + 1));
  }
}

TEST(Tick, ForCountsConsecutiveTrueTicks) {
  for (const double dwell : {0.0, 0.001, 0.0101, 0.2}) {
    lang::Task a = task("a", ahead);
    a.exits = {exit(always_true(), to_done, dwell)};
    Bench bench(program({a}));
    bench.tick();
    const int needed = std::max(1, static_cast<int>(std::ceil(dwell / period - 1e-9)));
    EXPECT_EQ(bench.ticks_to_switch(1000), needed) << dwell;
  }
}

TEST(Tick, ASwitchRestartsForInTheTaskThatIsEntered) {
  lang::Task a = task("a", ahead), b = task("b", ahead);
  a.exits = {exit(always_true(), to_task(1), 0.005)};
  b.exits = {exit(always_true(), to_done, 0.005)};
  Bench bench(program({a, b}));
  bench.tick();
  EXPECT_EQ(bench.ticks_to_switch(10), 5);
  EXPECT_EQ(bench.ticks_to_switch(10), 5);
}

TEST(Tick, FalseRestartsForAndSoDoesUnknown) {
  for (const bool to_unknown : {false, true}) {
    // True while x > 0; 0/0 is unknown.
    lang::Task a = task("a", ahead, base_link, world_frame);
    const Nodes x = coordinate(0, 0, CoordinateQuantity::position);
    const Nodes value = to_unknown ? apply(Op::divide, x, x) : x;
    a.exits = {exit(when(apply(Op::greater, value, number(0.0))), to_done, 0.010)};
    Bench bench(program({a}));
    bench.sensed.state.base_pose.position.x() = 1.0;
    for (int i = 0; i < 10; ++i) bench.tick();
    EXPECT_NEAR(bench.scheduler.dwell(0), 9 * period, 1e-12);
    bench.sensed.state.base_pose.position.x() = 0.0;
    bench.tick();
    EXPECT_EQ(bench.scheduler.dwell(0), 0.0);
    bench.sensed.state.base_pose.position.x() = 1.0;
    EXPECT_EQ(bench.ticks_to_switch(100), 10);
  }
}

TEST(Tick, OrderIsPriorityTimeoutThenExitsTopToBottomAndTheRestIsAlsoTrue) {
  lang::Task a = task("a", ahead), b = task("b", ahead);
  a.exits = {exit(when(apply(Op::less, number(1.0), number(0.0))), to_failed), exit(after(0.003), to_task(1)),
             exit(after(0.002), to_done, 0.002), exit(after(0.003), to_failed)};
  Bench bench(program({a, b}));
  bench.tick();
  EXPECT_EQ(bench.ticks_to_switch(10), 3);
  EXPECT_EQ(bench.transitions.back().cause, Cause::exit);
  EXPECT_EQ(bench.transitions.back().exit, 1);
  EXPECT_EQ(bench.transitions.back().also_true, 0b1100u);
  EXPECT_EQ(bench.scheduler.task(), 1);

  a.timeout = lang::Timeout{{.constant = 0.003}, to_failed, {}};
  Bench timed(program({a, b}));
  timed.tick();
  EXPECT_EQ(timed.ticks_to_switch(10), 3);
  EXPECT_EQ(timed.transitions.back().cause, Cause::timeout);
  EXPECT_EQ(timed.transitions.back().also_true, 0b1110u);
  EXPECT_EQ(timed.scheduler.outcome(), Outcome::failed);
}

TEST(Tick, GuardsReadLastTicksSolution) {
  for (const auto what :
       {CoordinateQuantity::force, CoordinateQuantity::residual, CoordinateQuantity::saturated}) {
    lang::Task a = task("a", ahead);
    a.exits = {exit(when(apply(Op::greater, coordinate(0, 0, what), number(0.5))), to_done)};
    Bench bench(program({a}));
    bench.tick();
    bench.tick();
    switch (what) {
      case CoordinateQuantity::force:
        bench.answer.nu = 1.0;
        break;
      case CoordinateQuantity::residual:
        bench.answer.residual = 1.0;
        break;
      default:
        bench.answer.saturated = true;
    }
    bench.tick();  // solved in this tick, seen in the next
    EXPECT_EQ(bench.scheduler.outcome(), Outcome::none);
    bench.tick();
    EXPECT_EQ(bench.scheduler.outcome(), Outcome::done);
  }
}

TEST(Tick, RangeRowsAreNeverCountedAsForce) {
  lang::Task a = task("a", {free_axis("go.x", Axis::x)});
  a.groups[0].axes[0].velocity = between(-1, 1);
  Bench bench(program({a}));
  bench.answer.nu = 7.0;
  bench.answer.residual = -0.3;
  bench.tick();
  EXPECT_EQ(bench.scheduler.reading({0, 0, 0}).force, 0.0);
  EXPECT_EQ(bench.scheduler.reading({0, 0, 0}).residual, -0.3);
}

TEST(Tick, TheResidualOfARangeIsThatOfTheSideThatIsMissed) {
  lang::Task a = task("a", {free_axis("go.x", Axis::x)});
  a.groups[0].axes[0].velocity = between(-1, 1);
  Bench bench(program({a}));
  bench.tick();
  ASSERT_EQ(bench.scheduler.constraints().rows().size(), 2u);
  solver::Solution solution(bench.program.robot.model, bench.scheduler.row_capacity());
  for (const std::size_t missed : {0u, 1u}) {
    solution.rows.assign(2, {});
    solution.rows[missed].residual = -0.3;
    bench.scheduler.observe(solution);
    EXPECT_EQ(bench.scheduler.reading({0, 0, 0}).residual, -0.3) << missed;
  }
}

TEST(Tick, SpeedAndMovedFollowTheFrameAndMovedStartsAtEntry) {
  lang::Task a = task("a", ahead), b = a;
  a.exits = {exit(after(0.010), to_task(1))};
  // A quarter circle of the bumper about the base, then the same way back: the path, not the distance.
  b.exits = {exit(when(apply(Op::greater, call("moved", bumper), number(0.4 * 3.1))), to_done)};
  Bench bench(program({a, b}));
  for (int i = 0; i <= 10; ++i) {
    bench.sensed.state.base_pose.position.x() += 1.0;  // does not count: it is before entry
    bench.tick();
  }
  ASSERT_EQ(bench.scheduler.task(), 1);
  const int steps = 1000;
  for (int i = 1; i <= 2 * steps && bench.scheduler.outcome() == Outcome::none; ++i) {
    const double share = static_cast<double>(i <= steps ? i : 2 * steps - i) / steps;
    bench.sensed.state.base_pose.rotation = solver::rotation_from_rpy(0, 0, share * std::numbers::pi / 2);
    bench.tick();
    const double path = 0.4 * std::numbers::pi / 2 * i / steps;
    EXPECT_EQ(bench.scheduler.outcome() == Outcome::done, path > 0.4 * 3.1) << i;
  }
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::done);

  lang::Task c = task("c", ahead);
  c.exits = {exit(when(apply(Op::greater, call("speed", bumper), number(0.499))), to_done)};
  Bench turning(program({c}));
  turning.sensed.state.base_twist.linear = {0.3, 0, 0};
  turning.tick();
  turning.tick();
  EXPECT_EQ(turning.scheduler.outcome(), Outcome::none);
  turning.sensed.state.base_twist.angular = {0, 0, 1.0};  // 0.4 m ahead: (0.3, 0.4) m/s
  turning.tick();
  EXPECT_EQ(turning.scheduler.outcome(), Outcome::done);
}

// To and fro by a quarter turn each: half a turn in all.
TEST(Tick, TurnedIsTheSumOfTheAnglesSinceEntry) {
  lang::Task a = task("a", ahead), b = a;
  a.exits = {exit(after(0.010), to_task(1))};
  b.exits = {
      exit(when(apply(Op::greater, call("turned", bumper), number(0.9905 * std::numbers::pi))), to_done)};
  Bench bench(program({a, b}));
  for (int i = 0; i <= 10; ++i) {
    bench.sensed.state.base_pose.rotation = solver::rotation_from_rpy(0, 0, 0.01 * i);  // before entry
    bench.tick();
  }
  ASSERT_EQ(bench.scheduler.task(), 1);
  const int steps = 500;
  for (int i = 1; i <= 2 * steps && bench.scheduler.outcome() == Outcome::none; ++i) {
    const double share = static_cast<double>(i <= steps ? i : 2 * steps - i) / steps;
    bench.sensed.state.base_pose.rotation =
        solver::rotation_from_rpy(0, 0, 0.1 + share * std::numbers::pi / 2);
    bench.tick();
    const double sum = std::numbers::pi / 2 * i / steps;
    EXPECT_EQ(bench.scheduler.outcome() == Outcome::done, sum > 0.9905 * std::numbers::pi) << i;
  }
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::done);
}

// a and b take turns, 5 ms each; a task that was never entered is unknown, and decides nothing.
TEST(Tick, EntriesAndSinceCountTheEntriesOfATask) {
  lang::Task a = task("a", ahead), b = a, never = a;
  a.exits = {exit(when(apply(Op::greater, call("entries", 1), number(2.5))), to_done),
             exit(when(apply(Op::greater, call("since", 2), number(-1.0))), to_failed),
             exit(after(0.005), to_task(1))};
  b.exits = {exit(when(apply(Op::greater_equal, call("since", 0), number(0.0099))), to_task(0))};
  Bench bench(program({a, b, never}));
  std::vector<int> switches;
  for (int i = 0; i < 100 && bench.scheduler.outcome() == Outcome::none; ++i) {
    bench.tick();
    if (bench.scheduler.transition() && i > 0) switches.push_back(i);
  }
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::done);
  // b is left 10 ms after a was entered.
  EXPECT_EQ(switches, (std::vector{5, 10, 15, 20, 25, 30, 31}));
}

TEST(Set, TheExitsSetRunsBeforeTheEntrys) {
  lang::Program p = program({task("a", ahead), task("b", {drive("go.x", Axis::x, Quantity::velocity, 0.0)})});
  p.parameters.resize(1);
  p.parameters[0].name = "v";
  p.parameters[0].value = 1.0;
  p.tasks[0].exits = {exit(after(0.001), to_task(1))};
  p.tasks[0].exits[0].set = {{.kind = lang::SetKind::parameter, .index = 0, .value = {.constant = 2.0}}};
  // On entry the parameter is set to minus what the exit made of it.
  p.tasks[1].set_on_entry = {
      {.kind = lang::SetKind::parameter, .index = 0, .value = {.parameter = 0, .sign = -1.0}}};
  p.tasks[1].groups[0].axes[0].target = {.parameter = 0};
  Bench bench(p);
  bench.tick();
  bench.tick();
  EXPECT_EQ(bench.scheduler.parameters()[0], -2.0);
  EXPECT_EQ(bench.constraint(0).driver->target, -2.0);
}

TEST(Set, AFrameTakesThePoseOfAnotherAndKeepsItsParent) {
  lang::Program p =
      program({task("a", ahead), task("b", ahead, base_link, 3), task("c", ahead, base_link, 4)});
  lang::FrameDeclaration in_world, on_base;
  in_world.name = "in_world";
  on_base.name = "on_base";
  on_base.parent = lang::FrameParent::frame;
  on_base.parent_index = base_link;
  p.frames.push_back(in_world);
  p.frames.push_back(on_base);
  for (const int target : {1, 2}) {
    p.tasks[0].exits = {exit(after(0.001), to_task(target))};
    p.tasks[0].exits[0].set = {{.index = target == 1 ? 3 : 4, .source = bumper}};
    Bench bench(p);
    bench.sensed.state.base_pose.position = {1, 2, 0};
    bench.sensed.state.base_pose.rotation = solver::rotation_from_rpy(0, 0, std::numbers::pi / 2);
    bench.tick();
    bench.tick();
    ASSERT_EQ(bench.scheduler.task(), target);
    const solver::AttachedFrame in = bench.constraint(0).in;
    if (target == 1) {  // the bumper's pose in the world: 0.4 m along the base's x, which is the world's y
      EXPECT_EQ(in.body, -1);
      EXPECT_NEAR(in.pose.position.x(), 1.0, 1e-12);
      EXPECT_NEAR(in.pose.position.y(), 2.4, 1e-12);
    } else {  // hangs on the base as the bumper does
      EXPECT_EQ(in.body, 0);
      EXPECT_NEAR((in.pose.position - solver::Vector3(0.4, 0, 0)).norm(), 0.0, 1e-12);
    }
  }
}

TEST(Set, FramesAreRecomputedBeforeHereIsTaken) {
  for (const bool on_entry : {false, true}) {
    lang::Program p = program({task("a", ahead), task("b", ahead, base_link, 3)});
    lang::FrameDeclaration touch;
    touch.name = "touch";
    touch.pose.position = {10, 0, 0};
    p.frames.push_back(touch);
    p.tasks[0].exits = {exit(after(0.001), to_task(1))};
    const std::vector<lang::SetAction> set = {{.index = 3, .source = bumper}};
    (on_entry ? p.tasks[1].set_on_entry : p.tasks[0].exits[0].set) = set;
    p.tasks[1].groups[0].axes = {drive("go.x", Axis::x, Quantity::position, 0.0)};
    p.tasks[1].groups[0].axes[0].here = true;
    Bench bench(p);
    bench.sensed.state.base_pose.position = {3, 0, 0};
    bench.tick();
    bench.tick();
    // Seen from the bumper, which is where `touch` is by now, the base stands 0.4 m behind.
    EXPECT_NEAR(bench.constraint(0).driver->target, -0.4, 1e-12) << (on_entry ? "entry" : "exit");
  }
}

TEST(Here, InAxesOfTheMovedBodyItMeansTheWorldPoseAtEntry) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::position, 0.0)});
  a.groups[0].axes[0].here = true;
  Bench bench(program({a}));
  bench.sensed.state.base_pose.rotation = solver::rotation_from_rpy(0, 0, std::numbers::pi / 2);
  bench.sensed.state.base_pose.position = {5, 6, 0};
  bench.tick();
  EXPECT_EQ(bench.constraint(0).in.body, -1);
  bench.sensed.state.base_pose.position = {5, 6.25, 0};  // along the entry's x
  bench.tick();
  EXPECT_NEAR(bench.constraint(0).driver->target, 0.0, 1e-12);
  EXPECT_NEAR(bench.scheduler.constraints().coordinates()[0].position, 0.25, 1e-12);
}

TEST(Stop, DoneBrakesWithTheRobotsStopUntilTheBaseStands) {
  lang::Task a = task("a", ahead);
  a.exits = {exit(after(0.001), to_done)};
  Bench bench(program({a}));
  bench.sensed.state.base_twist.linear = {0.0, 0.05, 0.0};
  for (int i = 0; i < 200; ++i) bench.tick();
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::done);
  EXPECT_EQ(bench.scheduler.phase(), Phase::stopping);
  ASSERT_EQ(bench.count(), 6) << "each axis with its brake, and with the stop's deceleration";
  for (int i = 0; i < 3; ++i) {
    const solver::AxisConstraint& c = bench.constraint(i);
    const solver::AxisConstraint& deceleration = bench.constraint(3 + i);
    EXPECT_EQ(deceleration.level, 0);
    EXPECT_EQ(deceleration.axis, c.axis);
    EXPECT_EQ(deceleration.acceleration->high, c.acceleration->high);
    const bool turns = c.axis == Axis::rz;
    EXPECT_EQ(c.driver->quantity, Quantity::velocity);
    EXPECT_EQ(c.driver->target, 0.0);
    EXPECT_NEAR(c.driver->force.high, turns ? 80.0 * 0.5 : 80.0, 1e-12);
    EXPECT_NEAR(c.driver->force.low, turns ? -80.0 * 0.5 : -80.0, 1e-12);
    EXPECT_NEAR(c.acceleration->high, turns ? 1.0 / 0.5 : 1.0, 1e-12);
  }
  bench.sensed.state.base_twist.linear = {0.0, 0.0099, 0.0};
  bench.ticks_more(99);
  EXPECT_EQ(bench.scheduler.phase(), Phase::stopping) << "0.1 s at rest are asked for";
  bench.tick();
  EXPECT_EQ(bench.scheduler.phase(), Phase::finished);
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::done);
  EXPECT_EQ(bench.count(), 6) << "it goes on holding";
}

TEST(Stop, ABaseThatDoesNotComeToRestHasFailed) {
  lang::Task a = task("a", ahead);
  a.exits = {exit(after(0.001), to_done)};
  Bench bench(program({a}));
  bench.sensed.state.base_twist.angular = {0.0, 0.0, 0.1};
  for (int i = 0; i < 11'000 && bench.scheduler.phase() != Phase::finished; ++i) bench.tick();
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::failed);
  EXPECT_EQ(bench.transitions.back().cause, Cause::never_stood);
}

TEST(Limits, TheRobotsAreLevelZeroRowsOnTheBaseWhereTheTaskGivesNone) {
  lang::Program p = program({task("a", ahead), task("b", ahead)});
  p.robot.limits = {{Axis::x, Quantity::velocity, {-1, 1}, {}},
                    {Axis::x, Quantity::acceleration, {-2, 2}, {}},
                    {Axis::rz, Quantity::velocity, {-3, 3}, {}}};
  p.tasks[0].groups[0].axes[0].velocity = between(-0.2, 0.2);
  p.tasks[0].exits = {exit(after(0.001), to_task(1))};
  Bench bench(p);
  bench.tick();
  ASSERT_EQ(bench.count(), 3);
  EXPECT_EQ(bench.constraint(0).velocity->high, 0.2);
  EXPECT_EQ(bench.constraint(1).level, 0);
  EXPECT_FALSE(bench.constraint(1).velocity.has_value());
  EXPECT_EQ(bench.constraint(1).acceleration->high, 2.0);
  EXPECT_EQ(bench.constraint(2).axis, Axis::rz);
  bench.tick();
  ASSERT_EQ(bench.scheduler.task(), 1);
  EXPECT_EQ(bench.constraint(1).velocity->low, -1.0) << "the other task gives no range of its own";
}

/// A driver of an earlier level, or a weight, may break the task's range: the robot's own stays in force.
TEST(Limits, HoldWhereADriverMayBreakTheTasksRange) {
  const auto robots_limit_holds = [](int level, bool is_soft) {
    lang::Task a = task("a", ahead);
    lang::Group manners = a.groups[0];
    manners.name = "manners";
    manners.axes = {free_axis("manners.x", Axis::x)};
    manners.axes[0].velocity = between(-0.2, 0.2);
    manners.axes[0].level = level;
    if (is_soft) manners.axes[0].weight = lang::Value{.constant = 1.0};
    a.groups.push_back(manners);
    lang::Program p = program({a});
    p.robot.limits = {{Axis::x, Quantity::velocity, {-1, 1}, {}}};
    Bench bench(p);
    bench.tick();
    for (int i = 0; i < bench.count(); ++i) {
      const auto& velocity = bench.constraint(i).velocity;
      if (bench.constraint(i).level == 0 && velocity && velocity->high == 1.0) return true;
    }
    return false;
  };
  EXPECT_FALSE(robots_limit_holds(0, false));
  EXPECT_FALSE(robots_limit_holds(1, false));
  EXPECT_TRUE(robots_limit_holds(2, false));
  EXPECT_TRUE(robots_limit_holds(1, true));
}

TEST(Construction, RefusesProgramsThatCannotRun) {
  lang::Program p = program({});
  EXPECT_THROW(Scheduler(p, period), std::invalid_argument);
  p = program({task("a", ahead)});
  EXPECT_THROW(Scheduler(p, 0.0), std::invalid_argument);
  p.tasks[0].exits = {exit(after(1.0), to_task(3))};
  EXPECT_THROW(Scheduler(p, period), std::invalid_argument);
  p = program({task("a", ahead, world_frame)});
  EXPECT_THROW(Scheduler(p, period), std::invalid_argument);
}

}  // namespace
}  // namespace zwang::runtime
