// The effect of a switch of tasks on the sets of constraints in force, and on the commanded force of the
// wheels.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "robots.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scheduler.hpp"

namespace zwang::runtime {
namespace {

using namespace test;
using Constraints = std::vector<solver::AxisConstraint>;

/// A base that stands still, under tasks that switch by the clock.
struct Standing {
  explicit Standing(lang::Program p)
      : program(std::move(p)), scheduler(program, period), sensed(program.robot.model) {}
  const Constraints& tick() {
    sensed.time = ticks++ * period;
    scheduler.tick(sensed);
    return scheduler.constraints().constraints();
  }
  const Constraints& run_to(double time) {
    while (ticks * period < time + 0.5 * period) tick();
    return scheduler.constraints().constraints();
  }
  const Constraints& set(int i) { return scheduler.constraints(i).constraints(); }
  const InForce& in_force(int set, std::size_t i) { return scheduler.in_force(set).at(i); }
  /// The shares of all sets that have a constraint of which `is_it` is true.
  template <typename IsIt>
  double share_of(IsIt is_it) {
    double share = 0.0;
    for (int i = 0; i < scheduler.set_count(); ++i) {
      if (std::ranges::any_of(set(i), is_it)) share += scheduler.share(i);
    }
    return share;
  }
  lang::Program program;
  Scheduler scheduler;
  Sensed sensed;
  int ticks = 0;
};

lang::Program switching(lang::Task a, lang::Task b, double blend, double time = 1.0) {
  a.exits = {exit(after(time), to_task(1))};
  b.blend.constant = blend;
  return program({std::move(a), std::move(b)});
}

TEST(Blend, TheSetBeforeAndTheNewOneAreBothWholeAndTheirSharesSumToOne) {
  Standing bench(
      switching(task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}),
                task("b", {drive("go.x", Axis::x, Quantity::velocity, 0.2)}, base_link, world_frame), 0.1));
  bench.run_to(0.999);
  for (int i = 1; i < 100; ++i) {
    const Constraints& now = bench.tick();
    ASSERT_EQ(bench.scheduler.set_count(), 2);
    ASSERT_EQ(now.size(), 1u);
    ASSERT_EQ(bench.set(1).size(), 1u);
    EXPECT_EQ(now[0].driver->target, 0.2);
    EXPECT_EQ(bench.set(1)[0].driver->target, 0.1);
    EXPECT_NEAR(bench.scheduler.share(0), i * period / 0.1, 1e-7);
    EXPECT_NEAR(bench.scheduler.share(0) + bench.scheduler.share(1), 1.0, 1e-12);
    EXPECT_TRUE(bench.in_force(0, 0).active);
    EXPECT_FALSE(bench.in_force(1, 0).active) << "no axis of the new task is its";
    EXPECT_EQ(bench.in_force(0, 0).alpha, bench.scheduler.share(0));
  }
  const Constraints& c = bench.tick();
  ASSERT_EQ(bench.scheduler.set_count(), 1);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(bench.scheduler.share(0), 1.0);
  EXPECT_EQ(c[0].driver->target, 0.2);
}

// The constraints of `always` are in force from the first tick on: in the set that the run starts from, and
// in the new one.
TEST(Blend, AStartBlendsFromAlwaysAlone) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  a.blend.constant = 0.05;
  lang::Program p = program({a});
  p.always.groups = task("", {drive("rail.y", Axis::y, Quantity::velocity, 0.0)}).groups;
  Standing bench(p);
  for (int i = 1; i <= 60; ++i) {
    const Constraints& c = bench.tick();
    ASSERT_EQ(c.size(), 2u);
    EXPECT_NEAR(bench.scheduler.share(0), std::min(1.0, i * period / 0.05), 1e-7);
    EXPECT_NEAR(bench.share_of([](const auto& x) { return x.axis == Axis::y; }), 1.0, 1e-12);
    EXPECT_NEAR(bench.in_force(0, 0).alpha, 1.0, 1e-12);
    if (i >= 50) continue;
    ASSERT_EQ(bench.set(1).size(), 1u);
    EXPECT_EQ(bench.set(1)[0].axis, Axis::y);
  }
  EXPECT_EQ(bench.scheduler.set_count(), 1);
}

