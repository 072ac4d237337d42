// Between two switches the scheduler writes only the new parts of the constraints in force. The result has to
// equal that of a scheduler that begins at that moment and writes everything.
#include <gtest/gtest.h>

#include "scheduler_bench.hpp"

namespace zwang::runtime {
namespace {

using namespace test;
using solver::AxisConstraint;
using solver::Driver;
using solver::Range;

lang::Group at_level_zero(lang::Group group) {
  group.level = 0;
  for (AxisStatements& a : group.axes) a.level = 0;
  return group;
}

/// The program has values from parameters and from a signal. The braking of a position range hangs on the
/// yaw. Edges come into reach and go out of it.
lang::Program course() {
  AxisStatements x = drive("go.x", Axis::x, Quantity::velocity, 0.0);
  x.target.parameter = 0;
  x.position = between(-1.5, 2.5);
  AxisStatements y = free_axis("go.y", Axis::y);
  y.velocity = lang::ValueRange{{.parameter = 0, .sign = -1.0}, {.parameter = 0}};
  AxisStatements rz = drive("go.rz", Axis::rz, Quantity::velocity, 0.0);
  rz.target.signal = 0;
  lang::Task manners = task("", {free_axis("manners.x", Axis::x), free_axis("manners.y", Axis::y)});
  manners.groups[0].axes[0].acceleration = between(-0.4, 0.4);
  manners.groups[0].axes[1].acceleration = between(-0.9, 0.9);
  lang::Group boundary;
  boundary.name = "boundary";
  boundary.kind = lang::GroupKind::inside;
  boundary.region = 0;
  boundary.moves_footprint = true;
  boundary.move = base_link;
  boundary.margin.parameter = 1;

  lang::Program p = program({task("go", {x, y, rz}, base_link, world_frame)});
  p.always.groups = {at_level_zero(manners.groups[0]), at_level_zero(boundary)};
  p.regions.resize(1);
  p.regions[0].polygon = {{-2, -1.2}, {4, -1.2}, {4, 0.8}, {1, 0.8}, {1, 1.2}, {-2, 1.2}};
  p.parameters.resize(2);
  p.parameters[0].name = "pace";
  p.parameters[0].value = 0.3;
  p.parameters[1].name = "gap";
  p.parameters[1].value = 0.1;
  p.signals = {signal("turn", lang::SignalType::number, 1e3)};
  return p;
}

void expect_same(const std::optional<Range>& a, const std::optional<Range>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (!a) return;
  EXPECT_EQ(a->low, b->low);
  EXPECT_EQ(a->high, b->high);
}

void expect_same(const solver::AttachedFrame& a, const solver::AttachedFrame& b) {
  EXPECT_EQ(a.body, b.body);
  EXPECT_EQ(a.pose.rotation, b.pose.rotation);
  EXPECT_EQ(a.pose.position, b.pose.position);
}

void expect_same(const AxisConstraint& a, const AxisConstraint& b) {
  expect_same(a.move, b.move);
  expect_same(a.in, b.in);
  EXPECT_EQ(a.measure, b.measure);
  EXPECT_EQ(a.axis, b.axis);
  EXPECT_EQ(a.level, b.level);
  EXPECT_EQ(a.braking, b.braking);
  EXPECT_EQ(a.position_horizon, b.position_horizon);
  EXPECT_EQ(a.velocity_horizon, b.velocity_horizon);
  expect_same(a.position, b.position);
  expect_same(a.velocity, b.velocity);
  expect_same(a.acceleration, b.acceleration);
  expect_same(a.force, b.force);
  ASSERT_EQ(a.driver.has_value(), b.driver.has_value());
  if (a.driver) {
    EXPECT_EQ(a.driver->target, b.driver->target);
  }
}

TEST(Settled, IsWhatASchedulerPutsThatBeginsNow) {
  Bench bench(course());
  bench.answer.residual = 0.25;
  double pace = 0.3, gap = 0.1;
  std::size_t least = 100, most = 0;
  std::vector<double> brakings;
  for (int i = 0; i < 400; ++i) {
    // Up to the bend and back, while it turns.
    const double t = i / 400.0;
    bench.sensed.state.base_pose.position = {1.6 * std::sin(std::numbers::pi * t), 0.5 * t, 0.0};
    bench.sensed.state.base_pose.rotation = solver::rotation_from_rpy(0, 0, 2.5 * t);
    bench.sensed.state.base_twist.linear = {0.5 - t, 0.2, 0.0};
    bench.hear(0, std::sin(20.0 * t));
    if (i % 90 == 50) {
      ASSERT_TRUE(bench.scheduler.set_parameter(0, pace += 0.01));
    }
    if (i % 90 == 70) {
      ASSERT_TRUE(bench.scheduler.set_parameter(1, gap += 0.001));
    }
    Sensed now = bench.sensed;
    bench.tick();

    Scheduler fresh(bench.program, period);
    ASSERT_TRUE(fresh.set_parameter(0, pace));
    ASSERT_TRUE(fresh.set_parameter(1, gap));
    fresh.tick(now);
    const auto& kept = bench.scheduler.constraints().constraints();
    const auto& anew = fresh.constraints().constraints();
    ASSERT_EQ(kept.size(), anew.size()) << i;
    ASSERT_EQ(bench.scheduler.in_force().size(), kept.size());
    for (std::size_t c = 0; c < kept.size(); ++c) {
      SCOPED_TRACE(testing::Message() << "tick " << i << ", constraint " << c);
      expect_same(kept[c], anew[c]);
      EXPECT_EQ(bench.scheduler.in_force()[c].origin, fresh.in_force()[c].origin);
      EXPECT_EQ(bench.scheduler.in_force()[c].drives, fresh.in_force()[c].drives);
      // The solver's reading of a row came to the axis that made the row.
      const AxisReading reading = bench.scheduler.reading(bench.scheduler.in_force()[c].origin);
      if (kept[c].driver) {
        EXPECT_EQ(reading.residual, 0.25);
      }
      if (kept[c].position && kept[c].driver) brakings.push_back(kept[c].braking);
    }
    least = std::min(least, kept.size());
    most = std::max(most, kept.size());
  }
  EXPECT_GT(most, least) << "edges came into reach and went out of it";
  const auto [low, high] = std::ranges::minmax(brakings);
  EXPECT_NEAR(low, 0.4, 1e-3) << "along the base's x";
  EXPECT_GT(high, 0.8) << "nearly along its y";
}

}  // namespace
}  // namespace zwang::runtime
