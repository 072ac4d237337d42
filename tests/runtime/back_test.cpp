// Each test is a sentence of the task language's section "The scheduler": `back` and `attempts`.
#include "interrupted_work.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

TEST(Back, ResumesTheInterruptedTaskAndItsTimeoutKeepsTheTimeAlreadySpent) {
  lang::Program p = interrupted_work();
  p.tasks[0].timeout = lang::Timeout{{.constant = 0.030}, to_failed, {}};
  Bench bench(p);
  bench.hear(0, 5.0);
  bench.ticks_more(11);  // entry and 10 ms
  bench.hear(0, 0.5);
  bench.tick();  // interrupted after 11 ms
  ASSERT_EQ(bench.scheduler.task(), pause);
  bench.hear(0, 5.0);
  bench.ticks_more(1);
  EXPECT_TRUE(bench.transitions.back().resumes);
  EXPECT_EQ(bench.scheduler.task(), work);
  EXPECT_NEAR(bench.scheduler.elapsed(), 0.011, 1e-9);
  EXPECT_EQ(bench.ticks_to_switch(100), 19);
  EXPECT_EQ(bench.transitions.back().cause, Cause::timeout);
}

TEST(Back, HereIsTakenAnew) {
  lang::Program p = interrupted_work();
  AxisStatements hold = drive("go.x", Axis::x, Quantity::position, 0.0);
  hold.here = true;
  p.tasks[0].groups = task("", {hold}, base_link, world_frame).groups;
  Bench bench(p);
  bench.hear(0, 5.0);
  bench.sensed.state.base_pose.position.x() = 1.0;
  bench.tick();
  EXPECT_EQ(bench.constraint(0).driver->target, 1.0);
  bench.hear(0, 0.5);
  bench.tick();
  bench.sensed.state.base_pose.position.x() = 3.0;
  bench.hear(0, 5.0);
  bench.tick();
  ASSERT_EQ(bench.scheduler.task(), work);
  EXPECT_EQ(bench.constraint(0).driver->target, 3.0);
}

TEST(Back, IsNoEntryAttemptsRequireAndSetAreUntouched) {
  lang::Program p = interrupted_work();
  p.parameters.resize(1);
  p.parameters[0].value = 1.0;
  lang::SetAction set;
  set.kind = lang::SetKind::parameter;
  set.index = 0;
  set.value.constant = 2.0;
  p.tasks[0].set_on_entry = {set};
  p.tasks[0].attempts = lang::Attempts{1, to_failed, {}};
  // True on the entry at x = 0, and never again.
  p.tasks[0].require = when(apply(Op::less, coordinate(0, 0, CoordinateQuantity::position), number(0.5)));
  p.tasks[0].groups[0].in = world_frame;
  lang::SetAction other = set;
  other.value.constant = 3.0;
  p.tasks[1].exits[0].set = {other};
  Bench bench(p);
  bench.hear(0, 5.0);
  bench.tick();
  EXPECT_EQ(bench.scheduler.parameters()[0], 2.0);
  bench.sensed.state.base_pose.position.x() = 1.0;
  bench.hear(0, 0.5);
  bench.tick();
  bench.hear(0, 5.0);
  bench.tick();
  EXPECT_EQ(bench.scheduler.task(), work);
  EXPECT_EQ(bench.scheduler.parameters()[0], 3.0) << "the exit's own `set` is run, the entry's is not";
}

TEST(Back, MovedGoesOnFromWhereTheInterruptionCame) {
  lang::Program p = interrupted_work();
  p.tasks[0].exits = {exit(when(apply(Op::greater, call("moved", base_link), number(0.95))), to_done)};
  Bench bench(p);
  double& x = bench.sensed.state.base_pose.position.x();
  bench.hear(0, 5.0);
  bench.tick();
  x = 0.6;
  bench.tick();
  bench.hear(0, 0.5);
  bench.tick();
  x = 2.0;  // moved while interrupted
  bench.tick();
  bench.hear(0, 5.0);
  bench.tick();
  ASSERT_EQ(bench.scheduler.task(), work);
  x = 2.3;
  bench.tick();
  EXPECT_EQ(bench.scheduler.task(), work);
  x = 2.4;
  bench.tick();
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::done);
}

TEST(Back, AnInterruptionOfAnInterruptionDoesNotOverwriteWhereItLeads) {
  lang::Program p = interrupted_work();
  lang::Task wait = task("wait", standing);
  wait.exits = {exit(when(above(1, 2.0)), back)};
  p.tasks.push_back(wait);
  p.always.exits.push_back(exit(when(below(1, 1.0)), to_task(2)));
  Bench bench(p);
  bench.hear(0, 5.0);
  bench.hear(1, 5.0);
  bench.ticks_more(5);
  bench.hear(0, 1.5);
  bench.hear(0, 0.5);
  bench.tick();
  ASSERT_EQ(bench.scheduler.task(), pause);
  bench.hear(0, 1.5);  // neither interrupts any more nor leads back
  bench.hear(1, 0.5);
  bench.tick();
  ASSERT_EQ(bench.scheduler.task(), 2);
  bench.hear(1, 5.0);
  bench.tick();
  EXPECT_EQ(bench.scheduler.task(), work);
}