TEST(Blend, ZeroSwitchesAtOnce) {
  Standing bench(switching(task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}),
                           task("b", {drive("go.y", Axis::y, Quantity::velocity, 0.2)}), 0.0));
  const Constraints& c = bench.run_to(1.0);
  ASSERT_EQ(bench.scheduler.set_count(), 1);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(c[0].axis, Axis::y);
}

TEST(Blend, ARowOfTheSameAxisIsInBothSetsEachWithItsDriver) {
  Standing bench(switching(task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}),
                           task("b", {drive("go.x", Axis::x, Quantity::velocity, 0.2)}), 0.1));
  const Constraints& c = bench.run_to(1.0 + 0.029);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(c[0].driver->target, 0.2);
  ASSERT_EQ(bench.set(1).size(), 1u);
  EXPECT_EQ(bench.set(1)[0].driver->target, 0.1);
  EXPECT_NEAR(bench.scheduler.share(0), 0.3, 1e-7);
  EXPECT_NEAR(bench.in_force(0, 0).alpha, 1.0, 1e-12) << "the axis is driven throughout";
  EXPECT_EQ(bench.in_force(1, 0).origin, bench.in_force(0, 0).origin);
  EXPECT_TRUE(bench.in_force(1, 0).active);
}

TEST(Blend, RowsOfOtherKindsOrFramesAreNotInForceThroughout) {
  const lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  lang::Task level = task("b", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  level.groups[0].axes[0].level = 2;
  for (const lang::Task& b :
       {task("b", {drive("go.x", Axis::x, Quantity::force, 10.0)}),
        task("b", {drive("go.y", Axis::y, Quantity::velocity, 0.1)}),
        task("b", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}, bumper),
        task("b", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}, base_link, bumper), level}) {
    Standing bench(switching(a, b, 0.1));
    bench.run_to(1.02);
    EXPECT_NEAR(bench.in_force(0, 0).alpha, 0.21, 1e-7);
  }
}

TEST(Blend, AFrameThatWasSetAtTheSwitchMakesAnotherAxisOfIt) {
  // Both tasks move along x of the same frame, but the switch turns it: the set before keeps the old
  // direction.
  lang::Program p =
      switching(task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}, base_link, 3),
                task("b", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}, base_link, 3), 0.1);
  lang::FrameDeclaration touch;
  touch.name = "touch";
  p.frames.push_back(touch);
  p.tasks[0].exits[0].set = {{.index = 3, .source = base_link}};
  Standing bench(p);
  bench.sensed.state.base_pose.rotation = solver::rotation_from_rpy(0, 0, 1.0);
  const Constraints& c = bench.run_to(1.02);
  ASSERT_EQ(bench.scheduler.set_count(), 2);
  EXPECT_TRUE(bench.set(1)[0].in.pose.rotation.isIdentity());
  EXPECT_NEAR(c[0].in.pose.rotation(0, 0), std::cos(1.0), 1e-12);
  EXPECT_LT(bench.in_force(0, 0).alpha, 1.0);
}

// The shares of the two sets make of it what a bound is that tightens at once and loosens with the blend.
TEST(Blend, ABoundThatTightensDoesSoInBothSetsAtOnce) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}), b = a;
  b.name = "b";
  a.groups[0].axes[0].velocity = between(-0.2, 0.3);
  b.groups[0].axes[0].velocity = between(-0.4, 0.2);
  a.groups[0].axes[0].force = between(-50, 20);
  b.groups[0].axes[0].force = between(-10, 60);
  Standing bench(switching(a, b, 0.1));
  for (const double p : {0.01, 0.5, 0.99}) {
    const Constraints& now = bench.run_to(1.0 + 0.1 * p - period);
    const Constraints& before = bench.set(1);
    ASSERT_EQ(now.size(), 1u);
    ASSERT_EQ(before.size(), 1u);
    EXPECT_EQ(now[0].velocity->low, -0.4);
    EXPECT_EQ(now[0].velocity->high, 0.2);
    EXPECT_EQ(before[0].velocity->low, -0.2);
    EXPECT_EQ(before[0].velocity->high, 0.2);
    EXPECT_EQ(now[0].driver->force.low, -10);
    EXPECT_EQ(now[0].driver->force.high, 60);
    EXPECT_EQ(before[0].driver->force.low, -10);
    EXPECT_EQ(before[0].driver->force.high, 20);
    EXPECT_EQ(before[0].velocity_horizon, 0.010) << "it is not new";
  }
}

