// Which samples of a signal count, and what follows from one that is missing.
#include "scheduler_bench.hpp"

namespace zwang::runtime {
namespace {

using namespace test;
using lang::SignalType;

TEST(Signal, NeverReceivedAgesFromTheStartOfTheRun) {
  lang::Program p = program({task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}),
                             task("b", {drive("go.x", Axis::x, Quantity::velocity, 0.0)})});
  p.signals = {signal("scanner", SignalType::number, 0.025)};
  p.always.exits = {exit(when(apply(Op::less, name(Op::signal, 0), number(1.0))), to_task(1))};
  Bench bench(p);
  bench.ticks = 5000;  // the run starts late in the clock's life
  bench.sensed.time = 5.0;
  bench.tick();
  EXPECT_EQ(bench.ticks_to_switch(100), 26);
  EXPECT_EQ(bench.scheduler.task(), 1);
}

TEST(Signal, ValidTellsWhetherItIsFresh) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  a.exits = {exit(when(name(Op::valid, 0)), to_done, 1e6)};
  lang::Program p = program({a});
  p.signals = {signal("scanner", SignalType::number, 0.005)};
  Bench bench(p);
  bench.ticks_more(3);
  EXPECT_EQ(bench.scheduler.dwell(0), 0.0);
  bench.hear(0, 1.0);
  bench.ticks_more(6);
  EXPECT_NEAR(bench.scheduler.dwell(0), 0.006, 1e-12);
  bench.tick();
  EXPECT_EQ(bench.scheduler.dwell(0), 0.0);
}

TEST(Signal, SamplesThatAreInvalidNotFiniteOldOrFromTheFutureAreIgnored) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  a.groups[0].axes[0].target.signal = 0;
  lang::Program p = program({a});
  p.signals = {signal("pace", SignalType::number, 1.0)};
  Bench bench(p);
  bench.ticks_more(10);
  bench.hear(0, 0.5);
  bench.tick();
  const auto target_after = [&](bool valid, double stamp, double value) {
    bench.sensed.signals[0] = SignalSample{};
    bench.sensed.signals[0].valid = valid;
    bench.sensed.signals[0].stamp = stamp;
    bench.sensed.signals[0].number = value;
    bench.tick();
    return bench.constraint(0).driver->target;
  };
  EXPECT_EQ(target_after(false, bench.sensed.time, 0.1), 0.5);
  EXPECT_EQ(target_after(true, bench.sensed.time, std::nan("")), 0.5);
  EXPECT_EQ(target_after(true, 0.002, 0.2), 0.5) << "older than what came before";
  EXPECT_EQ(target_after(true, bench.sensed.time + 0.5, 0.3), 0.5);
  EXPECT_EQ(target_after(true, bench.sensed.time, 0.4), 0.4);
}

TEST(Signal, ANumberDrivesAndWhileItIsInvalidTheAxisStandsStillWithTheSameForceRange) {
  lang::Task a = task(
      "a", {drive("go.x", Axis::x, Quantity::velocity, 0.1), drive("go.y", Axis::y, Quantity::force, 0.1)});
  a.groups[0].axes[0].target.signal = 0;
  a.groups[0].axes[0].force = between(-7, 8);
  a.groups[0].axes[1].target.signal = 0;
  lang::Program p = program({a});
  p.signals = {signal("pace", SignalType::number, 0.010)};
  Bench bench(p);
  bench.hear(0, 0.25);
  bench.ticks_more(11);
  EXPECT_EQ(bench.constraint(0).driver->target, 0.25);
  EXPECT_EQ(bench.constraint(1).driver->target, 0.25);
  bench.tick();
  EXPECT_EQ(bench.constraint(0).driver->quantity, Quantity::velocity);
  EXPECT_EQ(bench.constraint(0).driver->target, 0.0);
  EXPECT_EQ(bench.constraint(0).driver->force.high, 8.0);
  EXPECT_EQ(bench.constraint(1).driver->target, 0.0) << "a force that nobody knows is none";
}

TEST(Signal, ABooleanIsAConditionByItself) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  a.exits = {exit(when(name(Op::signal, 0)), to_done, 0.003)};
  lang::Program p = program({a});
  p.signals = {signal("latch", SignalType::boolean, 1.0)};
  Bench bench(p);
  bench.hear(0, 0.0);
  bench.ticks_more(20);
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::none);
  bench.hear(0, 1.0);
  EXPECT_EQ(bench.ticks_to_switch(10), 3);
}

}  // namespace
}  // namespace zwang::runtime