TEST(Back, UnderAlwaysLeadsThereFromAnyTaskAndIsIgnoredWhereNothingWasInterrupted) {
  lang::Program p = interrupted_work();
  p.always.exits.push_back(exit(when(above(0, 2.0)), back));
  p.tasks[1].exits = {exit(after(0.005), to_task(2))};
  p.tasks.push_back(task("wait", standing));
  p.tasks[2].exits = {exit(after(1e6), to_done)};
  Bench bench(p);
  bench.hear(0, 5.0);
  bench.ticks_more(10);
  EXPECT_EQ(bench.transitions.size(), 1u) << "nothing was interrupted";
  EXPECT_NEAR(bench.scheduler.elapsed(), 9 * period, 1e-12);
  for (const bool goes_on : {false, true}) {
    bench.hear(0, 0.5);
    bench.tick();
    ASSERT_EQ(bench.scheduler.task(), pause);
    bench.hear(0, 1.5);
    bench.ticks_more(goes_on ? 8 : 3);
    ASSERT_EQ(bench.scheduler.task(), goes_on ? 2 : pause);
    bench.hear(0, 5.0);
    bench.ticks_more(5);
    ASSERT_EQ(bench.scheduler.task(), work);
    EXPECT_TRUE(bench.transitions.back().resumes);
  }
}

TEST(Back, AnInterruptionIsOverInATaskFromWhichNoBackCanFollow) {
  lang::Program p = interrupted_work();
  lang::Task elsewhere = task("elsewhere", forward);
  elsewhere.exits = {exit(after(1e6), to_done)};
  p.tasks.push_back(elsewhere);
  p.tasks[1].timeout = lang::Timeout{{.constant = 0.005}, to_task(2), {}};
  Bench bench(p);
  bench.hear(0, 0.5);
  bench.ticks_more(2);
  ASSERT_EQ(bench.scheduler.task(), pause);
  bench.hear(0, 1.5);
  ASSERT_EQ(bench.ticks_to_switch(20), 5);
  ASSERT_EQ(bench.scheduler.task(), 2);
  bench.hear(0, 0.5);
  bench.tick();
  ASSERT_EQ(bench.scheduler.task(), pause);
  bench.hear(0, 5.0);
  bench.tick();
  EXPECT_EQ(bench.scheduler.task(), 2) << "back leads to what was interrupted last";
}

TEST(Attempts, EntryNPlusOneSinceTheStartGoesToItsGoto) {
  lang::Task a = task("a", forward), b = task("b", standing), c = task("c", standing);
  a.exits = {exit(after(0.002), to_task(1))};
  b.exits = {exit(after(0.002), to_task(0))};
  b.attempts = lang::Attempts{3, to_task(2), {}};
  c.exits = {exit(after(1e6), to_done)};
  Bench bench(program({a, b, c}));
  int entries = 0;
  for (int i = 0; i < 100 && bench.scheduler.task() != 2; ++i) {
    bench.tick();
    if (bench.scheduler.transition() && bench.scheduler.task() == 1) ++entries;
  }
  EXPECT_EQ(entries, 3);
  ASSERT_EQ(bench.scheduler.task(), 2);
  EXPECT_EQ(bench.transitions.back().refusal, Refusal::attempts);
  EXPECT_EQ(bench.transitions.back().refused, 1);
  EXPECT_EQ(bench.scheduler.why(bench.transitions.back()), "elapsed, but `b` was entered 3 times");
}

TEST(Attempts, InterruptionsAreEntriesToo) {
  lang::Program p = interrupted_work();
  p.tasks[1].attempts = lang::Attempts{2, to_failed, {}};
  Bench bench(p);
  for (int entry = 1; entry <= 2; ++entry) {
    bench.hear(0, 0.5);
    bench.ticks_more(2);
    ASSERT_EQ(bench.scheduler.task(), pause) << entry;
    bench.hear(0, 5.0);
    bench.ticks_more(2);
    ASSERT_EQ(bench.scheduler.task(), work) << entry;
  }
  bench.hear(0, 0.5);
  bench.tick();
  EXPECT_EQ(bench.transitions.back().refusal, Refusal::attempts);
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::failed);
}

/// From then on it is interrupted no more: its exits count and its timeout runs, though the condition stays
/// true.
TEST(Attempts, ThatLeadBackLetTheTaskGoOn) {
  for (const auto& [to, by_timeout] : {std::pair(back, false), {back, true}, {to_task(work), false}}) {
    lang::Program p = interrupted_work();
    p.tasks[1].attempts = lang::Attempts{1, to, {}};
    if (by_timeout) {
      p.tasks[0].timeout = lang::Timeout{{.constant = 0.015}, to_done, {}};
    } else {
      p.tasks[0].exits = {exit(after(0.006), to_done, 0.010)};
    }
    Bench bench(p);
    bench.hear(0, 0.5);
    bench.ticks_more(2);
    ASSERT_EQ(bench.scheduler.task(), pause);
    bench.hear(0, 5.0);
    bench.tick();
    ASSERT_EQ(bench.scheduler.task(), work);
    bench.hear(0, 0.5);
    EXPECT_EQ(bench.ticks_to_switch(100), 14) << "after 1 ms before the interruption";
    EXPECT_EQ(bench.scheduler.outcome(), Outcome::done);
  }
}

TEST(Attempts, ThatLeadToOneAnotherInACircleFail) {
  lang::Task a = task("a", forward), b = task("b", standing);
  a.attempts = lang::Attempts{1, to_task(1), {}};
  b.attempts = lang::Attempts{1, to_task(0), {}};
  a.exits = {exit(after(0.001), to_task(1))};
  b.exits = {exit(after(0.001), to_task(0))};
  Bench bench(program({a, b}));
  bench.ticks_more(3);
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::failed);
}

}  // namespace
}  // namespace zwang::runtime