TEST(Blend, ARangeThatEntersJoinsTheSetBeforeAndOneThatLeavesStaysThere) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}), b = a;
  b.name = "b";
  a.groups[0].axes[0].acceleration = between(-1, 1);
  b.groups[0].axes[0].velocity = between(-2, 2);
  // On another axis, and the sum of forces of one that the old task drives.
  b.groups[0].axes.push_back(free_axis("go.y", Axis::y));
  b.groups[0].axes.back().velocity = between(-3, 3);
  lang::Group most = task("", {free_axis("most.x", Axis::x)}).groups[0];
  most.axes[0].force = between(-30, 30);
  most.axes[0].level = 0;
  b.groups.push_back(most);
  Standing bench(switching(a, b, 0.1));
  const Constraints& now = bench.run_to(1.0 + 0.024);
  const Constraints& before = bench.set(1);
  ASSERT_EQ(now.size(), 3u);
  EXPECT_FALSE(now[0].acceleration);
  ASSERT_EQ(before.size(), 3u);
  EXPECT_TRUE(before[0].acceleration && before[0].velocity && before[0].driver);
  EXPECT_NEAR(before[0].velocity_horizon, 0.075, 1e-9);
  EXPECT_NEAR(now[0].velocity_horizon, 0.075, 1e-9);
  for (int i = 1; i < 3; ++i) EXPECT_FALSE(before[static_cast<std::size_t>(i)].driver);
  EXPECT_EQ(before[1].velocity->high, 3.0);
  EXPECT_EQ(before[2].force->high, 30.0);
  EXPECT_EQ(bench.in_force(0, 1).alpha, 1.0) << "it is in force in both";
}

TEST(Blend, TakesAFifthOfASecondWhereTheTaskDoesNotSay) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  a.blend = lang::Task{}.blend;
  Standing bench(program({a}));
  for (int i = 1; i <= 220; ++i) {
    bench.tick();
    EXPECT_NEAR(bench.scheduler.share(0), std::min(1.0, i * period / 0.2), 1e-7);
  }
}

/// The limits of both sides of all sets, by set.
std::vector<std::vector<solver::Row>> limits_of(Standing& bench) {
  std::vector<std::vector<solver::Row>> limits;
  for (int set = 0; set < bench.scheduler.set_count(); ++set) {
    solver::ConstraintSet& constraints = bench.scheduler.constraints(set);
    EXPECT_TRUE(constraints.fill(bench.program.robot.model, bench.sensed.state));
    limits.emplace_back();
    for (const solver::Row& row : constraints.rows()) {
      if (row.kind == solver::RowKind::upper || row.kind == solver::RowKind::lower)
        limits.back().push_back(row);
    }
  }
  return limits;
}

// A range that enters is in force at once in both sets. An axis beyond the range has to be back when the
// blend is over. An axis inside the range feels it without a blend.
TEST(Blend, ARangeThatEntersActsAtOnceOverWhatIsLeftOfTheBlend) {
  const double blend = 0.2, speed = 0.5, limit = 0.3, horizon = 0.010;
  AxisStatements push = drive("go.x", Axis::x, Quantity::force, 10.0), limited = push;
  limited.velocity = between(-limit, limit);
  Standing bench(switching(task("a", {push}), task("b", {limited}), blend));
  bench.sensed.state.base_twist.linear = {speed, 0.0, 0.0};
  for (const int ticks : {1, 50, 150, 189, 195, 199, 200, 250}) {
    bench.run_to(0.999 + ticks * period);
    const auto limits = limits_of(bench);
    ASSERT_EQ(limits.size(), ticks < 200 ? 2u : 1u);
    for (const std::vector<solver::Row>& rows : limits) {
      ASSERT_EQ(rows.size(), 2u) << ticks;
      for (const solver::Row& row : rows) {
        const bool is_beyond = row.kind == solver::RowKind::upper;
        const double time = is_beyond ? std::max(horizon, blend - ticks * period) : horizon;
        EXPECT_NEAR(row.b, ((is_beyond ? limit : -limit) - speed) / time, 1e-4) << ticks;
      }
    }
  }
}

