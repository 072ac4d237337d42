// What a switch of tasks does to the constraints in force, and to the force that the wheels are told to make.
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

TEST(Blend, WhatLeavesFadesOutWhileWhatEntersFadesInAndTheAlphasSumToOne) {
  Standing bench(
      switching(task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}),
                task("b", {drive("go.x", Axis::x, Quantity::velocity, 0.2)}, base_link, world_frame), 0.1));
  bench.run_to(0.999);
  for (int i = 1; i < 100; ++i) {
    const Constraints& c = bench.tick();
    ASSERT_EQ(c.size(), 2u);
    const auto& entering = c[0].leaving ? c[1] : c[0];
    const auto& leaving = c[0].leaving ? c[0] : c[1];
    ASSERT_TRUE(leaving.leaving && !entering.leaving);
    EXPECT_EQ(leaving.driver->target, 0.1);
    EXPECT_NEAR(entering.alpha, i * period / 0.1, 1e-7);
    EXPECT_NEAR(entering.alpha + leaving.alpha, 1.0, 1e-12);
    EXPECT_EQ(entering.blend, 0.1);
  }
  const Constraints& c = bench.tick();
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(c[0].alpha, 1.0);
  EXPECT_EQ(c[0].driver->target, 0.2);
}

TEST(Blend, AStartFadesInFromNothing) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  a.blend.constant = 0.05;
  Standing bench(program({a}));
  for (int i = 1; i <= 60; ++i) {
    const Constraints& c = bench.tick();
    ASSERT_EQ(c.size(), 1u);
    EXPECT_NEAR(c[0].alpha, std::min(1.0, i * period / 0.05), 1e-7);
  }
}

TEST(Blend, ZeroSwitchesAtOnce) {
  Standing bench(switching(task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}),
                           task("b", {drive("go.y", Axis::y, Quantity::velocity, 0.2)}), 0.0));
  const Constraints& c = bench.run_to(1.0);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(c[0].axis, Axis::y);
  EXPECT_EQ(c[0].alpha, 1.0);
}

TEST(Blend, APersistingRowGoesFromTheOldDriverToTheNewOne) {
  Standing bench(switching(task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}),
                           task("b", {drive("go.x", Axis::x, Quantity::velocity, 0.2)}), 0.1));
  const Constraints& c = bench.run_to(1.0 + 0.029);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(c[0].alpha, 1.0);
  EXPECT_FALSE(c[0].leaving);
  EXPECT_EQ(c[0].before->target, 0.1);
  EXPECT_EQ(c[0].driver->target, 0.2);
  EXPECT_NEAR(c[0].progress, 0.3, 1e-7);
}

TEST(Blend, RowsOfOtherKindsOrFramesDoNotPersist) {
  const lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  lang::Task level = task("b", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  level.groups[0].axes[0].level = 2;
  for (const lang::Task& b :
       {task("b", {drive("go.x", Axis::x, Quantity::force, 10.0)}),
        task("b", {drive("go.y", Axis::y, Quantity::velocity, 0.1)}),
        task("b", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}, bumper),
        task("b", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}, base_link, bumper), level}) {
    Standing bench(switching(a, b, 0.1));
    EXPECT_EQ(bench.run_to(1.02).size(), 2u);
  }
}

TEST(Blend, AFrameThatWasSetAtTheSwitchMakesAnotherAxisOfIt) {
  // Both tasks move along x of the same frame, but the switch turns it: the old direction must fade, not
  // jump.
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
  ASSERT_EQ(c.size(), 2u);
  const auto& leaving = c[0].leaving ? c[0] : c[1];
  const auto& entering = c[0].leaving ? c[1] : c[0];
  EXPECT_TRUE(leaving.in.pose.rotation.isIdentity());
  EXPECT_NEAR(entering.in.pose.rotation(0, 0), std::cos(1.0), 1e-12);
}

