// Norms in a plane, judged by the motion of a base whose dynamics were derived apart from the library.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "planar_course.hpp"
#include "schedule/plane_norm.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

struct Most {
  std::optional<double> acceleration, force;
};

lang::Group norms_in(int in, const Most& most) {
  AxisStatements plane = free_axis("calm.plane", Axis::x);
  plane.is_planar = true;
  if (most.acceleration) plane.acceleration = between(0.0, *most.acceleration);
  if (most.force) plane.force = between(0.0, *most.force);
  lang::Group group = task("", {plane}, base_link, in).groups[0];
  group.name = "calm";
  return at_level_zero(group);
}

lang::Program driven(double vx, double vy, double wz, int in, const Most& most) {
  lang::Task go = task(
      "go", {drive("go.x", Axis::x, Quantity::velocity, vx), drive("go.y", Axis::y, Quantity::velocity, vy),
             drive("go.rz", Axis::rz, Quantity::velocity, wz)});
  lang::Program p = program({go});
  p.always.groups = {norms_in(in, most)};
  return p;
}

Eigen::Vector2d velocity_in_world(const Course& course) {
  return Eigen::Rotation2Dd(course.base.pose.z()) * course.base.V.head<2>();
}

/// Of the base's origin, between two ticks.
double hardest_acceleration(Course& course, double seconds) {
  double hardest = 0.0;
  Eigen::Vector2d last = velocity_in_world(course);
  course.run(seconds, [&] {
    const Eigen::Vector2d now = velocity_in_world(course);
    hardest = std::max(hardest, (now - last).norm() / period);
    last = now;
  });
  return hardest;
}

// Each axis allows its own value. Together 0.8 m/s at 1 rad/s accelerate the point by 0.8 m/s^2.
TEST(Plane, TheAccelerationOfThePointIsLimitedAlsoInATurn) {
  for (const int in : {base_link, world_frame}) {
    Course course(driven(0.8, 0.0, 1.0, in, {.acceleration = 0.1, .force = {}}));
    EXPECT_LT(hardest_acceleration(course, 12.0), 0.1 * 1.01) << in;
    EXPECT_LT(course.speed(), 0.2) << "no circle of 0.8 m/s";
  }
}

TEST(Plane, ReachesTheAccelerationInEveryDirection) {
  for (int k = 0; k < 24; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 24 + 0.05;
    Course course(
        driven(std::cos(angle), std::sin(angle), 0.0, base_link, {.acceleration = 0.3, .force = {}}));
    const double hardest = hardest_acceleration(course, 0.5);
    EXPECT_LT(hardest, 0.3 * 1.0001) << angle;
    EXPECT_GT(hardest, 0.3 * 0.98) << angle;
  }
}

int sides_in_force(const Course& course) {
  const std::vector<InForce>& all = course.runner.scheduler().in_force();
  return static_cast<int>(std::ranges::count_if(all, [](const InForce& f) { return f.origin.part >= 0; }));
}

TEST(Plane, HasOnlyTheSidesInForceThatAreMet) {
  const double along_side_1 = std::numbers::pi / 8;
  Course course(driven(0.4 * std::cos(along_side_1), 0.4 * std::sin(along_side_1), 0.0, base_link,
                       {.acceleration = 0.3, .force = {}}));
  course.run(0.5);
  EXPECT_GT(sides_in_force(course), 2) << "it speeds up";
  course.run(8.0);
  EXPECT_EQ(sides_in_force(course), 2) << "it goes on";
}

// A wall without friction, across any direction: 40 N at most, and no less than the polygon leaves.
TEST(Plane, PressesOnAWallAcrossAnyDirectionWithItsForceAtMost) {
  for (int k = 0; k < 16; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 16 + 0.1;
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
    lang::Program p =
        driven(0.4 * normal.x(), 0.4 * normal.y(), 0.0, base_link, {.acceleration = {}, .force = 40.0});
    for (AxisStatements& a : p.tasks[0].groups[0].axes) a.time_constant.constant = 0.05;
    Course pressing(p);
    double felt = 0.0;
    const double end = 4.0;
    while (pressing.base.time < end) {
      const double depth = std::max(0.0, normal.dot(pressing.base.pose.head<2>()));
      const double rate = normal.dot(velocity_in_world(pressing));
      felt = depth > 0.0 ? std::max(0.0, 2e4 * depth + 1500.0 * rate) : 0.0;
      const Eigen::Vector2d force = -felt * (Eigen::Rotation2Dd(-pressing.base.pose.z()) * normal);
      pressing.tick({force.x(), force.y(), 0.0});
    }
    EXPECT_LT(felt, 40.0 * 1.001) << angle;
    EXPECT_GT(felt, 40.0 * 0.9) << angle;
  }
}

// Worst over orientations, by a brute search over pushes and walls.
double brute_mass_factor(double ratio) {
  double worst = 1.0;
  for (int turn = 0; turn < 16; ++turn) {
    const Eigen::Rotation2Dd R(std::numbers::pi * turn / 16);
    const Eigen::Matrix2d W = R.toRotationMatrix() * Eigen::Vector2d(1.0, 1.0 / ratio).asDiagonal() *
                              R.toRotationMatrix().transpose();
    const auto felt = [&](const Eigen::Vector2d& push, double angle) {
      const Eigen::Vector2d n(std::cos(angle), std::sin(angle));
      return n.dot(W * push) / n.dot(W * n);
    };
    for (int p = 0; p < 360; ++p) {
      const double at = std::numbers::pi * p / 360;
      const Eigen::Vector2d push(std::cos(at), std::sin(at));
      double sides = 0.0, walls = 0.0;
      for (int k = 0; k < 8; ++k) sides = std::max(sides, std::abs(felt(push, std::numbers::pi * k / 8)));
      for (int k = 0; k < 90; ++k) walls = std::max(walls, std::abs(felt(push, std::numbers::pi * k / 90)));
      worst = std::max(worst, walls / sides);
    }
  }
  return worst * PlaneNorm::apothem;
}

TEST(Plane, AMassThatDiffersByDirectionTakesFromTheSides) {
  for (const double ratio : {1.0, 2.0, 3.0, 5.0, 10.0}) {
    const double found = brute_mass_factor(ratio);
    EXPECT_LT(found, mass_factor_of(ratio) * (1.0 + 1e-9)) << ratio;
    EXPECT_GT(found, mass_factor_of(ratio) * 0.97) << ratio << ": by the grid of the search";
  }
}

// A point that rolls ahead: v' <= sqrt(a^2 - s^2), and 1.118 a at most while it brakes.
TEST(Plane, WhatAPointThatRollsMayAccelerateWith) {
  EXPECT_NEAR(ahead_of(0.3, 0.0).high, 0.3, 1e-12);
  EXPECT_NEAR(ahead_of(0.3, 0.0).low, -0.3, 1e-12);
  for (const double across : {-0.3, -0.2, 0.1, 0.29, 0.3}) {
    const solver::Range ahead = ahead_of(0.3, across);
    EXPECT_LE(std::hypot(ahead.high, across), 0.3 * (1.0 + 1e-9));
    EXPECT_LE(std::hypot(ahead.low, across), 0.3 * 1.1181);
    EXPECT_LE(ahead.low, -0.15);
  }
}

}  // namespace
}  // namespace zwang::runtime