// A range that leaves stays whole in the sets that had it. Its demand stays the same, though it had only half
// entered.
TEST(Blend, ARangeThatLeavesStaysInTheSetsThatHadIt) {
  const double speed = 0.5, limit = 0.3, horizon = 0.010;
  AxisStatements push = drive("go.x", Axis::x, Quantity::force, 10.0), limited = push;
  limited.velocity = between(-limit, limit);
  lang::Task a = task("a", {push}), b = task("b", {limited}), c = task("c", {push});
  a.exits = {exit(after(1.0), to_task(1))};
  b.exits = {exit(after(0.1), to_task(2))};
  b.blend.constant = c.blend.constant = 0.2;
  Standing bench(program({a, b, c}));
  bench.sensed.state.base_twist.linear = {speed, 0.0, 0.0};
  bench.run_to(1.099);
  for (int i = 1; i < 200; ++i) {
    bench.tick();
    const auto limits = limits_of(bench);
    ASSERT_EQ(limits.size(), 3u);
    EXPECT_TRUE(limits[0].empty());
    for (const std::size_t set : {1u, 2u}) {
      ASSERT_EQ(limits[set].size(), 2u);
      EXPECT_NEAR(bench.scheduler.share(static_cast<int>(set)), 0.5 * (1.0 - i * period / 0.2), 1e-7) << i;
      for (const solver::Row& row : limits[set]) {
        const double bound = row.kind == solver::RowKind::upper ? limit : -limit;
        EXPECT_NEAR(row.b, (bound - speed) / horizon, 1e-9);
      }
    }
  }
  bench.tick();
  EXPECT_EQ(bench.scheduler.set_count(), 1);
}

TEST(Blend, ABoundThatSharesNothingWithTheNewOneGivesWayAtOnce) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.0)}), b = a;
  b.name = "b";
  for (const double side : {-1.0, 1.0}) {
    a.groups[0].axes[0].velocity = between(0.2 * side - 0.1, 0.2 * side + 0.1);
    b.groups[0].axes[0].velocity = between(-0.2 * side - 0.1, -0.2 * side + 0.1);
    Standing bench(switching(a, b, 0.1));
    for (const double p : {0.01, 0.5, 1.0}) {
      bench.run_to(1.0 + 0.1 * p - period);
      for (int set = 0; set < bench.scheduler.set_count(); ++set) {
        ASSERT_EQ(bench.set(set).size(), 1u);
        EXPECT_NEAR(bench.set(set)[0].velocity->low, -0.2 * side - 0.1, 1e-12) << p;
        EXPECT_NEAR(bench.set(set)[0].velocity->high, -0.2 * side + 0.1, 1e-12) << p;
      }
    }
  }
}

TEST(Blend, ASwitchInTheMiddleOfABlendMakesAThirdSet) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  lang::Task b = task("b", {drive("go.x", Axis::x, Quantity::force, 20)});
  lang::Task c = task("c", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}, bumper);
  a.exits = {exit(after(1.0), to_task(1))};
  b.exits = {exit(after(0.04), to_task(2))};
  b.blend.constant = c.blend.constant = 0.1;
  Standing bench(program({a, b, c}));
  std::map<std::pair<int, int>, double> last;  // (body pose key, kind) -> share
  double largest_step = 0.0;
  int most_sets = 0;
  for (int i = 0; i < 1300; ++i) {
    bench.tick();
    std::map<std::pair<int, int>, double> now;
    double sum = 0.0;
    most_sets = std::max(most_sets, bench.scheduler.set_count());
    for (int set = 0; set < bench.scheduler.set_count(); ++set) {
      const double share = bench.scheduler.share(set);
      for (const auto& x : bench.set(set)) {
        now[{x.move.pose.position.x() > 0.1 ? 1 : 0, static_cast<int>(x.driver->quantity)}] += share;
      }
      sum += share;
    }
    EXPECT_NEAR(sum, 1.0, 1e-7) << i;
    if (i > 0) {
      for (const auto& [key, share] : now) largest_step = std::max(largest_step, std::abs(share - last[key]));
      for (const auto& [key, share] : last) largest_step = std::max(largest_step, std::abs(share - now[key]));
    }
    last = now;
  }
  EXPECT_EQ(most_sets, 3);
  EXPECT_NEAR(largest_step, period / 0.1, 1e-7);
}

