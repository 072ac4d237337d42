// Each test is a sentence of the task language's section "Formal meaning": the rows while a switch blends.
#include <gtest/gtest.h>

#include "planar_course.hpp"
#include "scheduler_bench.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

/// Two tasks with one group each; the switch is on the third tick and takes 10 ms.
lang::Program switching(lang::Task a, lang::Task b) {
  a.exits = {exit(after(0.002), to_task(1))};
  b.blend.constant = 0.010;
  return program({a, b});
}

TEST(Blending, OfTwoSpringsIsTheirForcesByTheSharesOfTheSets) {
  const auto spring = [](double target) {
    AxisStatements a = drive("go.x", Axis::x, Quantity::position, target);
    a.stiffness = lang::Value{.constant = 200.0};
    a.damping = lang::Value{.constant = 50.0};
    return task("t", {a}, base_link, world_frame);
  };
  Bench bench(switching(spring(0.1), spring(0.3)));
  bench.ticks_more(2);
  for (int i = 1; i <= 12; ++i) {
    bench.tick();
    double force = 0.0;
    for (int set = 0; set < bench.scheduler.set_count(); ++set) {
      solver::ConstraintSet& constraints = bench.scheduler.constraints(set);
      ASSERT_TRUE(constraints.fill(bench.program.robot.model, bench.sensed.state));
      ASSERT_EQ(constraints.rows().size(), 1u);
      EXPECT_EQ(constraints.rows()[0].kind, solver::RowKind::force);
      force += bench.scheduler.share(set) * constraints.rows()[0].force;
    }
    EXPECT_NEAR(force, 20.0 + 40.0 * std::min(1.0, 0.1 * i), 1e-9);
  }
}

TEST(Blending, ASpringAndAMotionDriverAreNotOfOneKind) {
  AxisStatements spring = drive("go.x", Axis::x, Quantity::position, 0.1);
  spring.stiffness = lang::Value{.constant = 200.0};
  spring.damping = lang::Value{.constant = 50.0};
  AxisStatements stiff = drive("go.x", Axis::x, Quantity::position, 0.1);
  Bench bench(
      switching(task("a", {spring}, base_link, world_frame), task("b", {stiff}, base_link, world_frame)));
  bench.ticks_more(5);
  ASSERT_EQ(bench.scheduler.set_count(), 2);
  EXPECT_EQ(bench.scheduler.in_force()[0].alpha, bench.scheduler.share(0));
}

TEST(Blending, ASumIsOnAtOnceInBothSetsAndLeavesWithItsSet) {
  const lang::Task limited = task("a", {within("go.x", Axis::x, Quantity::force, -20, 20)});
  const lang::Task other = task("b", {drive("go.y", Axis::y, Quantity::velocity, 0.0)});
  const auto has_sum = [](const Bench& bench, int set) {
    return std::ranges::any_of(bench.scheduler.constraints(set).constraints(),
                               [](const auto& c) { return c.force && !c.driver && c.force->high == 20.0; });
  };
  Bench entering(switching(other, limited));
  entering.ticks_more(3);
  ASSERT_EQ(entering.scheduler.set_count(), 2);
  EXPECT_TRUE(has_sum(entering, 0) && has_sum(entering, 1));
  Bench leaving(switching(limited, other));
  leaving.ticks_more(2);
  for (int i = 1; i < 10; ++i) {
    leaving.tick();
    ASSERT_EQ(leaving.scheduler.set_count(), 2);
    EXPECT_FALSE(has_sum(leaving, 0));
    EXPECT_TRUE(has_sum(leaving, 1));
    EXPECT_NEAR(leaving.scheduler.share(1), 1.0 - 0.1 * i, 1e-9);
  }
}

TEST(Blending, AFrameThatWasSetInBetweenIsNotTheSameAxes) {
  for (const bool is_set : {false, true}) {
    lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::position, 0.5)}, base_link, 3);
    lang::Program p = switching(a, a);
    lang::FrameDeclaration touch;
    touch.name = "touch";
    p.frames.push_back(touch);
    if (is_set) p.tasks[0].exits[0].set = {{.index = 3, .source = base_link}};
    Bench bench(p);
    bench.sensed.state.base_pose.position.x() = 0.2;
    bench.ticks_more(5);
    ASSERT_EQ(bench.scheduler.set_count(), 2);
    const double alpha = bench.scheduler.in_force()[0].alpha;
    EXPECT_NEAR(alpha, is_set ? bench.scheduler.share(0) : 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace zwang::runtime