TEST(Blend, APersistingBoundTightensAtOnceAndLoosensWithTheBlend) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}), b = a;
  b.name = "b";
  a.groups[0].axes[0].velocity = between(-0.2, 0.3);
  b.groups[0].axes[0].velocity = between(-0.4, 0.2);
  a.groups[0].axes[0].force = between(-50, 20);
  b.groups[0].axes[0].force = between(-10, 60);
  Standing bench(switching(a, b, 0.1));
  for (const double p : {0.01, 0.5, 0.99}) {
    const Constraints& c = bench.run_to(1.0 + 0.1 * p - period);
    ASSERT_EQ(c.size(), 1u);
    EXPECT_NEAR(c[0].velocity->high, 0.2, 1e-12);
    EXPECT_NEAR(c[0].velocity->low, -0.2 - 0.2 * p, 1e-7);
    EXPECT_NEAR(c[0].driver->force.low, -10, 1e-12);
    EXPECT_NEAR(c[0].driver->force.high, 20 + 40 * p, 1e-6);
    EXPECT_FALSE(std::isfinite(c[0].before->force.high))
        << "the old bound must not cut off the loosening one";
  }
  const Constraints& c = bench.run_to(1.1);
  EXPECT_EQ(c[0].velocity->low, -0.4);
  EXPECT_EQ(c[0].driver->force.high, 60);
}

TEST(Blend, RangesOnOneSideOfTheSwitchFadeOnTheirOwn) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}), b = a;
  b.name = "b";
  a.groups[0].axes[0].acceleration = between(-1, 1);
  b.groups[0].axes[0].velocity = between(-2, 2);
  Standing bench(switching(a, b, 0.1));
  const Constraints& c = bench.run_to(1.0 + 0.024);
  ASSERT_EQ(c.size(), 3u);
  const auto find = [&c](auto&& wanted) { return std::find_if(c.begin(), c.end(), wanted); };
  const auto driver = find([](const auto& x) { return x.driver.has_value(); });
  const auto old_range = find([](const auto& x) { return x.acceleration.has_value(); });
  const auto new_range = find([](const auto& x) { return x.velocity.has_value(); });
  EXPECT_EQ(driver->alpha, 1.0);
  EXPECT_FALSE(driver->velocity || driver->acceleration);
  EXPECT_TRUE(old_range->leaving && !old_range->driver);
  EXPECT_NEAR(old_range->alpha, 0.75, 1e-7);
  EXPECT_TRUE(!new_range->leaving && !new_range->driver);
  EXPECT_NEAR(new_range->alpha, 0.25, 1e-7);
  EXPECT_EQ(new_range->blend, 0.1);
}

TEST(Blend, TakesAFifthOfASecondWhereTheTaskDoesNotSay) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  a.blend = lang::Task{}.blend;
  Standing bench(program({a}));
  for (int i = 1; i <= 220; ++i) EXPECT_NEAR(bench.tick()[0].alpha, std::min(1.0, i * period / 0.2), 1e-7);
}

// A range that enters is on at once: of what is beyond it, it asks to be back when the blend is over; what is
// inside feels it as always.
TEST(Blend, ARangeThatEntersActsAtOnceOverWhatIsLeftOfTheBlend) {
  const double blend = 0.2, speed = 0.5, limit = 0.3, horizon = 0.010;
  AxisStatements push = drive("go.x", Axis::x, Quantity::force, 10.0), limited = push;
  limited.velocity = between(-limit, limit);
  Standing bench(switching(task("a", {push}), task("b", {limited}), blend));
  bench.sensed.state.base_twist.linear = {speed, 0.0, 0.0};
  for (const int ticks : {1, 50, 150, 189, 195, 199, 200, 250}) {
    bench.run_to(0.999 + ticks * period);
    solver::ConstraintSet& set = bench.scheduler.constraints();
    ASSERT_TRUE(set.fill(bench.program.robot.model, bench.sensed.state));
    int found = 0;
    for (const solver::Row& row : set.rows()) {
      if (row.kind != solver::RowKind::upper && row.kind != solver::RowKind::lower) continue;
      const bool is_beyond = row.kind == solver::RowKind::upper;
      const double time = is_beyond ? std::max(horizon, blend - ticks * period) : horizon;
      EXPECT_NEAR(row.b, ((is_beyond ? limit : -limit) - speed) / time, 1e-4) << ticks;
      EXPECT_EQ(row.fade, 1.0) << ticks;
      ++found;
    }
    EXPECT_EQ(found, 2) << ticks;
  }
}

