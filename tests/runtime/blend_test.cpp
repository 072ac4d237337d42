// The effect of a switch of tasks on the sets of constraints in force, and on the commanded force of the
// wheels.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "blend_bench.hpp"
#include "robots.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scheduler.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

TEST(Blend, TheSetBeforeAndTheNewOneAreBothWholeAndTheirSharesSumToOne) {
  Standing bench(switching_tasks(
      task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}),
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
  Standing bench(switching_tasks(task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}),
                                 task("b", {drive("go.y", Axis::y, Quantity::velocity, 0.2)}), 0.0));
  const Constraints& c = bench.run_to(1.0);
  ASSERT_EQ(bench.scheduler.set_count(), 1);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(c[0].axis, Axis::y);
}

TEST(Blend, ARowOfTheSameAxisIsInBothSetsEachWithItsDriver) {
  Standing bench(switching_tasks(task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}),
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
    Standing bench(switching_tasks(a, b, 0.1));
    bench.run_to(1.02);
    EXPECT_NEAR(bench.in_force(0, 0).alpha, 0.21, 1e-7);
  }
}

TEST(Blend, AFrameThatWasSetAtTheSwitchMakesAnotherAxisOfIt) {
  // Both tasks move along x of the same frame, but the switch turns it: the set before keeps the old
  // direction.
  lang::Program p =
      switching_tasks(task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}, base_link, 3),
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

TEST(Blend, TakesAFifthOfASecondWhereTheTaskDoesNotSay) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  a.blend = lang::Task{}.blend;
  Standing bench(program({a}));
  for (int i = 1; i <= 220; ++i) {
    bench.tick();
    EXPECT_NEAR(bench.scheduler.share(0), std::min(1.0, i * period / 0.2), 1e-7);
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
      lang::Program both = switching_tasks(from, to, 0.1);
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
  lang::Program p = switching_tasks(task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}),
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

}  // namespace
}  // namespace zwang::runtime
