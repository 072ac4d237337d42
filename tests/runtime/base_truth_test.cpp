// The plant's measurements of a base: its lean, its acceleration and its push.
#include <gtest/gtest.h>

#include <cmath>

#include "constants.hpp"
#include "plant/quiet_means.hpp"
#include "plant_robots.hpp"

namespace zwang::runtime {
namespace {

using namespace testing;
using Eigen::Vector2d;

// On a circle at v and w the chord of the velocity over T is 2 v sin(w T/2): a = v w, less a hair.
TEST(QuietMeans, ABaseThatTurnsIsAcceleratedTowardsTheMiddle) {
  QuietMeans means(period);
  for (int i = 0; i < 1000; ++i) {
    const double angle = 1.5 * i * period;
    means.look(0.4 * Vector2d(std::cos(angle), std::sin(angle)), Vector2d::Zero(), false);
  }
  EXPECT_NEAR(means.acceleration(), 2.0 * 0.4 * std::sin(1.5 * 0.01) / 0.02, 1e-9);
  EXPECT_NEAR(means.acceleration(), 0.4 * 1.5, 1e-4);
}

TEST(QuietMeans, AForceThatAlternatesCountsWithItsMean) {
  QuietMeans means(period);
  for (int i = 0; i < 100; ++i) means.look(Vector2d::Zero(), Vector2d(i % 2 == 0 ? 60.0 : 0.0, 40.0), false);
  EXPECT_NEAR(means.push(), 50.0, 1e-9);
}

TEST(QuietMeans, NothingOfAHitCounts) {
  QuietMeans means(period);
  for (int i = 0; i < 100; ++i) means.look(Vector2d(0.01 * i * period, 0.0), Vector2d(5.0, 0.0), false);
  for (int i = 0; i < 30; ++i) means.look(Vector2d(-1.0, 0.0), Vector2d(900.0, 0.0), true);
  for (int i = 0; i < 19; ++i) means.look(Vector2d(0.0, 0.0), Vector2d(7.0, 0.0), false);
  EXPECT_NEAR(means.push(), 5.0, 1e-9);
  EXPECT_NEAR(means.acceleration(), 0.01, 1e-9);
  means.look(Vector2d(0.0, 0.0), Vector2d(7.0, 0.0), false);
  EXPECT_NEAR(means.push(), 7.0, 1e-9) << "20 ms after it they count again";
}

lang::Scene rough_wall(double yaw) {
  lang::SceneObject wall;
  wall.name = "wall";
  wall.shape = lang::ShapeKind::wall;
  wall.size = {6.0, 0.2, 1.0};
  wall.at = {0.42, 0.0};
  wall.yaw = yaw;
  wall.damping = 0.5;
  wall.friction = 0.3;
  lang::Scene scene;
  scene.objects = {wall};
  return scene;
}

// Pushed square into a wall and along it, the base stands: friction and normal force together are the push.
TEST(BaseTruth, PushIsThePlanarSumOfNormalForceAndFriction) {
  MujocoPlant plant(mecanum_base(), rough_wall(0.0));
  const PlanarReference reference(mecanum_base().model);
  double most_before_quiet = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const Truth& truth = plant.truth();
    const Vector3 wrench(40.0, i < 1500 ? 0.0 : 9.0, -2000.0 * truth.yaw - 200.0 * truth.velocity.z());
    ASSERT_EQ(plant.apply(reference.torque_of_wrench(wrench)), PlantStatus::ok);
    most_before_quiet = std::max(most_before_quiet, truth.base.push);
  }
  EXPECT_GT(plant.truth().objects[0].peak_force, 60.0) << "it was hit";
  EXPECT_NEAR(plant.truth().base.push, std::hypot(40.0, 9.0), 0.3);
  EXPECT_LT(most_before_quiet, 1.06 * std::hypot(40.0, 9.0)) << "no hit is part of the push";
  EXPECT_LT(plant.truth().base.acceleration, 1e-3);
  EXPECT_LT(std::abs(plant.truth().base.roll) + std::abs(plant.truth().base.pitch), 0.01);
}

// F = m a: the first 0.2 s of an even push, before anything is touched.
TEST(BaseTruth, AccelerationIsThatOfTheFreeBase) {
  MujocoPlant plant(mecanum_base(), {});
  const PlanarReference reference(mecanum_base().model);
  const Eigen::VectorXd tau = reference.torque_of_wrench({30.0, 0.0, 0.0});
  for (int i = 0; i < 200; ++i) ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
  const Truth& truth = plant.truth();
  EXPECT_NEAR(truth.base.acceleration, truth.acceleration.head<2>().norm(), 1e-3 * truth.base.acceleration);
  EXPECT_GT(truth.base.acceleration, 0.2);
  EXPECT_EQ(truth.base.push, 0.0);
}

}  // namespace
}  // namespace zwang::runtime
