// Each test is a sentence of the task language's section "Formal meaning". The judges are the motion and the
// wheel torques of a base whose dynamics were derived apart from the library.
#include <gtest/gtest.h>

#include <functional>

#include "planar_course.hpp"
#include "scheduler_bench.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

double mass() {
  return PlanarBase().inertia()(0, 0);
}

/// Wants to go at (vx, vy) in the world, turning at wz, whatever is in the way; keeps to 0.4 m/s^2.
lang::Program push_on(double vx, double vy, double wz) {
  lang::Task go =
      task("go",
           {drive("go.x", Axis::x, Quantity::velocity, vx), drive("go.y", Axis::y, Quantity::velocity, vy),
            drive("go.rz", Axis::rz, Quantity::velocity, wz)},
           base_link, world_frame);
  for (AxisStatements& a : go.groups[0].axes) a.time_constant.constant = 0.2;
  lang::Program p = program({go});
  p.always.groups = {
      at_level_zero(task("", {within("manners.x", Axis::x, Quantity::acceleration, -0.4, 0.4),
                              within("manners.y", Axis::y, Quantity::acceleration, -0.4, 0.4),
                              within("manners.rz", Axis::rz, Quantity::acceleration, -0.8, 0.8)})
                        .groups[0])};
  p.always.groups[0].name = "manners";
  return p;
}

std::vector<Eigen::Vector2d> corners_of(const Course& course) {
  std::vector<Eigen::Vector2d> corners;
  const Eigen::Rotation2Dd R(course.base.pose.z());
  for (const solver::Vector3& c : course.program.robot.footprint) {
    corners.emplace_back(course.base.pose.head<2>() + R * Eigen::Vector2d(c.head<2>()));
  }
  return corners;
}

/// Distance of `p` from the segment.
double distance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double along = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - along * (b - a)).norm();
}

TEST(Inside, TheFootprintNeverCrossesTheBoundaryByMoreThanATenthOfAMillimetre) {
  const struct {
    double vx, vy, wz;
  } ways[] = {{0.6, 0.0, 0.0}, {0.3, 0.6, 0.0}, {-0.5, -0.6, 0.0}, {0.5, 0.4, 0.4}, {-0.6, 0.2, -0.6}};
  for (const auto& way : ways) {
    lang::Program p = push_on(way.vx, way.vy, way.wz);
    lang::Region corridor;
    corridor.name = "corridor";
    corridor.polygon = {{-2, -1.2}, {3, -1.2}, {3, 1.2}, {-2, 1.2}};
    p.regions = {corridor};
    p.always.groups.push_back(inside(0, 0.1));
    Course course(p);
    double least = 10.0, fastest = 0.0;
    course.run(12.0, [&] {
      fastest = std::max(fastest, course.speed());
      for (const Eigen::Vector2d& c : corners_of(course)) {
        least = std::min({least, c.x() + 2 - 0.1, 3 - 0.1 - c.x(), c.y() + 1.2 - 0.1, 1.2 - 0.1 - c.y()});
      }
    });
    EXPECT_GT(least, -1e-4) << way.vx << " " << way.vy << " " << way.wz;
    EXPECT_GT(fastest, 0.4);
    EXPECT_LT(least, way.wz == 0.0 ? 1e-3 : 0.1) << "and it comes there";
    EXPECT_EQ(course.runner.state(), RunState::running);
  }
}

/// An L: the quadrant x > 1, y > 0.8 is outside. The vertex (1, 0.8) is one to go around.
lang::Region bend() {
  lang::Region region;
  region.name = "bend";
  region.polygon = {{-2, -2}, {4, -2}, {4, 0.8}, {1, 0.8}, {1, 4}, {-2, 4}};
  return region;
}

TEST(Inside, AReflexVertexIsKeptFromTheSidesAndCornersOfTheFootprint) {
  const struct {
    double vx, vy, wz, yaw;
  } ways[] = {{0.6, 0.5, 0.0, 0.0}, {0.5, 0.5, 0.0, 0.7}, {0.5, 0.4, 0.2, 0.2}, {0.4, 0.6, -0.4, -0.4}};
  for (const auto& way : ways) {
    lang::Program p = push_on(way.vx, way.vy, way.wz);
    p.regions = {bend()};
    p.always.groups.push_back(inside(0, 0.05));
    Course course(p);
    course.base.pose = {-0.5, -0.6, way.yaw};
    double least = 10.0;
    const Eigen::Vector2d vertex(1.0, 0.8);
    course.run(8.0, [&] {
      const auto c = corners_of(course);
      for (std::size_t i = 0; i < c.size(); ++i) {
        least = std::min(least, distance(vertex, c[i], c[(i + 1) % c.size()]));
        least = std::min(least, distance(c[i], {1, 0.8}, {1, 4}));
        least = std::min(least, distance(c[i], {1, 0.8}, {4, 0.8}));
      }
    });
    EXPECT_GT(least, 0.05 - 1e-4) << way.vx << " " << way.vy << " " << way.wz;
    EXPECT_LT(least, 0.06) << "it was pressed there";
  }
}

