// The way back into a position range or a region, if the base stands outside. The speed is min(v_brk(|d|),
// return). The judge is the motion of a base whose dynamics were derived apart from the library.
#include <gtest/gtest.h>

#include "planar_course.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

/// The base stands, as far as the task goes.
lang::Program waiting() {
  return program({task("wait", {drive("wait.x", Axis::x, Quantity::velocity, 0.0),
                                drive("wait.y", Axis::y, Quantity::velocity, 0.0),
                                drive("wait.rz", Axis::rz, Quantity::velocity, 0.0)})});
}

lang::Program kept(std::vector<AxisStatements> ranges, std::optional<double> speed = std::nullopt) {
  lang::Program p = waiting();
  if (speed) {
    for (AxisStatements& a : ranges) a.return_speed.constant = *speed;
  }
  p.always.groups = {at_level_zero(task("", std::move(ranges), base_link, world_frame).groups[0])};
  return p;
}

/// A room from -1 to 1 m in x and y.
lang::Program fenced() {
  lang::Program p = waiting();
  lang::Region room;
  room.name = "room";
  room.polygon = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  p.regions = {room};
  p.always.groups = {inside(0, 0.0)};
  return p;
}

struct Way {
  double fastest = 0.0;  ///< [m/s] of the base's origin
  double turned = 0.0;   ///< [rad/s]
  double hardest = 0.0;  ///< [m/s^2] of its speeding up and slowing down
  Eigen::Vector3d end;   ///< x, y, yaw
};

Way way_back(const lang::Program& p, const Eigen::Vector3d& start, double seconds) {
  Course course(p);
  course.base.pose = start;
  Way way;
  Eigen::Vector3d last = course.base.V;
  course.run(seconds, [&] {
    way.fastest = std::max(way.fastest, course.speed());
    way.turned = std::max(way.turned, std::abs(course.base.V.z()));
    way.hardest = std::max(way.hardest, (course.base.V - last).head<2>().norm() / period);
    last = course.base.V;
  });
  EXPECT_EQ(course.runner.state(), RunState::running);
  way.end = course.base.pose;
  return way;
}

TEST(Return, IsATenthOfAMetreASecondWhereNothingIsSaid) {
  const Way way =
      way_back(kept({within("back.x", Axis::x, Quantity::position, -1.0, 0.0)}), {1, 0, 0.3}, 12.0);
  EXPECT_NEAR(way.fastest, 0.1, 1e-3);
  EXPECT_NEAR(way.end.x(), -0.025, 0.0251) << "inside the task brakes: v T = 0.05 m at most";
  EXPECT_LT(way.hardest, 1.1) << "no more than the stop's deceleration, which nothing narrows";
}

TEST(Return, HasTheSpeedThatTheFileGives) {
  const AxisStatements range = within("back.x", Axis::x, Quantity::position, 0.0, 1.0);
  EXPECT_NEAR(way_back(kept({range}, 0.3), {-1, 0, 0}, 5.0).fastest, 0.3, 1e-3);
  const Way stays = way_back(kept({range}, 0.0), {-1, 0, 0}, 3.0);
  EXPECT_LT(stays.fastest, 1e-9);
  EXPECT_EQ(stays.end.x(), -1.0);
}

TEST(Return, AcceleratesAsTheRangesOfAccelerationAllow) {
  lang::Program p = kept({within("back.x", Axis::x, Quantity::position, -1.0, 0.0)});
  p.robot.limits = {{Axis::x, Quantity::acceleration, {-0.05, 0.05}, {}}};
  const Way way = way_back(p, {1, 0, 0}, 3.0);
  EXPECT_LT(way.hardest, 0.05 + 1e-6);
  EXPECT_NEAR(way.fastest, 0.1, 1e-3);
}

TEST(Return, OfAnAngleTurns) {
  const Way way =
      way_back(kept({within("back.rz", Axis::rz, Quantity::position, -0.1, 0.1)}), {0, 0, 1.0}, 12.0);
  EXPECT_NEAR(way.turned, 0.1, 1e-4);
  EXPECT_NEAR(way.end.z(), 0.075, 0.0251);
}

TEST(Return, OutOfTwoRangesAtOnceIsNoFasterThanOutOfOne) {
  const Way way = way_back(kept({within("back.x", Axis::x, Quantity::position, -1.0, 0.0),
                                 within("back.y", Axis::y, Quantity::position, 0.0, 1.0)}),
                           {1, -1, 0.4}, 20.0);
  EXPECT_NEAR(way.fastest, 0.1, 1e-3);
  EXPECT_NEAR(way.end.x(), -0.025, 0.0255);
  EXPECT_NEAR(way.end.y(), 0.025, 0.0255);
}

TEST(Return, IntoARegionFromASideFromACornerAndAskew) {
  for (const Eigen::Vector3d& start :
       {Eigen::Vector3d(2.0, 0.0, 0.0), Eigen::Vector3d(2.0, 2.0, 0.0), Eigen::Vector3d(-2.0, 0.3, 0.7)}) {
    const Way way = way_back(fenced(), start, 30.0);
    // Askew it meets a second edge on its way, where the drivers that are to stand contradict two ranges:
    // docs/limits.md.
    const bool is_askew = start.z() != 0.0;
    EXPECT_LT(way.fastest, is_askew ? 0.116 : 0.101) << start.transpose();
    EXPECT_GT(way.fastest, 0.05) << start.transpose();
    const Eigen::Rotation2Dd R(way.end.z());
    for (const solver::Vector3& corner : mecanum_robot().footprint) {
      const Eigen::Vector2d place = way.end.head<2>() + R * Eigen::Vector2d(corner.head<2>());
      EXPECT_LT(place.lpNorm<Eigen::Infinity>(), 1.001) << start.transpose();
    }
  }
}

TEST(Return, OfADistance) {
  lang::Program p = waiting();
  lang::FrameDeclaration post;
  post.name = "post";
  post.pose.position = {0.6, 0.8, 0.0};
  p.frames.push_back(post);
  lang::Feature reach;
  reach.name = "reach";
  reach.first = 3;
  reach.second = base_link;
  p.features = {reach};
  lang::Group group =
      at_level_zero(task("", {within("near", Axis::x, Quantity::position, 0.0, 0.5)}).groups[0]);
  group.kind = lang::GroupKind::feature;
  group.feature = 0;
  p.always.groups = {group};
  const Way way = way_back(p, {0, 0, 0.2}, 10.0);
  EXPECT_NEAR(way.fastest, 0.1, 1e-3);
  EXPECT_NEAR((way.end.head<2>() - Eigen::Vector2d(0.6, 0.8)).norm(), 0.475, 0.0251);
}

TEST(Return, IsToldOnceEachTimeThatTheBaseIsOutside) {
  Course course(kept({within("back.x", Axis::x, Quantity::position, -1.0, 0.0)}));
  course.base.pose.x() = 0.2;
  course.run(4.0);
  ASSERT_EQ(course.runner.events().size(), 1u);
  const Event& told = course.runner.events()[0];
  EXPECT_EQ(told.code, EventCode::outside);
  EXPECT_EQ(told.time, 0.0);
  EXPECT_NEAR(told.value, 0.2, 1e-9);
  EXPECT_EQ(course.runner.event_signal(told), "always.back.x");
  course.base.pose.x() = 0.005;
  course.run(1.0);
  EXPECT_EQ(course.runner.events().size(), 1u) << "less than a centimetre";
  course.base.pose.x() = 0.5;  // as after a jump of the localisation
  course.run(1.0);
  EXPECT_EQ(course.runner.events().size(), 2u);
}

}  // namespace
}  // namespace zwang::runtime