// Where it leaves it lets go in the measure that its alpha falls, and asks for what it has always asked for,
// though it had only half entered.
TEST(Blend, ARangeThatLeavesFadesWithItsRows) {
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
    solver::ConstraintSet& set = bench.scheduler.constraints();
    ASSERT_TRUE(set.fill(bench.program.robot.model, bench.sensed.state));
    int found = 0;
    for (const solver::Row& row : set.rows()) {
      if (row.kind != solver::RowKind::upper && row.kind != solver::RowKind::lower) continue;
      EXPECT_NEAR(row.fade, 0.5 * (1.0 - i * period / 0.2), 1e-7) << i;
      EXPECT_NEAR(row.b, ((row.kind == solver::RowKind::upper ? limit : -limit) - speed) / horizon, 1e-9);
      ++found;
    }
    EXPECT_EQ(found, 2) << i;
  }
  bench.tick();
  EXPECT_EQ(bench.scheduler.constraints().constraints().size(), 1u);
}

TEST(Blend, APersistingBoundThatSharesNothingWithTheNewOneGivesWayAtOnce) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.0)}), b = a;
  b.name = "b";
  for (const double side : {-1.0, 1.0}) {
    a.groups[0].axes[0].velocity = between(0.2 * side - 0.1, 0.2 * side + 0.1);
    b.groups[0].axes[0].velocity = between(-0.2 * side - 0.1, -0.2 * side + 0.1);
    Standing bench(switching(a, b, 0.1));
    for (const double p : {0.01, 0.5, 1.0}) {
      const Constraints& c = bench.run_to(1.0 + 0.1 * p - period);
      ASSERT_EQ(c.size(), 1u);
      EXPECT_NEAR(c[0].velocity->low, -0.2 * side - 0.1, 1e-12) << p;
      EXPECT_NEAR(c[0].velocity->high, -0.2 * side + 0.1, 1e-12) << p;
    }
  }
}

TEST(Blend, ASwitchInTheMiddleOfABlendTakesOverWhatIsThere) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  lang::Task b = task("b", {drive("go.x", Axis::x, Quantity::force, 20)});
  lang::Task c = task("c", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}, bumper);
  a.exits = {exit(after(1.0), to_task(1))};
  b.exits = {exit(after(0.04), to_task(2))};
  b.blend.constant = c.blend.constant = 0.1;
  Standing bench(program({a, b, c}));
  std::map<std::pair<int, int>, double> last;  // (body pose key, kind) -> alpha
  double largest_step = 0.0;
  for (int i = 0; i < 1300; ++i) {
    std::map<std::pair<int, int>, double> now;
    double sum = 0.0;
    for (const auto& x : bench.tick()) {
      now[{x.move.pose.position.x() > 0.1 ? 1 : 0, static_cast<int>(x.driver->quantity)}] += x.alpha;
      sum += x.alpha;
    }
    EXPECT_NEAR(sum, 1.0, 1e-7) << i;
    if (i > 0) {
      for (const auto& [key, alpha] : now) largest_step = std::max(largest_step, std::abs(alpha - last[key]));
      for (const auto& [key, alpha] : last) largest_step = std::max(largest_step, std::abs(alpha - now[key]));
    }
    last = now;
  }
  EXPECT_NEAR(largest_step, period / 0.1, 1e-7);
}

// What a row asks for goes on from where it was when the switch came, half way from the first driver to the
// second.
TEST(Blend, APersistingRowThatIsOnItsWayGoesOnFromWhereItIs) {
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
    solver::ConstraintSet& set = bench.scheduler.constraints();
    ASSERT_TRUE(set.fill(bench.program.robot.model, bench.sensed.state));
    ASSERT_EQ(set.rows().size(), 1u);
    const double then = targets[0] + (targets[1] - targets[0]) * 0.5;
    const double asked = i <= 50 ? targets[0] + (targets[1] - targets[0]) * i * period / blend
                                 : then + (targets[2] - then) * std::min(1.0, (i - 50) * period / blend);
    EXPECT_NEAR(set.rows()[0].b, asked / time_constant, 1e-6) << i;
  }
}