TEST(Inside, ACircleHoldsTheCornersWithinItsRadius) {
  lang::Program p = push_on(0.5, 0.3, 0.3);
  lang::Region ring;
  ring.name = "ring";
  ring.centre = {0.2, 0.1};
  ring.radius = 2.0;
  p.regions = {ring};
  p.always.groups.push_back(inside(0, 0.1));
  Course course(p);
  double farthest = 0.0;
  course.run(10.0, [&] {
    for (const Eigen::Vector2d& c : corners_of(course)) {
      farthest = std::max(farthest, (c - Eigen::Vector2d(0.2, 0.1)).norm());
    }
  });
  EXPECT_LT(farthest, 1.9 + 1e-4);
  EXPECT_GT(farthest, 1.89);
}

TEST(Inside, OnlyNearPairsOfFeaturesAreInForce) {
  lang::Program p = push_on(0.6, 0.0, 0.0);
  lang::Region hall;
  hall.name = "hall";
  hall.polygon = {{-50, -50}, {50, -50}, {50, 50}, {-50, 50}};
  p.regions = {hall};
  p.always.groups.push_back(inside(0, 0.1));
  Bench bench(p);
  const auto pairs = [&] {
    int count = 0;
    for (const InForce& f : bench.scheduler.in_force()) count += f.origin.part >= 0 ? 1 : 0;
    return count;
  };
  bench.ticks_more(300);
  EXPECT_EQ(pairs(), 0);
  bench.sensed.state.base_pose.position.x() = 49.4;  // its front corners 0.1 m before the margin
  bench.tick();
  EXPECT_EQ(pairs(), 2);
}

TEST(Speed, TheNormOfThePlanarVelocityIsLimitedAndNotEachAxis) {
  lang::Program p = push_on(0.6, 0.6, 0.3);
  AxisStatements speed = within("manners.speed", Axis::x, Quantity::velocity, 0.0, 0.5);
  speed.is_planar = true;
  p.always.groups[0].axes.push_back(speed);
  p.always.groups[0] = at_level_zero(p.always.groups[0]);
  Course course(p);
  double fastest = 0.0;
  course.run(6.0, [&] { fastest = std::max(fastest, course.speed()); });
  EXPECT_LT(fastest, 0.5 * 1.001);
  EXPECT_GT(course.speed(), 0.5 * 0.999);
  // Held back by that row alone, and named.
  const auto shortfall = course.runner.shortfall();
  ASSERT_TRUE(shortfall.has_value());
  EXPECT_TRUE(shortfall->row == "go.go.x" || shortfall->row == "go.go.y") << shortfall->row;
  ASSERT_FALSE(shortfall->held_back_by.empty());
  EXPECT_EQ(shortfall->held_back_by[0], "always.manners.speed");
}

TEST(Speed, HasNoRowBelowHalfOfTheLimit) {
  AxisStatements speed = within("go.speed", Axis::x, Quantity::velocity, 0.0, 0.5);
  speed.is_planar = true;
  Bench bench(program({task("a", {speed})}));
  for (const double v : {0.0, 0.1, 0.249}) {
    bench.sensed.state.base_twist.linear = {v * 0.6, v * 0.8, 0.0};
    bench.tick();
    EXPECT_EQ(bench.scheduler.constraints().rows().size(), 0u) << v;
  }
  bench.sensed.state.base_twist.linear = {0.3 * 0.6, 0.3 * 0.8, 0.0};
  bench.tick();
  ASSERT_EQ(bench.scheduler.constraints().rows().size(), 1u);
  const solver::Row& row = bench.scheduler.constraints().rows()[0];
  EXPECT_NEAR(row.a.linear.x(), 0.6, 1e-12) << "along the present planar velocity";
  EXPECT_NEAR(row.a.linear.y(), 0.8, 1e-12);
  EXPECT_NEAR(row.b, (0.5 - 0.3) / 0.010, 1e-9);
}