// The demand along an axis goes on from its value at the switch, half way from the first driver to the
// second.
TEST(Blend, WhatIsAskedForGoesOnFromWhereItIs) {
  const double blend = 0.1;
  const double targets[] = {0.1, 0.3, -0.2};
  std::vector<lang::Task> tasks;
  for (const double target : targets) {
    tasks.push_back(task("t", {drive("go.x", Axis::x, Quantity::velocity, target)}));
    tasks.back().blend.constant = blend;
  }
  tasks[0].exits = {exit(after(1.0), to_task(1))};
  tasks[1].exits = {exit(after(0.05), to_task(2))};
  Standing bench(program(tasks));
  bench.run_to(0.999);
  const double time_constant = tasks[0].groups[0].axes[0].time_constant.constant;
  for (int i = 1; i <= 160; ++i) {
    bench.tick();
    double b = 0.0;
    for (int set = 0; set < bench.scheduler.set_count(); ++set) {
      solver::ConstraintSet& constraints = bench.scheduler.constraints(set);
      ASSERT_TRUE(constraints.fill(bench.program.robot.model, bench.sensed.state));
      ASSERT_EQ(constraints.rows().size(), 1u);
      b += bench.scheduler.share(set) * constraints.rows()[0].b;
    }
    const double then = targets[0] + (targets[1] - targets[0]) * 0.5;
    const double asked = i <= 50 ? targets[0] + (targets[1] - targets[0]) * i * period / blend
                                 : then + (targets[2] - then) * std::min(1.0, (i - 50) * period / blend);
    EXPECT_NEAR(b, asked / time_constant, 1e-6) << i;
  }
}

TEST(Blend, RangesThatBothTasksHaveAreInBothSets) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  lang::Task b = task("b", {drive("go.x", Axis::x, Quantity::force, 10.0)});
  a.groups[0].axes[0].velocity = b.groups[0].axes[0].velocity = between(-0.3, 0.3);
  for (const auto& [from, to] : {std::pair(a, b), {b, a}}) {
    Standing bench(switching(from, to, 0.1));
    bench.run_to(0.999);
    for (int i = 1; i < 100; ++i) {
      bench.tick();
      for (int set = 0; set < 2; ++set) {
        ASSERT_EQ(bench.set(set).size(), 1u);
        EXPECT_EQ(bench.set(set)[0].velocity->high, 0.3);
        EXPECT_EQ(bench.set(set)[0].velocity_horizon, 0.010) << "it is not new";
      }
    }
  }
}

// An axis, a distance and two directions of one pair of frames.
TEST(Blend, OtherMeasuresOfTheSameFramesAreOtherAxes) {
  lang::Program p = program({});
  std::vector<lang::Task> tasks;
  for (const char* name : {"along_x", "along_y", "distance", "axis"}) {
    lang::Feature feature;
    feature.name = name;
    feature.kind = tasks.size() < 2 ? lang::FeatureKind::direction : lang::FeatureKind::distance;
    feature.first = bumper;
    feature.second = world_frame;
    feature.direction[tasks.size() < 2 ? tasks.size() : 0] = 1.0;
    tasks.push_back(task(name, {drive("go.x", Axis::x, Quantity::velocity, 0.1)}, bumper, world_frame));
    if (tasks.size() < 4) {
      tasks.back().groups[0].kind = lang::GroupKind::feature;
      tasks.back().groups[0].feature = static_cast<int>(p.features.size());
      p.features.push_back(feature);
    }
  }
  for (const auto& from : tasks) {
    for (const auto& to : tasks) {
      lang::Program both = switching(from, to, 0.1);
      both.features = p.features;
      Standing bench(both);
      bench.run_to(1.02);
      EXPECT_NEAR(bench.in_force(0, 0).alpha, from.name == to.name ? 1.0 : 0.21, 1e-7)
          << from.name << ", " << to.name;
    }
  }
}

TEST(Blend, GoingBackInTheMiddleOfABlendTakesOverWhatIsThere) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  lang::Task b = task("b", {drive("go.y", Axis::y, Quantity::velocity, 0.1)});
  a.blend.constant = b.blend.constant = 0.1;
  a.exits = {exit(after(1.0), to_task(1))};
  b.exits = {exit(after(0.05), to_task(0))};
  Standing bench(program({a, b}));
  double last = 1.0;
  bench.run_to(0.999);
  for (int i = 0; i < 200; ++i) {
    bench.tick();
    const double share = bench.share_of([](const auto& x) { return x.axis == Axis::x; });
    EXPECT_LE(std::abs(share - last), period / 0.1 + 1e-7);
    last = share;
  }
  EXPECT_EQ(last, 1.0);
}

