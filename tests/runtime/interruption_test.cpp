// Each test is a sentence of the task language's section "The scheduler": `always`, `back`, `attempts`,
// `require`, `release`, and who goes first.
#include "interrupted_work.hpp"
#include "scheduler_bench.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

TEST(Always, ConstraintsAreInForceInEveryTaskAndWhileTheBaseBrakes) {
  lang::Task a = task("a", forward), b = task("b", standing);
  a.exits = {exit(after(0.002), to_task(1))};
  b.exits = {exit(after(0.002), to_done)};
  lang::Program p = program({a, b});
  AxisStatements slow = free_axis("manners.y", Axis::y);
  slow.velocity = between(-0.3, 0.3);
  slow.level = 0;
  p.always.groups = task("", {slow}).groups;
  Bench bench(p);
  bench.sensed.state.base_twist.linear = {0.5, 0.0, 0.0};  // never at rest
  for (int i = 0; i < 8; ++i) {
    bench.tick();
    int found = 0;
    for (int c = 0; c < bench.count(); ++c) {
      const InForce& source = bench.scheduler.in_force()[static_cast<std::size_t>(c)];
      if (source.origin.task != bench.scheduler.always_task()) continue;
      ++found;
      EXPECT_TRUE(source.active);
      EXPECT_EQ(bench.constraint(c).level, 0);
      EXPECT_NEAR(source.alpha, 1.0, 1e-12);
      EXPECT_EQ(bench.constraint(c).velocity->high, 0.3);
    }
    EXPECT_EQ(found, 1) << i;
  }
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::done);
  EXPECT_EQ(bench.scheduler.phase(), Phase::stopping);
}

TEST(Always, ItsRangesReplaceTheRobotsOnTheSameAxis) {
  lang::Program p = program({task("a", forward)});
  p.robot.limits = {{Axis::x, Quantity::velocity, {-1, 1}, {}}, {Axis::y, Quantity::velocity, {-1, 1}, {}}};
  AxisStatements slow = free_axis("manners.x", Axis::x);
  slow.velocity = between(-2, 2);
  slow.level = 0;
  p.always.groups = task("", {slow}).groups;
  const Scheduler scheduler(p, period);
  const lang::Group& limits = scheduler.tasks()[0].groups.back();
  ASSERT_EQ(limits.name, "limits");
  ASSERT_EQ(limits.axes.size(), 1u);
  EXPECT_EQ(limits.axes[0].axis, Axis::y);
}

TEST(Always, AnExitInterruptsTheTask) {
  Bench bench(interrupted_work());
  bench.hear(0, 5.0);
  bench.ticks_more(10);
  EXPECT_EQ(bench.scheduler.task(), work);
  bench.hear(0, 0.5);
  bench.tick();
  EXPECT_EQ(bench.scheduler.task(), pause);
  EXPECT_EQ(bench.transitions.back().cause, Cause::always);
  EXPECT_EQ(bench.transitions.back().exit, 0);
  EXPECT_EQ(bench.scheduler.why(bench.transitions.back()), "a condition");
}

TEST(Always, AnExitIsIgnoredWhileItsOwnTargetIsActive) {
  Bench bench(interrupted_work());
  bench.hear(0, 0.5);
  bench.ticks_more(20);
  EXPECT_EQ(bench.scheduler.task(), pause);
  EXPECT_EQ(bench.transitions.size(), 2u) << "the start and one interruption";
}

/// Else two exits that are true at once would take turns, tick by tick.
TEST(Always, ALowerExitWaitsWhileTheTargetOfATrueOneIsActive) {
  lang::Program p = interrupted_work();
  p.tasks.push_back(task("retreat", forward));
  p.tasks[2].exits = {exit(after(1e6), to_done)};
  p.always.exits.push_back(exit(when(below(1, 1.0)), to_task(2)));
  Bench bench(p);
  bench.hear(1, 0.5);
  bench.ticks_more(2);  // the first one starts
  EXPECT_EQ(bench.scheduler.task(), 2) << "alone it fires";
  bench.hear(0, 0.5);
  bench.ticks_more(20);
  EXPECT_EQ(bench.scheduler.task(), pause);
  EXPECT_EQ(bench.transitions.size(), 3u) << "the start and two interruptions";
  bench.hear(0, 1.5);  // above the first exit's 1, below what leads out of the pause
  bench.tick();
  EXPECT_EQ(bench.scheduler.task(), 2) << "nothing above it is true any more";
}

