// How far `--observe` says that a base went.
#include "base_way.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace zwang::connect {
namespace {

BaseSample at(double x, double y, double yaw) {
  BaseSample sample;
  sample.pose.position = {x, y, 0.0};
  sample.pose.rotation = Eigen::AngleAxisd(yaw, solver::Vector3::UnitZ());
  return sample;
}

TEST(BaseWay, CountsFromTheFirstOdometry) {
  BaseWay way;
  way.look(nullptr);  // joints have come, and no odometry yet
  EXPECT_FALSE(way.way());
  const BaseSample first = at(30.0, -4.0, 0.0), last = at(30.1, -3.8, 0.0);
  way.look(&first);
  EXPECT_EQ(*way.way(), solver::Vector3::Zero());
  way.look(&last);
  EXPECT_NEAR(way.way()->x(), 0.1, 1e-12);
  EXPECT_NEAR(way.way()->y(), 0.2, 1e-12);
}

// A quarter turn to the left: the world's y is ahead, and its -x to the left.
TEST(BaseWay, IsInTheAxesThatTheBaseHadFirst) {
  BaseWay way;
  const BaseSample first = at(1.0, 2.0, 1.57079632679489662), last = at(0.7, 2.5, 0.0);
  way.look(&first);
  way.look(&last);
  EXPECT_NEAR(way.way()->x(), 0.5, 1e-12);
  EXPECT_NEAR(way.way()->y(), 0.3, 1e-12);
}

}  // namespace
}  // namespace zwang::connect