TEST(Compliance, StiffnessAndDampingMakeAForceRowWithFClamped) {
  AxisStatements spring = drive("go.x", Axis::x, Quantity::position, 0.0);
  spring.stiffness = lang::Value{.constant = 200.0};
  spring.damping = lang::Value{.constant = 150.0};
  spring.force = between(-25, 30);
  lang::Task a = task("a", {spring}, base_link, world_frame);
  Course course(program({a}));
  course.base.pose = {-0.1, 0.0, 0.0};
  course.tick();
  EXPECT_NEAR(course.commanded().x(), 200.0 * 0.1, 1e-6);
  course.base.V.x() = 0.05;
  const double x = course.base.pose.x();
  course.tick();
  EXPECT_NEAR(course.commanded().x(), 200.0 * -x - 150.0 * 0.05, 1e-6);
  course.base.pose.x() = -1.0;
  course.base.V.setZero();
  course.tick();
  EXPECT_NEAR(course.commanded().x(), 30.0, 1e-6);
  course.base.pose.x() = 1.0;
  course.tick();
  EXPECT_NEAR(course.commanded().x(), -25.0, 1e-6);
}

TEST(Weight, MeetsTheFractionWOverWPlusLambdaOfB) {
  for (const double w : {20.0, 200.0}) {
    AxisStatements soft = drive("go.x", Axis::x, Quantity::acceleration, 0.5);
    soft.weight = lang::Value{.constant = w};
    Course course(program({task("a", {soft})}));
    course.tick();
    EXPECT_NEAR(course.commanded().x(), mass() * 0.5 * w / (w + mass()), 1e-6) << w;
  }
}

TEST(ForceRange, AloneLimitsTheSumOfAllRowsOfItsLevelAndBelow) {
  // 15 N at the base and 15 N at its bumper, along the same line; together 20 N.
  AxisStatements push = drive("go.x", Axis::x, Quantity::force, 15.0);
  lang::Task a = task("a", {push});
  a.groups.push_back(task("", {drive("more.x", Axis::x, Quantity::force, 15.0)}).groups[0]);
  a.groups[1].name = "more";
  a.groups[1].move = bumper;
  lang::Program p = program({a});
  p.always.groups = {
      at_level_zero(task("", {within("soft.x", Axis::x, Quantity::force, -20, 20)}).groups[0])};
  Course limited(p);
  limited.tick();
  EXPECT_NEAR(limited.commanded().x(), 20.0, 1e-6);
  EXPECT_TRUE(limited.runner.scheduler().reading({0, 0, 0, -1}).saturated);
  p.always.groups.clear();
  Course free(p);
  free.tick();
  EXPECT_NEAR(free.commanded().x(), 30.0, 1e-6);
}

TEST(Feature, ADistanceDrives) {
  lang::Program p = program({task("a", {drive("reach", Axis::x, Quantity::position, 1.5)})});
  lang::FrameDeclaration post;
  post.name = "post";
  post.pose.position = {2.0, 1.0, 0.0};
  p.frames.push_back(post);
  lang::Feature reach;
  reach.name = "reach";
  reach.first = 3;  // the world's end first: it is the base that moves
  reach.second = bumper;
  p.features = {reach};
  p.tasks[0].groups[0].kind = lang::GroupKind::feature;
  p.tasks[0].groups[0].feature = 0;
  p.tasks[0].groups[0].move = p.tasks[0].groups[0].in = 0;
  Course course(p);
  course.run(8.0);
  const Eigen::Vector2d nose =
      course.base.pose.head<2>() + Eigen::Rotation2Dd(course.base.pose.z()) * Eigen::Vector2d(0.4, 0.0);
  EXPECT_NEAR((nose - Eigen::Vector2d(2.0, 1.0)).norm(), 1.5, 1e-4);
}

TEST(Feature, AnAngleDrives) {
  lang::Program p = program({task("a", {drive("bearing", Axis::rz, Quantity::position, 0.4)})});
  lang::Feature bearing;
  bearing.name = "bearing";
  bearing.kind = lang::FeatureKind::angle;
  bearing.first = base_link;
  bearing.second = world_frame;
  bearing.first_axis = Axis::x;
  bearing.second_axis = Axis::y;
  bearing.turns = true;
  p.features = {bearing};
  p.tasks[0].groups[0].kind = lang::GroupKind::feature;
  p.tasks[0].groups[0].feature = 0;
  Course course(p);
  course.run(8.0);
  EXPECT_NEAR(std::numbers::pi / 2 - course.base.pose.z(), 0.4, 1e-4) << "between its x and the world's y";
}