TEST(Always, AnExitThatEndsTheRunWaitsForNone) {
  lang::Program p = interrupted_work();
  p.always.exits.push_back(exit(when(below(1, 1.0)), to_failed));
  Bench bench(p);
  bench.hear(0, 0.5);
  bench.ticks_more(5);
  EXPECT_EQ(bench.scheduler.task(), pause);
  bench.hear(1, 0.5);
  bench.tick();
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::failed);
}

TEST(Always, GuardsAreEvaluatedOnEveryTickAndKeepTheirTimersOverSwitches) {
  lang::Program p = interrupted_work();
  p.always.exits[0].dwell.constant = 0.010;
  p.tasks.push_back(task("next", forward));
  p.tasks[0].exits = {exit(after(0.004), to_task(2))};
  p.tasks[2].exits = {exit(after(0.004), to_task(0))};
  Bench bench(p);
  for (int i = 1; i <= 9; ++i) {
    bench.hear(0, 0.5);
    bench.tick();
    EXPECT_NEAR(bench.scheduler.always_dwell(0), i * period, 1e-12) << "entry ticks count, the first one too";
    EXPECT_NE(bench.scheduler.task(), pause);
  }
  EXPECT_EQ(bench.transitions.size(), 3u) << "there were switches meanwhile";
  bench.tick();
  EXPECT_EQ(bench.scheduler.task(), pause);
}

TEST(Always, WhatItHoldsUntilItsReleaseItHoldsOverASwitch) {
  lang::Program p = interrupted_work();
  p.always.exits[0].dwell.constant = 0.010;
  p.always.exits[0].release = lang::Value{.constant = 1.5};
  p.tasks.push_back(task("next", forward));
  p.tasks[0].exits = {exit(after(0.004), to_task(2))};
  p.tasks[2].exits = {exit(after(1e6), to_done)};
  Bench bench(p);
  bench.hear(0, 0.5);
  bench.ticks_more(2);
  bench.hear(0, 1.2);  // above the threshold of 1, not past the release
  for (int i = 3; i <= 9; ++i) {
    bench.tick();
    EXPECT_NEAR(bench.scheduler.always_dwell(0), i * period, 1e-12);
  }
  ASSERT_EQ(bench.scheduler.task(), 2) << "there was a switch meanwhile";
  bench.tick();
  EXPECT_EQ(bench.scheduler.task(), pause);
}

TEST(Always, AnExitRunsItsSet) {
  lang::Program p = interrupted_work();
  p.parameters.resize(1);
  p.parameters[0].value = 1.0;
  p.always.exits[0].set = {{.kind = lang::SetKind::parameter, .index = 0, .value = {.constant = 2.0}}};
  Bench bench(p);
  bench.hear(0, 5.0);
  bench.ticks_more(2);
  EXPECT_EQ(bench.scheduler.parameters()[0], 1.0);
  bench.hear(0, 0.5);
  bench.tick();
  ASSERT_EQ(bench.scheduler.task(), pause);
  EXPECT_EQ(bench.scheduler.parameters()[0], 2.0);
}

TEST(Always, UnknownCountsAsTrueAtOnceWhenASignalIsOlderThanItsStaleAfter) {
  lang::Program p = interrupted_work();
  p.signals[0].stale_after.constant = 0.020;
  p.always.exits[0].dwell.constant = 10.0;  // not waited for
  Bench bench(p);
  bench.hear(0, 5.0);
  bench.ticks_more(21);  // 20 ms old on the last of them: not older yet
  EXPECT_EQ(bench.scheduler.task(), work);
  bench.tick();
  EXPECT_EQ(bench.scheduler.task(), pause);
  EXPECT_EQ(bench.transitions.back().cause, Cause::always);
}

TEST(Always, UnknownForAnyOtherReasonDoesNotFire) {
  lang::Program p = interrupted_work();
  p.always.exits[0].when = when(apply(Op::less, unknown(), number(1.0)));
  Bench bench(p);
  bench.ticks_more(50);
  EXPECT_EQ(bench.scheduler.task(), work);
}

TEST(Always, AStaleSignalThatDoesNotDecideDoesNotFire) {
  lang::Program p = interrupted_work();
  p.signals[0].stale_after.constant = 0.005;
  const Nodes never = apply(Op::less, number(1.0), number(0.0));
  p.always.exits[0].when = when(apply(Op::logical_and, below(0, 1.0), never));
  Bench bench(p);
  bench.ticks_more(50);
  EXPECT_EQ(bench.scheduler.task(), work);
}