// Half way between two quantities, or two time constants, no single driver asks for what is asked for: it
// fades.
TEST(Blend, ARowBetweenTwoKindsOfDriverFadesWhenItIsSwitchedAgain) {
  const lang::Task first =
      task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}, base_link, world_frame);
  lang::Task slower = first, elsewhere = first;
  slower.name = "slower";
  slower.groups[0].axes[0].time_constant.constant *= 2.0;
  elsewhere.name = "elsewhere";
  elsewhere.groups[0].axes[0].driver = Quantity::position;
  for (const lang::Task& second : {first, slower, elsewhere}) {
    lang::Task a = first, b = second, c = first;
    a.exits = {exit(after(1.0), to_task(1))};
    b.exits = {exit(after(0.05), to_task(2))};
    b.blend.constant = c.blend.constant = 0.1;
    Standing bench(program({a, b, c}));
    EXPECT_EQ(bench.run_to(1.049).size(), 1u);
    const Constraints& both = bench.run_to(1.059);
    ASSERT_EQ(both.size(), second.name == "a" ? 1u : 2u) << second.name;
    double sum = 0.0;
    for (const auto& constraint : both) sum += constraint.alpha;
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

TEST(Blend, RangesThatBothTasksHaveStayInForceWhileTheDriversChangeOver) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  lang::Task b = task("b", {drive("go.x", Axis::x, Quantity::force, 10.0)});
  a.groups[0].axes[0].velocity = b.groups[0].axes[0].velocity = between(-0.3, 0.3);
  for (const auto& [from, to] : {std::pair(a, b), {b, a}}) {
    Standing bench(switching(from, to, 0.1));
    bench.run_to(0.999);
    for (int i = 1; i < 100; ++i) {
      int ranges = 0;
      for (const auto& c : bench.tick()) {
        if (!c.velocity) continue;
        ++ranges;
        EXPECT_EQ(c.alpha, 1.0) << i;
        EXPECT_FALSE(c.leaving);
        EXPECT_EQ(c.blend, 0.0) << "it is not new";
        EXPECT_EQ(c.velocity->high, 0.3);
      }
      EXPECT_EQ(ranges, 1) << i;
    }
  }
}

// An axis, a distance and two directions of one pair of frames.
TEST(Blend, OtherMeasuresOfTheSameFramesDoNotPersist) {
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
      EXPECT_EQ(bench.run_to(1.02).size(), from.name == to.name ? 1u : 2u) << from.name << ", " << to.name;
    }
  }
}

TEST(Blend, GoingBackInTheMiddleOfABlendPicksUpWhatIsStillLeaving) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  lang::Task b = task("b", {drive("go.y", Axis::y, Quantity::velocity, 0.1)});
  a.blend.constant = b.blend.constant = 0.1;
  a.exits = {exit(after(1.0), to_task(1))};
  b.exits = {exit(after(0.05), to_task(0))};
  Standing bench(program({a, b}));
  double last = 1.0;
  bench.run_to(0.999);
  for (int i = 0; i < 200; ++i) {
    double alpha = 0.0;
    int rows = 0;
    for (const auto& x : bench.tick()) {
      if (x.axis != Axis::x) continue;
      alpha += x.alpha;
      ++rows;
    }
    EXPECT_EQ(rows, 1) << "what was leaving comes back as the row that it was";
    EXPECT_LE(std::abs(alpha - last), period / 0.1 + 1e-7);
    last = alpha;
  }
  EXPECT_EQ(last, 1.0);
}

TEST(Blend, ASwitchOnEveryTickStaysWithinTheCapacity) {
  // Six tasks that all differ in frames: nothing persists, everything leaves.
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
    ASSERT_TRUE(bench.scheduler.constraints().fill(bench.program.robot.model, bench.sensed.state)) << i;
    ASSERT_EQ(bench.scheduler.in_force().size(), bench.scheduler.constraints().constraints().size());
  }
}

/// Runs two tasks on the moving test base and returns the largest step of the commanded planar force in one
/// tick from the switch on, and the largest change of force that the switch brings about in all.
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

  // In the world's axes the rows are others: two soft rows D1 and D2 [N] on one direction, with alphas 1 - p
  // and p,
  //   nu1/(1 - p) + nu2 = D1,  nu1 + nu2/p = D2   =>   nu1 + nu2 = ((1 - p)^2 D1 + p^2 D2)/(1 - p + p^2),
  // where each resists the other. D1 - D2 stays as large as the hard step, and the largest slope of
  // p^2/(1 - p + p^2) is 1.4664: both rows fade, so both count.
  double slope = 0.0;
  const auto weight = [](double p) { return p * p / (1 - p + p * p); };
  for (double p = 0.0; p < 1.0; p += 1e-3) slope = std::max(slope, (weight(p + 1e-3) - weight(p)) / 1e-3);
  const Steps fading =
      commanded_steps(task("a", rest(fast)), task("b", rest(slow), base_link, world_frame), blend);
  EXPECT_GT(fading.whole, 0.2 * hard_step);
  EXPECT_LE(fading.largest, slope * share);
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

}  // namespace
}  // namespace zwang::runtime
