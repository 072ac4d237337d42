#include "zwang/runtime/odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "robots.hpp"

namespace zwang::runtime {
namespace {

using solver::Matrix3;
using solver::Pose;
using solver::Vector3;

/// Wheel rates of the test base for a planar twist: u'(v + w x P) = R u_x rate.
void roll(solver::State& state, double vx, double vy, double wz) {
  for (int i = 0; i < 4; ++i) {
    const Vector3 p = test::wheel_position(i);
    const double ux = -std::sin(test::roller_angle(i)), uy = std::cos(test::roller_angle(i));
    state.qd(i) = (ux * (vx - wz * p.y()) + uy * (vy + wz * p.x())) / (test::wheel_radius * ux);
  }
}

Pose pose(double x, double y, double yaw) {
  return {Eigen::AngleAxisd(yaw, Vector3::UnitZ()).toRotationMatrix(), {x, y, 0.0}};
}

double yaw_of(const Pose& p) {
  return std::atan2(p.rotation(1, 0), p.rotation(0, 0));
}

struct Base {
  lang::Robot robot = test::mecanum_robot();
  solver::State state{robot.model};
};

TEST(Odometry, ACircleClosesExactly) {
  Base base;
  Odometry odometry(base.robot.model, pose(1.0, 2.0, 0.5));
  roll(base.state, 0.3, 0.1, 0.8);
  const double round = 2.0 * M_PI / 0.8;
  constexpr int steps = 500;
  for (int i = 0; i <= steps; ++i) odometry.update(round * i / steps, base.state);
  EXPECT_NEAR(base.state.base_pose.position.x(), 1.0, 1e-12);
  EXPECT_NEAR(base.state.base_pose.position.y(), 2.0, 1e-12);
  EXPECT_NEAR(yaw_of(base.state.base_pose), 0.5, 1e-12);
  EXPECT_NEAR(base.state.base_twist.linear.x(), 0.3, 1e-12);
  EXPECT_NEAR(odometry.slip(), 0.0, 1e-12);
}

/// A base at 0.4 m/s does not move 4 m because its clock jumps by 10 s.
TEST(Odometry, AClockThatJumpsMovesNothing) {
  for (const double jump : {10.0, -10.0}) {
    Base base;
    Odometry odometry(base.robot.model);
    roll(base.state, 0.4, 0.0, 0.0);
    odometry.update(0.0, base.state);
    odometry.update(jump, base.state);
    EXPECT_LE(std::abs(base.state.base_pose.position.x()), 0.4 * Odometry::longest_step + 1e-12);
  }
}

TEST(Odometry, HalfACircleEndsADiameterAway) {
  Base base;
  Odometry odometry(base.robot.model);
  roll(base.state, 0.4, 0.0, 0.5);  // radius 0.8 m to the left
  for (int i = 0; i <= 1000; ++i) odometry.update(M_PI / 0.5 * i / 1000, base.state);
  EXPECT_NEAR(base.state.base_pose.position.x(), 0.0, 1e-12);
  EXPECT_NEAR(base.state.base_pose.position.y(), 1.6, 1e-12);
}

TEST(Odometry, AConstantAccelerationIsIntegratedExactly) {
  Base base;
  Odometry odometry(base.robot.model);
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.01 * i;
    roll(base.state, 0.5 * t, 0.0, 0.0);
    odometry.update(t, base.state);
  }
  EXPECT_NEAR(base.state.base_pose.position.x(), 0.25, 1e-12);
}

TEST(Odometry, MeasuredPosesTakeOverWithTheTimeConstant) {
  Base base;
  Odometry odometry(base.robot.model, {}, {.time_constant = 0.5});
  double time = 0.0;
  odometry.update(time, base.state);
  // Ten a second for a time constant: what is left of the error is 1/e.
  for (int i = 1; i <= 500; ++i) {
    time = 1e-3 * i;
    if (i % 100 == 0) {
      EXPECT_TRUE(odometry.correct(time - 1e-3, pose(0.2, -0.1, 0.3)));
    }
    odometry.update(time, base.state);
  }
  const double left = std::exp(-(time - 1e-3) / 0.5);
  EXPECT_NEAR(base.state.base_pose.position.x(), 0.2 * (1 - left), 1e-9);
  EXPECT_NEAR(base.state.base_pose.position.y(), -0.1 * (1 - left), 1e-9);
  EXPECT_NEAR(yaw_of(base.state.base_pose), 0.3 * (1 - left), 1e-9);
}

TEST(Odometry, ALateMeasurementIsComparedWithWhereTheBaseWasThen) {
  Base base;
  Odometry odometry(base.robot.model);
  roll(base.state, 0.5, 0.0, 0.0);
  for (int i = 0; i <= 300; ++i) odometry.update(1e-3 * i, base.state);
  // 200 ms late and right: nothing may change.
  EXPECT_TRUE(odometry.correct(0.1, pose(0.05, 0.0, 0.0)));
  EXPECT_NEAR(odometry.pose().position.x(), 0.15, 1e-12);
}

TEST(Odometry, WhatIsTooOldOrNotFiniteIsIgnored) {
  Base base;
  Odometry odometry(base.robot.model, {}, {.memory = 0.1});
  EXPECT_FALSE(odometry.correct(0.0, pose(1, 1, 1))) << "nothing is remembered yet";
  for (int i = 0; i <= 1000; ++i) odometry.update(1e-3 * i, base.state);
  EXPECT_FALSE(odometry.correct(0.5, pose(1, 1, 1)));
  EXPECT_FALSE(odometry.correct(std::numeric_limits<double>::quiet_NaN(), pose(1, 1, 1)));
  EXPECT_FALSE(odometry.correct(1.0, pose(std::numeric_limits<double>::infinity(), 1, 1)));
  for (int i = 0; i < 12; ++i) {
    Pose bad = pose(1, 1, 1);
    (i < 3 ? bad.position(i) : bad.rotation((i - 3) / 3, (i - 3) % 3)) =
        std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(odometry.correct(1.0, bad)) << i;
  }
  EXPECT_EQ(odometry.pose().position.norm(), 0.0);
  EXPECT_THROW(Odometry(base.robot.model, {}, {.period = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace zwang::runtime