TEST(Task, UnknownDoesNotFireButItsTimeoutDoes) {
  lang::Task a = task("a", forward);
  a.exits = {exit(when(below(0, 1.0)), to_done), exit(when(apply(Op::logical_not, below(0, 1.0))), to_done)};
  a.timeout = lang::Timeout{{.constant = 0.050}, to_failed, {}};
  lang::Program p = program({a});
  p.signals = {signal("near", SignalType::number, 0.005)};
  Bench bench(p);
  bench.tick();
  EXPECT_EQ(bench.ticks_to_switch(100), 50);
  EXPECT_EQ(bench.transitions.back().cause, Cause::timeout);
}

TEST(Require, FalseOrUnknownOnEntryFailsWithTheConditionsWords) {
  const Nodes no = apply(Op::less, number(1), number(0));
  const Nodes maybe = apply(Op::less, unknown(), number(1));
  for (const Nodes& nodes : {no, maybe}) {
    lang::Task a = task("a", forward), b = task("b", standing);
    a.exits = {exit(after(0.002), to_task(1))};
    b.require = when(nodes, "the door is open");
    lang::SetAction set;
    set.kind = lang::SetKind::parameter;
    set.index = 0;
    b.set_on_entry = {set};
    lang::Program p = program({a, b});
    p.parameters.resize(1);
    p.parameters[0].value = 1.0;
    Bench bench(p);
    bench.ticks_more(3);
    EXPECT_EQ(bench.scheduler.outcome(), Outcome::failed);
    EXPECT_EQ(bench.transitions.back().refusal, Refusal::require);
    EXPECT_EQ(bench.scheduler.why(bench.transitions.back()), "elapsed, but `b` requires the door is open");
    EXPECT_EQ(bench.scheduler.parameters()[0], 1.0) << "what is not entered sets nothing";
  }
}

/// Whatever leads there: an exit of `always`, a timeout, or another task's attempts.
TEST(Require, IsAskedOfEveryEntry) {
  const lang::Condition no = when(apply(Op::less, number(1), number(0)));
  lang::Program interrupted = interrupted_work();
  interrupted.tasks[1].require = no;
  Bench by_always(interrupted);
  by_always.hear(0, 0.5);
  by_always.ticks_more(2);
  EXPECT_EQ(by_always.transitions.back().cause, Cause::always);
  EXPECT_EQ(by_always.transitions.back().refusal, Refusal::require);
  EXPECT_EQ(by_always.scheduler.outcome(), Outcome::failed);

  lang::Task a = task("a", forward), b = task("b", standing), c = task("c", standing);
  c.exits = {exit(after(1e6), to_done)};
  c.require = no;
  a.timeout = lang::Timeout{{.constant = 0.002}, to_task(2), {}};
  Bench by_timeout(program({a, b, c}));
  by_timeout.ticks_more(3);
  EXPECT_EQ(by_timeout.transitions.back().cause, Cause::timeout);
  EXPECT_EQ(by_timeout.transitions.back().refusal, Refusal::require);
  EXPECT_EQ(by_timeout.scheduler.outcome(), Outcome::failed);

  a.timeout.reset();
  a.exits = {exit(after(0.001), to_task(1))};
  b.exits = {exit(after(0.001), to_task(0))};
  b.attempts = lang::Attempts{1, to_task(2), {}};
  Bench by_attempts(program({a, b, c}));
  by_attempts.ticks_more(4);
  EXPECT_EQ(by_attempts.transitions.back().refusal, Refusal::require);
  EXPECT_EQ(by_attempts.transitions.back().refused, 2);
  EXPECT_EQ(by_attempts.scheduler.outcome(), Outcome::failed);
}

/// Of the task that asks: not what the last one has lived.
TEST(Require, SeesNoTimeElapsedOnEntry) {
  lang::Task a = task("a", forward), b = task("b", standing);
  a.exits = {exit(after(0.010), to_task(1))};
  b.require = when(apply(Op::less, name(Op::elapsed), number(0.5 * period)));
  Bench bench(program({a, b}));
  bench.ticks_more(11);
  EXPECT_EQ(bench.scheduler.task(), 1);
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::none);
}

TEST(Require, HoldsForTheStartTaskAndLetsItInWhenTrue) {
  lang::Task a = task("a", forward);
  a.require = when(apply(Op::less, number(1), number(0)));
  Bench refused(program({a}));
  refused.tick();
  EXPECT_EQ(refused.scheduler.outcome(), Outcome::failed);
  a.require = always_true();
  Bench entered(program({a}));
  entered.tick();
  EXPECT_EQ(entered.scheduler.task(), 0);
}