TEST(Feature, ADirectionIsTheSumOfAxesAsWritten) {
  lang::Program p = program({task("a", {drive("slant", Axis::x, Quantity::position, 0.7)})});
  lang::Feature slant;
  slant.name = "slant";
  slant.kind = lang::FeatureKind::direction;
  slant.first = base_link;
  slant.second = world_frame;
  slant.direction = {0.6, 0.8, 0, 0, 0, 0};
  p.features = {slant};
  p.tasks[0].groups[0].kind = lang::GroupKind::feature;
  p.tasks[0].groups[0].feature = 0;
  Course course(p);
  course.run(8.0);
  EXPECT_NEAR(0.6 * course.base.pose.x() + 0.8 * course.base.pose.y(), 0.7, 1e-4);
}

TEST(Feature, AConditionAsksForItAndItIsUnknownWhileASignalIsLost) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.0)});
  a.exits = {exit(when(apply(Op::less, name(Op::feature, 0), number(0.03))), to_done, 1e6)};
  lang::Program p = program({a});
  p.signals = {signal("partner", lang::SignalType::pose, 0.010)};
  p.signals[0].in = base_link;
  lang::FrameDeclaration socket;
  socket.name = "socket";
  socket.parent = lang::FrameParent::signal;
  socket.parent_index = 0;
  p.frames.push_back(socket);
  lang::Feature reach;
  reach.name = "reach";
  reach.first = bumper;
  reach.second = 3;
  p.features = {reach};
  Bench bench(p);
  bench.ticks_more(3);
  EXPECT_EQ(bench.scheduler.dwell(0), 0.0);
  bench.hear(0, 0.0);
  bench.sensed.signals[0].pose.position = {0.42, 0.0, 0.0};
  bench.ticks_more(11);
  EXPECT_NEAR(bench.scheduler.dwell(0), 0.011, 1e-12);
  bench.tick();
  EXPECT_EQ(bench.scheduler.dwell(0), 0.0);
}

TEST(Contradiction, AccelerationWinsOverVelocityOverPosition) {
  // 1 m/s towards a boundary 0.1 m away, with 0.4 m/s^2 to brake: the boundary cannot be held.
  lang::Program p = push_on(1.0, 0.0, 0.0);
  p.tasks[0].groups[0].axes[0].position = between(-10, 0.1);
  Course course(p);
  course.base.V.x() = 1.0;
  double hardest = 0.0, last = 1.0;
  course.run(1.0, [&] {
    hardest = std::max(hardest, (last - course.base.V.x()) / period);
    last = course.base.V.x();
  });
  EXPECT_NEAR(hardest, 0.4, 1e-6);
}

TEST(Blending, WhatIsLimitedThroughoutIsLimitedInTheMiddleOfASwitchToo) {
  // A boundary of `always` stays at full strength while the tasks beside it fade.
  lang::Program p = push_on(0.6, 0.0, 0.0);
  lang::Task other = p.tasks[0];
  other.groups[0].in = base_link;
  p.tasks[0].exits = {exit(after(1.5), to_task(1))};
  p.tasks.push_back(other);
  p.tasks[1].exits = {exit(after(0.05), to_task(0))};
  for (lang::Task& t : p.tasks) t.blend.constant = 0.2;
  p.tasks[0].exits[0] = exit(after(0.05), to_task(1));
  lang::Region hall;
  hall.name = "hall";
  hall.polygon = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  p.regions = {hall};
  p.always.groups.push_back(inside(0, 0.1));
  Course course(p);
  double least = 10.0;
  course.run(8.0, [&] {
    for (const Eigen::Vector2d& c : corners_of(course)) least = std::min(least, 1.9 - c.x());
  });
  EXPECT_GT(course.runner.transition_count(), 100u);
  EXPECT_GT(least, -1e-4);
  EXPECT_LT(least, 0.05);
}

TEST(LiveParameters, AreTakenOverOnTheNextTickWithinTheirRange) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::force, 0.0)});
  a.groups[0].axes[0].target.parameter = 0;
  lang::Program p = program({a});
  p.parameters.resize(1);
  p.parameters[0].name = "push";
  p.parameters[0].value = 5.0;
  p.parameters[0].range = solver::Range{0.0, 40.0};
  Course course(p);
  course.tick();
  EXPECT_NEAR(course.commanded().x(), 5.0, 1e-9);
  EXPECT_TRUE(course.runner.set_parameter("push", 12.0));
  course.tick();
  EXPECT_NEAR(course.commanded().x(), 12.0, 1e-9);
  EXPECT_FALSE(course.runner.set_parameter("push", 41.0));
  EXPECT_FALSE(course.runner.set_parameter("push", std::nan("")));
  EXPECT_FALSE(course.runner.set_parameter("pull", 1.0));
  course.tick();
  EXPECT_NEAR(course.commanded().x(), 12.0, 1e-9);
}

}  // namespace
}  // namespace zwang::runtime