// A value of `always` that the switch sets changes with the blend, as a task's does. A value that stays is in
// all sets as it is now.
TEST(Blend, WhatASwitchSetsOfAlwaysIsBlended) {
  lang::Program p = switching(task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}),
                              task("b", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}), 0.1);
  p.parameters.resize(1);
  p.parameters[0].name = "drift";
  p.parameters[0].value = 0.0;
  AxisStatements rail = drive("rail.y", Axis::y, Quantity::velocity, 0.0);
  rail.target.parameter = 0;
  p.always.groups = task("", {rail, drive("rail.rz", Axis::rz, Quantity::velocity, 0.0)}).groups;
  lang::SetAction set;
  set.kind = lang::SetKind::parameter;
  set.index = 0;
  set.value.constant = 0.2;
  p.tasks[0].exits[0].set = {set};
  Standing bench(p);
  const Constraints& now = bench.run_to(1.02);
  ASSERT_EQ(bench.set(1).size(), 3u);
  EXPECT_EQ(now[0].driver->target, 0.2);
  EXPECT_EQ(bench.set(1)[0].driver->target, 0.0);
  EXPECT_EQ(bench.set(1)[1].driver->target, 0.0);
}

TEST(Blend, ASwitchOnEveryTickStaysWithinThreeSetsAndTheCapacity) {
  // Six tasks that all differ in frames: no axis goes on, everything enters and leaves.
  std::vector<lang::Task> tasks;
  for (int i = 0; i < 6; ++i) {
    lang::Task t =
        task(std::string(1, static_cast<char>('a' + i)),
             {drive("go.x", Axis::x, Quantity::force, 1.0), drive("go.y", Axis::y, Quantity::force, 1.0)},
             i < 3 ? base_link : bumper, i % 3);
    t.blend.constant = 0.5;
    // Beside a force driver every range is two rows.
    for (AxisStatements& axis : t.groups[0].axes) axis.velocity = axis.acceleration = between(-1, 1);
    t.exits = {exit(always_true(), to_task((i + 1) % 6))};
    tasks.push_back(t);
  }
  Standing bench(program(tasks));
  for (int i = 0; i < 500; ++i) {
    bench.tick();
    ASSERT_LE(bench.scheduler.set_count(), 3);
    double sum = 0.0;
    for (int set = 0; set < bench.scheduler.set_count(); ++set) {
      ASSERT_TRUE(bench.scheduler.constraints(set).fill(bench.program.robot.model, bench.sensed.state)) << i;
      ASSERT_EQ(bench.scheduler.in_force(set).size(), bench.set(set).size());
      sum += bench.scheduler.share(set);
      // The newest ranges are in all sets.
      const auto is_newest = [&](const auto& c) {
        return c.velocity && c.move.pose.position == bench.set(0)[0].move.pose.position &&
               c.in.body == bench.set(0)[0].in.body;
      };
      EXPECT_TRUE(std::ranges::any_of(bench.set(set), is_newest)) << i << " " << set;
    }
    EXPECT_NEAR(sum, 1.0, 1e-9);
  }
}

/// Runs two tasks on the moving test base. `largest` is the largest step of the commanded planar force in one
/// tick from the switch on. `whole` is the largest change of force that the switch brings about in all.
struct Steps {
  double largest = 0.0;
  double whole = 0.0;
};
Steps commanded_steps(const lang::Task& from, const lang::Task& to, double blend) {
  Runner runner(switching(from, to, blend, 3.0));
  PlanarBase base;
  const lang::Robot robot = mecanum_robot();
  Sensed sensed(robot.model);
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  Eigen::Vector3d at_switch = Eigen::Vector3d::Zero();
  Steps steps;
  while (base.time < 3.6) {
    base.sense(sensed);
    const Eigen::VectorXd& tau = runner.step(sensed);
    EXPECT_EQ(runner.guard_status(), GuardStatus::passed) << "the torque limits must not shape this test";
    const Eigen::Vector3d force = base.commanded(tau);
    if (runner.scheduler().task() == 0) at_switch = force;
    if (runner.scheduler().task() == 1 && runner.scheduler().elapsed() < blend + 0.01) {
      steps.largest = std::max(steps.largest, (force - last).head<2>().norm());
      steps.whole = std::max(steps.whole, (force - at_switch).head<2>().norm());
    }
    last = force;
    base.step(tau);
  }
  return steps;
}