TEST(Release, OnceTrueTheComparisonStaysTrueUntilTheQuantityPassesIt) {
  lang::Task a = task("a", forward);
  a.exits = {exit(when(below(0, 0.8)), to_done, 0.010)};
  a.exits[0].release = lang::Value{.constant = 1.2};
  lang::Program p = program({a});
  p.signals = {signal("near", SignalType::number, 1e9)};
  Bench bench(p);
  const auto dwell_at = [&](double value) {
    bench.hear(0, value);
    bench.tick();
    return bench.scheduler.dwell(0);
  };
  bench.hear(0, 5.0);
  bench.tick();
  EXPECT_EQ(dwell_at(1.0), 0.0) << "not below the threshold";
  EXPECT_NEAR(dwell_at(0.7), 0.001, 1e-12);
  EXPECT_NEAR(dwell_at(1.1), 0.002, 1e-12) << "above the threshold, not past the release";
  EXPECT_NEAR(dwell_at(1.2), 0.003, 1e-12) << "at the release, not past it";
  EXPECT_EQ(dwell_at(1.3), 0.0);
  EXPECT_EQ(dwell_at(1.1), 0.0) << "released";
}

TEST(Release, OfAQuantityThatIsAboveLiesBelow) {
  lang::Task a = task("a", forward);
  a.exits = {exit(when(above(0, 2.0)), to_done, 0.010)};
  a.exits[0].release = lang::Value{.constant = 1.0};
  lang::Program p = program({a});
  p.signals = {signal("near", SignalType::number, 1e9)};
  Bench bench(p);
  bench.tick();
  int ticks = 0;
  for (const double value : {2.1, 1.9, 1.0}) {
    bench.hear(0, value);
    bench.tick();
    EXPECT_NEAR(bench.scheduler.dwell(0), ++ticks * period, 1e-12) << value;
  }
  for (const double value : {0.9, 1.9}) {
    bench.hear(0, value);
    bench.tick();
    EXPECT_EQ(bench.scheduler.dwell(0), 0.0) << value;
  }
}

TEST(Release, WhatIsUnknownHasNotPassedIt) {
  lang::Task a = task("a", forward);
  a.exits = {exit(when(above(0, 2.0)), to_done, 0.010)};
  a.exits[0].release = lang::Value{.constant = 1.0};
  lang::Program p = program({a});
  p.signals = {signal("near", SignalType::number, 0.002)};
  Bench bench(p);
  bench.hear(0, 3.0);
  bench.ticks_more(2);
  EXPECT_GT(bench.scheduler.dwell(0), 0.0);
  bench.ticks_more(4);
  EXPECT_EQ(bench.scheduler.dwell(0), 0.0) << "unknown restarts `for`";
  bench.hear(0, 1.5);
  bench.tick();
  EXPECT_GT(bench.scheduler.dwell(0), 0.0);
}

TEST(Order, ExitsOfAlwaysGoBeforeTheTimeoutAndTheTasksExitsAndTheOthersAreAlsoTrue) {
  lang::Task a = task("a", forward), b = task("b", standing);
  a.exits = {exit(after(0.003), to_done), exit(after(0.003), to_failed)};
  a.timeout = lang::Timeout{{.constant = 0.003}, to_failed, {}};
  lang::Program p = program({a, b});
  p.always.exits = {exit(when(apply(Op::less, number(1), number(0))), to_failed),
                    exit(after(0.003), to_task(1)), exit(after(0.003), to_failed)};
  Bench bench(p);
  bench.tick();
  EXPECT_EQ(bench.ticks_to_switch(10), 3);
  const Transition& t = bench.transitions.back();
  EXPECT_EQ(bench.scheduler.task(), 1);
  EXPECT_EQ(t.cause, Cause::always);
  EXPECT_EQ(t.exit, 1);
  EXPECT_EQ(t.also_always, 0b100u);
  EXPECT_TRUE(t.also_timeout);
  EXPECT_EQ(t.also_true, 0b11u);
}

TEST(End, AnExitOfAlwaysToFailedStillCountsWhileTheBaseBrakesForDone) {
  lang::Task a = task("a", forward);
  a.exits = {exit(after(0.001), to_done)};
  lang::Program p = program({a, task("pause", standing)});
  p.signals = {signal("stop", SignalType::boolean, 1e9), signal("near", SignalType::boolean, 1e9)};
  p.always.exits = {exit(when(heard(1)), to_task(1)), exit(when(heard(0)), to_failed)};
  Bench bench(p);
  bench.sensed.state.base_twist.linear = {0.5, 0.0, 0.0};
  bench.ticks_more(10);
  ASSERT_EQ(bench.scheduler.outcome(), Outcome::done);
  bench.hear(1, 1.0);
  bench.tick();
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::done) << "the run is over: no task is entered any more";
  bench.hear(0, 1.0);
  bench.tick();
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::failed);
}

}  // namespace
}  // namespace zwang::runtime
