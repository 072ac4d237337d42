// The twist of the base from its wheels, against the wheel rates that the drives' textbook formulas give.
#include "zwang/solver/wheel_odometry.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "robots.hpp"

namespace zwang::solver {
namespace {

using test::base_on;
using test::WheelPlace;

constexpr double radius = 0.1;

struct Planar {
  double vx, vy, wz;
};
constexpr Planar motions[] = {{0.5, 0, 0}, {0, -0.3, 0}, {0, 0, 0.7}, {0.4, 0.2, -0.9}};

void expect_twist(const WheelTwist& found, const Planar& V, int rank) {
  EXPECT_EQ(found.rank, rank);
  EXPECT_NEAR(found.twist.linear.x(), V.vx, 1e-12);
  EXPECT_NEAR(found.twist.linear.y(), V.vy, 1e-12);
  EXPECT_NEAR(found.twist.angular.z(), V.wz, 1e-12);
  EXPECT_NEAR(found.slip, 0.0, 1e-12);
}

TEST(WheelOdometry, MecanumWheelRatesGiveTheTwist) {
  // u'(v + w x P) = R u_x rate: the roller at the ground pushes along u, the wheel rolls along x.
  const double quarter = M_PI / 4.0;
  std::vector<WheelPlace> places;
  for (const auto& [x, y, angle] : {std::array{0.25, 0.2, quarter}, std::array{0.25, -0.2, -quarter},
                                    std::array{-0.25, 0.2, -quarter}, std::array{-0.25, -0.2, quarter}}) {
    places.push_back({.x = x, .y = y, .wheel = {.radius = radius, .roller_angle = angle}});
  }
  const Model model = base_on(places);
  for (const Planar& V : motions) {
    State state(model);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double angle = *places[i].wheel.roller_angle;
      const double ux = -std::sin(angle), uy = std::cos(angle);
      state.qd(static_cast<int>(i)) =
          (ux * (V.vx - V.wz * places[i].y) + uy * (V.vy + V.wz * places[i].x)) / (radius * ux);
    }
    expect_twist(WheelOdometry(model).twist(state), V, 3);
  }
}

TEST(WheelOdometry, DifferentialWheelRatesGiveTheTwist) {
  const double b = 0.2;
  const Model model = base_on({{.x = 0.0, .y = b}, {.x = 0.0, .y = -b}});
  for (const Planar& motion : motions) {
    const Planar V{motion.vx, 0.0, motion.wz};
    State state(model);
    state.qd << (V.vx - b * V.wz) / radius, (V.vx + b * V.wz) / radius;
    expect_twist(WheelOdometry(model).twist(state), V, 3);
  }
}

TEST(WheelOdometry, ActiveCasterRatesGiveTheTwistAtAnySwivelAngle) {
  // rates (1/R)(e +- s/(2c) n)'(v + w x p), swivel n'(v + w x p)/c - w: hubs c behind the swivel and s apart.
  const double c = 0.03, s = 0.08;
  const std::vector<Vector3> hubs = {{-c, s / 2, 0}, {-c, -s / 2, 0}};
  std::vector<WheelPlace> places;
  for (const auto& [x, y] : {std::array{0.2, 0.1}, std::array{-0.2, -0.1}}) {
    places.push_back({.x = x, .y = y, .swivels = true, .hubs = hubs});
  }
  const Model model = base_on(places);
  const double angles[] = {0.4, -1.1};
  for (const Planar& V : motions) {
    State state(model);
    for (int i = 0; i < 2; ++i) {
      const Vector3 e(std::cos(angles[i]), std::sin(angles[i]), 0.0);
      const Vector3 n(-e.y(), e.x(), 0.0);
      const WheelPlace& place = places[static_cast<std::size_t>(i)];
      const Vector3 v(V.vx - V.wz * place.y, V.vy + V.wz * place.x, 0.0);
      // A hub's centre moves with the swivel: e'(v + (w + swivel) z x P) = e'v -+ (w + swivel) s/2.
      const double swivel = n.dot(v) / c - V.wz;
      state.q(3 * i) = angles[i];
      state.qd(3 * i) = swivel;
      state.qd(3 * i + 1) = (e - s / (2 * c) * n).dot(v) / radius;
      state.qd(3 * i + 2) = (e + s / (2 * c) * n).dot(v) / radius;
    }
    expect_twist(WheelOdometry(model).twist(state), V, 3);
  }
}

TEST(WheelOdometry, WhatNoWheelTellsStaysZero) {
  std::vector<WheelPlace> places{{.x = 0.2, .y = 0.2}, {.x = 0.2, .y = -0.2}};
  for (WheelPlace& place : places) place.wheel.holds_sideways = false;
  const Model model = base_on(places);
  State state(model);
  state.qd << 3.0, 3.0;
  expect_twist(WheelOdometry(model).twist(state), {0.3, 0.0, 0.0}, 2);
}

TEST(WheelOdometry, ContradictingWheelsShowAsSlip) {
  // Four wheels on the same side: mean speed 0.2 m/s, each 0.1 m/s off.
  std::vector<WheelPlace> places;
  for (const double x : {-0.3, -0.1, 0.1, 0.3}) places.push_back({.x = x, .y = 0.2});
  for (WheelPlace& place : places) place.wheel.holds_sideways = false;
  const Model model = base_on(places);
  State state(model);
  state.qd << 3.0, 1.0, 1.0, 3.0;
  const WheelTwist found = WheelOdometry(model).twist(state);
  EXPECT_NEAR(found.slip, 0.1, 1e-12);
  EXPECT_NEAR(found.twist.linear.x() - 0.2 * found.twist.angular.z(), 0.2, 1e-12);
}

}  // namespace
}  // namespace zwang::solver