TEST(CommandedForce, StepsByNoMoreThanTheBlendsShareOfWhatFades) {
  const double blend = 0.2;
  const auto rest = [](AxisStatements x) {
    return std::vector<AxisStatements>{x, drive("go.y", Axis::y, Quantity::velocity, 0.0),
                                       drive("go.rz", Axis::rz, Quantity::velocity, 0.0)};
  };
  // At a steady 0.4 m/s nothing pushes; the new task brakes with what its time constant asks for.
  AxisStatements fast = drive("go.x", Axis::x, Quantity::velocity, 0.4);
  AxisStatements slow = drive("go.x", Axis::x, Quantity::velocity, 0.0);
  fast.time_constant.constant = slow.time_constant.constant = 0.2;
  const double mass = PlanarBase().inertia()(0, 0);
  const double hard_step = mass * 0.4 / 0.2;

  const Steps hard =
      commanded_steps(task("a", rest(fast)), task("b", rest(slow), base_link, world_frame), 0.0);
  EXPECT_NEAR(hard.largest, hard_step, 1e-3 * hard_step);

  // In the base's axes the rows persist, and only b blends.
  const double share = hard_step * period / blend;
  const Steps persisting = commanded_steps(task("a", rest(fast)), task("b", rest(slow)), blend);
  EXPECT_GT(persisting.whole, 0.2 * hard_step) << "the switch must do something";
  EXPECT_LE(persisting.largest, share * (1 + 1e-5));

  // In the world's axes the rows are others, and the blend is the same: (1 - p) D1 + p D2 of what each asks
  // for.
  const Steps fading =
      commanded_steps(task("a", rest(fast)), task("b", rest(slow), base_link, world_frame), blend);
  EXPECT_GT(fading.whole, 0.2 * hard_step);
  EXPECT_LE(fading.largest, share * (1 + 1e-5));
}

TEST(CommandedForce, OfAPushThatIsHandedOverStaysAndAPushThatEndsFades) {
  const auto push = [](double f) {
    return std::vector<AxisStatements>{drive("go.x", Axis::x, Quantity::force, f),
                                       drive("go.y", Axis::y, Quantity::velocity, 0.0)};
  };
  // The same push in other axes: 20 (1 - p) + 20 p.
  const Steps handed = commanded_steps(task("a", push(20)), task("b", push(20), base_link, world_frame), 0.2);
  EXPECT_LE(handed.whole, 0.05);
  const Steps ended = commanded_steps(task("a", push(20)), task("b", push(0)), 0.2);
  EXPECT_NEAR(ended.whole, 20.0, 0.2);
  EXPECT_LE(ended.largest, 20.0 * period / 0.2 * 1.01);
  const Steps cut = commanded_steps(task("a", push(20)), task("b", push(0)), 0.0);
  EXPECT_NEAR(cut.largest, 20.0, 0.2);
}

// 20 N of a velocity driver that something holds, before the switch and after it: the guards read 20 N
// throughout.
TEST(CommandedForce, IsReadOfAllSetsByTheirShares) {
  AxisStatements push = drive("go.x", Axis::x, Quantity::velocity, 0.5), gently = push;
  push.force = gently.force = between(-20, 20);
  gently.target.constant = 0.4;
  Runner runner(switching(task("a", {push}), task("b", {gently}), 0.1));
  PlanarBase base;
  Sensed sensed(mecanum_robot().model);
  base.V.x() = 0.01;  // something yields at this speed, whatever pushes
  while (base.time < 1.2) {
    base.sense(sensed);
    const Eigen::VectorXd& tau = runner.step(sensed);
    base.step(tau, -base.commanded(tau));
    if (base.time < 0.95) continue;
    const Scheduler& scheduler = runner.scheduler();
    EXPECT_NEAR(scheduler.reading({scheduler.task(), 0, 0}).force, 20.0, 1e-6) << base.time;
  }
}

}  // namespace
}  // namespace zwang::runtime
