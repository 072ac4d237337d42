// The effect of hinges, slides and casters on an object of a scene. Expected values are the formulas of their
// headers. Whole runs against them are the scenarios gate_leant_on, tray_leant_on and cart_pushed.
#include <gtest/gtest.h>

#include <cmath>

#include "plant/caster_friction.hpp"
#include "plant/object_guide.hpp"
#include "zwang/runtime/mujoco_plant.hpp"

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

constexpr double post_radius = 0.05, half_thickness = 0.02;  // [m]

lang::SceneObject gate_on_a_hinge() {
  lang::SceneObject gate;
  gate.name = "gate";
  gate.shape = lang::ShapeKind::box;
  gate.size = {2.0 * half_thickness, 1.2, 1.0};
  gate.at = {1.0, 0.0};
  gate.mass = 20.0;
  gate.guide.emplace();
  gate.guide->turns = true;
  gate.guide->axis = {0.0, 0.0, 1.0};
  gate.guide->at = {0.0, 0.6, 0.0};
  gate.guide->upper = 1.5;
  gate.guide->damping = 20.0;
  return gate;
}

lang::SceneObject post_at(double x, double y) {
  lang::SceneObject post;
  post.name = "post";
  post.shape = lang::ShapeKind::cylinder;
  post.size = {post_radius, 1.0, 1.0};
  post.at = {x, y};
  return post;
}

/// [rad] How far a hand of 20 N, 1.1 m from the hinge and square to the gate, opens it in 5 s.
double opened_beside(const lang::SceneObject& other) {
  solver::ModelBuilder builder(
      solver::BaseType::fixed, "base_link",
      solver::RigidInertia::from_com(10.0, solver::Vector3::Zero(), solver::Matrix3::Identity()));
  lang::Robot robot;
  robot.name = "pole";
  robot.model = builder.build();
  robot.base_frame = "base_link";
  lang::Scene scene;
  scene.objects = {gate_on_a_hinge(), other};
  MujocoPlant plant(robot, scene);
  BodyPush push{.robot = -1, .body = 0};
  push.pose.position = {0.0, -0.5, 0.5};
  push.wrench.linear = solver::Vector3(20.0, 0.0, 0.0);
  plant.set_more_pushes(std::vector{push});
  for (int i = 0; i < 5000; ++i) EXPECT_EQ(plant.apply(Eigen::VectorXd(0)), PlantStatus::ok);
  return plant.truth().objects.front().travel;
}

// The gate's middle line runs from the hinge along (sin q, -cos q). A post at (a, -b) from the hinge lies
// a cos q - b sin q = R cos(q + f) beside it, with R its distance and tan f = b/a. They touch where that is
// half the gate and the post's radius.
TEST(Guides, AGateMeetsAPostInItsWay) {
  constexpr double a = 0.6, b = 0.6;
  const double angle = std::acos((half_thickness + post_radius) / std::hypot(a, b)) - std::atan2(b, a);
  EXPECT_NEAR(opened_beside(post_at(1.0 + a, 0.6 - b)), angle, 1e-3);
}

// Beside the hinge it is the frame: nothing of it is in the way.
TEST(Guides, AGateDoesNotMeetItsFrame) {
  EXPECT_GT(opened_beside(post_at(1.0 + half_thickness + post_radius + 0.01, 0.55)), 1.4);
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
