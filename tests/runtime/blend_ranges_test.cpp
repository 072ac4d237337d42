// What a switch of tasks does to ranges: which sets have them, and how fast one that enters acts.
#include "blend_bench.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

// The shares of the two sets make of it what a bound is that tightens at once and loosens with the blend.
TEST(Blend, ABoundThatTightensDoesSoInBothSetsAtOnce) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)}), b = a;
  b.name = "b";
  a.groups[0].axes[0].velocity = between(-0.2, 0.3);
  b.groups[0].axes[0].velocity = between(-0.4, 0.2);
  a.groups[0].axes[0].force = between(-50, 20);
  b.groups[0].axes[0].force = between(-10, 60);
  Standing bench(switching_tasks(a, b, 0.1));
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
  Standing bench(switching_tasks(a, b, 0.1));
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

/// The limits of both sides of all sets, by set.
std::vector<std::vector<solver::Row>> limits_of(Standing& bench) {
  std::vector<std::vector<solver::Row>> limits;
  for (int set = 0; set < bench.scheduler.set_count(); ++set) {
    solver::ConstraintSet& constraints = bench.scheduler.constraints(set);
    EXPECT_TRUE(constraints.fill(bench.program.robot.model, bench.sensed.state));
    limits.emplace_back();
    for (const solver::Row& row : constraints.rows()) {
      if (solver::is_limit(row.kind)) limits.back().push_back(row);
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
  Standing bench(switching_tasks(task("a", {push}), task("b", {limited}), blend));
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
    Standing bench(switching_tasks(a, b, 0.1));
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

TEST(Blend, RangesThatBothTasksHaveAreInBothSets) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.1)});
  lang::Task b = task("b", {drive("go.x", Axis::x, Quantity::force, 10.0)});
  a.groups[0].axes[0].velocity = b.groups[0].axes[0].velocity = between(-0.3, 0.3);
  for (const auto& [from, to] : {std::pair(a, b), {b, a}}) {
    Standing bench(switching_tasks(from, to, 0.1));
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

}  // namespace
}  // namespace zwang::runtime
