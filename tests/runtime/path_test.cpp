// Paths: the place of a frame along a path, and runs of a base along lines and fillets. The base waits at its
// force range. Its dynamics were derived apart from the library.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planar_course.hpp"
#include "schedule/path_follower.hpp"
#include "scheduler_bench.hpp"

namespace zwang::runtime {
namespace {

using namespace test;
using solver::Vector3;
using Points = std::vector<std::array<double, 2>>;

constexpr double pi = std::numbers::pi;
constexpr double radius = 0.6;  // [m]
constexpr double pace = 0.3;    // [m/s]
constexpr int way = 3;          // frame
const Points corner{{0, 0}, {2, 0}, {2, 1.5}};
const Points loop{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, -2}};  // crosses itself in (2, 0)

lang::Path path_of(const Points& points, double fillet) {
  lang::Path path;
  path.name = "way";
  path.frame = way;
  path.pieces = lang::path_through(points, fillet).value();
  return path;
}

AxisStatements held(AxisStatements axis, double most_force) {
  axis.force = between(-most_force, most_force);
  return axis;
}

lang::Task drive_along(double speed, double push) {
  lang::Task t = task(
      "drive",
      {held(drive("go.x", Axis::x, Quantity::velocity, speed), push),
       drive("go.y", Axis::y, Quantity::position, 0.0), drive("go.rz", Axis::rz, Quantity::position, 0.0)},
      base_link, way);
  t.groups[0].path = 0;
  return t;
}

/// Points from the origin along x: the path's frame is the world.
lang::Program on_path(std::vector<lang::Task> tasks, const Points& points, double fillet) {
  lang::Program p = program(std::move(tasks));
  lang::FrameDeclaration frame;
  frame.name = "way";
  p.frames.push_back(frame);
  p.paths = {path_of(points, fillet)};
  return p;
}

/// [m] from the corner's path, by hand: two lines, and the circle around (1.4, 0.6) between them.
double off_corner(const Eigen::Vector3d& pose) {
  const double x = pose.x() - (2.0 - radius), y = pose.y() - radius;
  if (x <= 0.0) return pose.y();
  if (y >= 0.0) return 2.0 - pose.x();
  return radius - std::hypot(x, y);
}

TEST(Follow, GoesThroughThePiecesAndBack) {
  const lang::Path path = path_of(corner, radius);
  PathFollower follower(path, 0, base_link);
  follower.search({0.3, 0.2, 0.0});
  EXPECT_EQ(follower.piece().start, 0.0);
  follower.follow({1.9, 0.2, 0.0});
  EXPECT_NEAR(follower.piece().curvature, 1.0 / radius, 1e-12);
  follower.follow({2.1, 1.2, 0.0});
  EXPECT_NEAR(follower.piece().start, 2.0 - radius + radius * pi / 2.0, 1e-12);
  follower.follow({0.3, -0.1, 0.0});
  EXPECT_EQ(follower.piece().start, 0.0);
}

TEST(Follow, StaysOnItsBranchWhereThePathCrossesItself) {
  const lang::Path path = path_of(loop, 0.5);
  PathFollower follower(path, 0, base_link);
  follower.search({0.0, 0.0, 0.0});
  for (int i = 0; i <= 400; ++i) {  // over the crossing, along the first branch
    follower.follow({0.01 * i, 0.02, 0.0});
    if (i < 350) {
      EXPECT_EQ(follower.piece().start, 0.0) << i;
    }
  }
  for (const Vector3& p : {Vector3(4, 1, 0), Vector3(3, 2, 0), Vector3(2, 1, 0)}) follower.follow(p);
  for (int i = 0; i <= 250; ++i) {  // and over it along the last one
    follower.follow({2.02, 1.0 - 0.01 * i, 0.0});
    EXPECT_EQ(&follower.piece(), &path.pieces.back()) << i;
  }
  follower.search({2.3, 0.01, 0.0});
  EXPECT_EQ(follower.piece().start, 0.0) << "a search takes the nearest of all";
}

// Three rounds of a square, the way on and the way back: the arc length counts each of them.
TEST(Follow, CountsTheRoundsOfAClosedPath) {
  const Points square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  lang::Path path;
  path.frame = way;
  path.is_closed = true;
  path.pieces = lang::path_through(square, 0.5, true).value();
  const double round = 4.0 * (2.0 - 2.0 * 0.5) + 2.0 * pi * 0.5;
  PathFollower follower(path, 0, base_link);
  const auto at = [&](double angle) {
    const Vector3 p(1.0 + 0.9 * std::sin(angle), 1.0 - 0.9 * std::cos(angle), 0.0);
    return p;  // from the middle of the first line, to the left around the square's middle
  };
  const auto along = [&](double angle) {
    const lang::PlaceOnPiece place = lang::place_on(follower.piece(), at(angle).x(), at(angle).y());
    return follower.arc_length() + place.along;
  };
  follower.search(at(0.0));
  EXPECT_NEAR(along(0.0), 0.5, 1e-12);
  for (int i = 0; i <= 3000; ++i) follower.follow(at(2.0 * pi * i / 1000.0));
  EXPECT_NEAR(along(6.0 * pi), 0.5 + 3.0 * round, 1e-9);
  for (int i = 3000; i >= -1000; --i) follower.follow(at(2.0 * pi * i / 1000.0));
  EXPECT_NEAR(along(-2.0 * pi), 0.5 - round, 1e-9);
  follower.search(at(0.0));
  EXPECT_NEAR(along(0.0), 0.5, 1e-12) << "a search begins a new count";
  // From a corner on, x is within half a round of the begin: 0.5 + round (angle/2 pi) at the four middles.
  for (int side = 0; side < 4; ++side) {
    follower.search(at(0.5 * pi * side));
    const double ahead = 0.5 + 0.25 * side * round;
    EXPECT_NEAR(along(0.5 * pi * side), ahead > 0.5 * round ? ahead - round : ahead, 1e-9);
  }
}

TEST(Follow, DoesNotKnowNearTheCentreOfAFillet) {
  const lang::Path path = path_of(corner, radius);
  PathFollower follower(path, 0, base_link);
  for (const double share : {0.05, 0.15}) {
    // On the bisector, so near to the centre (1.4, 0.6).
    const double beside = share * radius / std::numbers::sqrt2;
    follower.search({1.4 + beside, 0.6 - beside, 0.0});
    EXPECT_EQ(follower.is_known(), share > PathFollower::least_share);
  }
}

TEST(AlongAPath, TheSpeedIsConstantAndTheLateralErrorSmall) {
  Course course(on_path({drive_along(pace, 200.0)}, corner, radius));
  double widest = 0.0, slowest = 1.0, fastest = 0.0, most = 0.0, askew = 0.0;
  const double before_arc = 2.0 - radius;
  Eigen::Vector2d last = Eigen::Vector2d::Zero();
  course.run(14.0, [&] {
    const Eigen::Vector3d& at = course.base.pose;
    const Eigen::Vector2d v = Eigen::Rotation2Dd(at.z()) * course.base.V.head<2>();
    widest = std::max(widest, std::abs(off_corner(at)));
    // T = 0.5 s: after 3.5 s its speed is 0.3 (1 - e^-7).
    if (course.base.time > 3.5) {
      slowest = std::min(slowest, course.speed());
      fastest = std::max(fastest, course.speed());
      most = std::max(most, (v - last).norm() / period);
    }
    last = v;
    askew = std::max(askew, std::abs(at.z() - std::clamp(std::atan2(at.x() - before_arc, radius - at.y()),
                                                         0.0, pi / 2.0)));
  });
  EXPECT_LT(widest, 1e-3);
  EXPECT_NEAR(slowest, pace, 2e-3);
  EXPECT_NEAR(fastest, pace, 2e-3);
  EXPECT_NEAR(most, pace * pace / radius, 0.05 * pace * pace / radius);
  // The tangent begins to turn with v/r: a critically damped heading is late by v T/(r e) at most.
  EXPECT_LT(askew, 1.05 * pace * 0.5 / (radius * std::numbers::e));
  EXPECT_GT(course.base.pose.y(), 1.5) << "beyond its end the path goes straight on";
  EXPECT_NEAR(course.base.pose.z(), pi / 2.0, 1e-3);
}

/// A wall across the first line that stands until `gone` [s].
constexpr double wall_at = 0.8, stiffness = 5e3, damping = 800.0;
Eigen::Vector3d wall_force(const PlanarBase& base, double gone) {
  const double depth = base.pose.x() - wall_at;
  if (depth < 0.0 || base.time > gone) return Eigen::Vector3d::Zero();
  const Eigen::Rotation2Dd turn(base.pose.z());
  const double press = stiffness * depth + damping * (turn * base.V.head<2>()).x();
  const Eigen::Vector2d force = turn.inverse() * Eigen::Vector2d(-std::max(0.0, press), 0.0);
  return {force.x(), force.y(), 0.0};
}

TEST(AlongAPath, ProgressWaitsAtTheForceRangeAndCatchesNothingUp) {
  constexpr double push = 10.0, gone = 8.0;
  lang::Program p = on_path({drive_along(pace, push)}, corner, radius);
  const double end = p.paths[0].length();
  p.tasks[0].exits = {
      exit(when(apply(Op::greater, coordinate(0, 0, CoordinateQuantity::position), number(end))), to_done)};
  Course course(p);
  double fastest = 0.0;
  while (course.base.time < 30.0 && course.runner.scheduler().outcome() == Outcome::none) {
    course.tick(wall_force(course.base, gone));
    fastest = std::max(fastest, course.speed());
    if (std::abs(course.base.time - gone + 0.5) < 0.5 * period) {
      EXPECT_NEAR(course.base.pose.x(), wall_at + push / stiffness, 2e-4) << "it presses with its range";
      EXPECT_LT(course.speed(), 1e-3);
    }
  }
  EXPECT_EQ(course.runner.scheduler().outcome(), Outcome::done);
  EXPECT_LT(fastest, pace + 1e-3);
  EXPECT_NEAR(course.base.pose.y(), 1.5, 5e-3);
  // The rest of the path takes its whole time from the wall on, and more to speed up from rest.
  EXPECT_GT(course.base.time, gone + (end - wall_at) / pace);
}

/// Where the base is along the path, by the scheduler's own coordinate.
double along_path(Bench& bench) {
  return bench.scheduler.constraints().coordinates()[0].position;
}

void put(Bench& bench, double x, double y) {
  bench.sensed.state.base_pose.position = {x, y, 0.0};
}

TEST(AlongAPath, AnEntryTakesTheNearestPointOfAllAndATaskThatGoesOnItsOwn) {
  lang::Task slow = drive_along(0.1, 200.0), other = drive_along(pace, 200.0);
  slow.exits = {exit(after(0.005), to_task(1))};
  lang::Program p = on_path({slow, other}, loop, 0.5);
  const double crossing = p.paths[0].length() - 2.0;  // on the last branch
  Bench bench(p);
  put(bench, 2.01, 1.0);
  bench.ticks_more(2);
  EXPECT_NEAR(along_path(bench), crossing - 1.0, 1e-9);
  put(bench, 2.01, 0.001);  // nearer to the first branch
  ASSERT_GT(bench.ticks_to_switch(20), 0);
  EXPECT_NEAR(along_path(bench), crossing - 0.001, 1e-9) << "the task before has led it here";
  Bench fresh(p);
  put(fresh, 2.01, 0.001);
  fresh.ticks_more(1);
  EXPECT_NEAR(along_path(fresh), 2.01, 1e-9);
}

TEST(AlongAPath, AnInterruptionForgetsNothing) {
  lang::Task wait = task("wait", {drive("wait.x", Axis::x, Quantity::velocity, 0.0)});
  wait.exits = {exit(after(0.005), back)};
  lang::Program p = on_path({drive_along(pace, 200.0), wait}, loop, 0.5);
  p.always.exits = {exit(when(apply(Op::greater, name(Op::signal, 0), number(0.5))), to_task(1))};
  p.signals = {signal("stop", lang::SignalType::number, 1.0)};
  const double crossing = p.paths[0].length() - 2.0;
  Bench bench(p);
  bench.hear(0, 0.0);
  put(bench, 2.01, 1.0);
  bench.ticks_more(2);
  bench.hear(0, 1.0);
  ASSERT_GT(bench.ticks_to_switch(5), 0);
  ASSERT_EQ(bench.scheduler.task(), 1);
  bench.hear(0, 0.0);
  put(bench, 2.01, 0.001);
  ASSERT_GT(bench.ticks_to_switch(20), 0);
  ASSERT_EQ(bench.scheduler.task(), 0);
  EXPECT_NEAR(along_path(bench), crossing - 0.001, 1e-9);
}

TEST(AlongAPath, NearACentreTheDriversStandStillAndConditionsAreUnknown) {
  lang::Program p = on_path({drive_along(pace, 200.0)}, corner, radius);
  const Nodes along = coordinate(0, 0, CoordinateQuantity::position);
  p.tasks[0].exits = {exit(when(apply(Op::greater, along, number(-10.0))), to_done, 0.01)};
  Bench bench(p);
  put(bench, 1.43, 0.57);
  EXPECT_EQ(bench.ticks_to_switch(1), 1) << "the start";
  bench.ticks_more(50);
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::none);
  EXPECT_EQ(bench.constraint(0).driver->target, 0.0);
  EXPECT_EQ(bench.constraint(1).driver->quantity, Quantity::velocity);
  put(bench, 1.4, 0.2);
  bench.ticks_more(5);
  EXPECT_EQ(bench.constraint(0).driver->target, pace);
  bench.ticks_more(20);
  EXPECT_EQ(bench.scheduler.outcome(), Outcome::done);
}

TEST(AlongAPath, IsCarriedByItsFrame) {
  lang::Program p = on_path({drive_along(pace, 200.0)}, corner, radius);
  p.frames[way].pose = {solver::rotation_from_rpy(0.0, 0.0, 0.7), {1.0, 2.0, 0.0}};
  Bench bench(p);
  bench.sensed.state.base_pose =
      p.frames[way].pose * solver::Pose{solver::Matrix3::Identity(), {0.5, 0.1, 0.0}};
  bench.ticks_more(2);
  const auto& now = bench.scheduler.constraints().coordinates();
  EXPECT_NEAR(now[0].position, 0.5, 1e-9);
  EXPECT_NEAR(now[1].position, 0.1, 1e-9);
  EXPECT_NEAR(now[2].position, 0.0, 1e-9);
}

}  // namespace
}  // namespace zwang::runtime
