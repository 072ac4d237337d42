// The effect of hinges, slides and casters on an object of a scene. Expected values are the formulas of their
// headers. Whole runs against them are the scenarios gate_leant_on, tray_leant_on and cart_pushed.
#include <gtest/gtest.h>

#include <cmath>

#include "plant/caster_friction.hpp"
#include "plant/object_guide.hpp"

namespace zwang::runtime {
namespace {

constexpr double step_length = 1e-3;  // [s]

lang::Guide closer() {
  lang::Guide guide;
  guide.upper = 1.5;
  guide.preload = 8.0;
  guide.stiffness = 10.0;
  guide.friction = 2.0;
  return guide;
}

/// The torque after the guide has gone from 0 to `q` at `rate`.
double torque_on_the_way(const lang::Guide& guide, double q, double rate) {
  ObjectGuide simulated(guide, 9.6);
  double torque = 0.0;
  for (double at = 0.0; std::abs(at) < std::abs(q); at += rate * step_length)
    torque = simulated.step(at, rate, step_length);
  return torque;
}

TEST(ObjectGuide, PressesTowardsZeroWithPreloadAndSpringAndRubs) {
  EXPECT_NEAR(torque_on_the_way(closer(), 0.5, 0.1), -(8.0 + 10.0 * 0.5 + 2.0), 0.01);
  lang::Guide other_side = closer();
  other_side.lower = -1.5;
  other_side.upper = 0.0;
  EXPECT_NEAR(torque_on_the_way(other_side, -0.5, -0.1), 8.0 + 10.0 * 0.5 + 2.0, 0.01);
}

TEST(ObjectGuide, FrictionHoldsWithoutCreep) {
  lang::Guide guide = closer();
  guide.preload = guide.stiffness = 0.0;
  ObjectGuide simulated(guide, 9.6);
  // A body that is pushed with less than the friction comes to rest where the bristle holds it: 1.5/(200^2 x
  // 9.6) rad.
  double q = 0.0, rate = 0.0;
  for (int i = 0; i < 3000; ++i) {
    rate += step_length * (1.5 + simulated.step(q, rate, step_length)) / 9.6;
    q += step_length * rate;
  }
  EXPECT_NEAR(q, 1.5 / (200.0 * 200.0 * 9.6), 1e-7);
  EXPECT_NEAR(rate, 0.0, 1e-9);
}

TEST(CasterFriction, TakesTheWholeFrictionStraightAhead) {
  CasterFriction casters(25.0, 12.0, 0.04, 0.3, 0.2);
  Eigen::Vector3d force;
  for (int i = 0; i < 1000; ++i) force = casters.step({0.1, 0.0, 0.0}, step_length);
  EXPECT_NEAR(force.x(), -12.0, 1e-9);
  EXPECT_NEAR(force.y(), 0.0, 1e-9);
  EXPECT_NEAR(force.z(), 0.0, 1e-9);
}

// Across, the angle a between heading and motion falls from 90 deg by da/dx = -sin(a)/t: tan(a/2) =
// exp(-x/t).
TEST(CasterFriction, SwivelsIntoItsWay) {
  constexpr double trail = 0.04, speed = 0.1;
  CasterFriction casters(25.0, 12.0, trail, 0.3, 0.2);
  Eigen::Vector3d force = casters.step({0.0, speed, 0.0}, step_length);
  EXPECT_LT(force.head<2>().norm(), 0.1) << "nothing holds it across";
  double way = 0.0;
  while (way < 2.0 * trail) {
    force = casters.step({0.0, speed, 0.0}, step_length);
    way += speed * step_length;
  }
  const double angle = 2.0 * std::atan(std::exp(-way / trail));
  EXPECT_NEAR(force.head<2>().norm(), 12.0, 1e-6);
  EXPECT_NEAR(force.y(), -12.0 * std::cos(angle), 0.05);
  EXPECT_NEAR(force.x(), -12.0 * std::sin(angle), 0.05);
}

// An object that turns about its own centre rolls each caster along its circle. The moment is mu m g times
// the radius.
TEST(CasterFriction, TurnsOnItsCircle) {
  CasterFriction casters(25.0, 12.0, 0.04, 0.3, 0.4);
  Eigen::Vector3d force;
  for (int i = 0; i < 20000; ++i) force = casters.step({0.0, 0.0, 0.5}, step_length);
  EXPECT_NEAR(force.head<2>().norm(), 0.0, 1e-6);
  // The wheel trails on a circle of its own: its pivot's speed has the share sqrt(1 - (t/r)^2) along the
  // heading.
  const double radius = 0.5;
  EXPECT_NEAR(force.z(), -12.0 * radius * std::sqrt(1.0 - std::pow(0.04 / radius, 2)), 0.01);
}

}  // namespace
}  // namespace zwang::runtime
