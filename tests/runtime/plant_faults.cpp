// Faults of the plant that must not pass unseen. The simulation resets itself, a run differs from its
// repetition, or the robot is not the one that was asked for.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>
#include <regex>
#include <stdexcept>

#include "plant/mjcf_text.hpp"
#include "plant_robots.hpp"

namespace zwang::runtime {
namespace {

using namespace testing;

lang::Scene scene_with_wall(double x) {
  lang::SceneObject wall;
  wall.name = "wall";
  wall.size = {4.0, 0.2, 1.0};
  wall.at = {x, 0.0};
  lang::Scene scene;
  scene.objects = {wall};
  return scene;
}

TEST(PlantFaults, DivergenceIsReportedAndStays) {
  const lang::Robot robot = mecanum_base();
  for (const double torque : {1e8, 1e13, 1e300}) {
    MujocoPlant plant(robot, scene_with_wall(1.0));
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(4);
    for (int i = 0; i < 10; ++i) ASSERT_EQ(plant.apply(zero), PlantStatus::ok);
    PlantStatus status = PlantStatus::ok;
    double last = plant.truth().time;
    for (int i = 0; i < 2000 && status == PlantStatus::ok; ++i) {
      status = plant.apply(Eigen::VectorXd::Constant(4, torque));
      if (status == PlantStatus::ok) {
        ASSERT_NEAR(plant.truth().time, last + 1e-3, 1e-9);
      }
      last = plant.truth().time;
    }
    EXPECT_EQ(status, PlantStatus::diverged) << torque;
    EXPECT_EQ(plant.apply(zero), PlantStatus::diverged);
    Sensed sensed(robot.model);
    sensed.time = 42.0;
    EXPECT_EQ(plant.sense(sensed), PlantStatus::diverged);
    EXPECT_EQ(sensed.time, 42.0);  // untouched
    EXPECT_TRUE(std::isfinite(plant.truth().x) && plant.truth().acceleration.allFinite());
    EXPECT_GT(plant.truth().time, 0.005);  // the last good instant, not a reset clock
  }
}

TEST(PlantFaults, CommandsThatAreNotTorquesDoNotArrive) {
  const lang::Robot robot = mecanum_base();
  MujocoPlant plant(robot, {});
  Eigen::VectorXd tau = Eigen::VectorXd::Zero(4);
  tau[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(plant.apply(tau), PlantStatus::unreachable);
  tau[2] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(plant.apply(tau), PlantStatus::unreachable);
  EXPECT_EQ(plant.apply(Eigen::VectorXd::Zero(3)), PlantStatus::unreachable);
  EXPECT_EQ(plant.truth().time, 0.0);
  EXPECT_EQ(plant.apply(Eigen::VectorXd::Zero(4)), PlantStatus::ok);
}

/// Every bit of the base's path, wheels and wall force, through an impact with friction.
std::vector<double> record(const lang::Robot& robot) {
  lang::Scene scene = scene_with_wall(0.45);
  scene.objects[0].friction = 0.1;
  MujocoPlantOptions options;
  options.start_yaw = 0.1;
  options.start_at = {-0.1, 0.0};
  MujocoPlant plant(robot, scene, options);
  const PlanarReference reference(robot.model);
  const Eigen::VectorXd tau = reference.torque_of_wrench({20.0, 1.0, 0.0});
  Sensed sensed(robot.model);
  std::vector<double> all;
  for (int i = 0; i < 3000; ++i) {
    EXPECT_EQ(plant.apply(tau), PlantStatus::ok);
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    const Truth& truth = plant.truth();
    all.insert(all.end(), {truth.x, truth.y, truth.yaw, truth.objects[0].force});
    all.insert(all.end(), truth.acceleration.data(), truth.acceleration.data() + 3);
    all.insert(all.end(), sensed.state.q.data(), sensed.state.q.data() + 4);
  }
  EXPECT_GT(plant.truth().objects[0].peak_force, 20.0);
  return all;
}

TEST(PlantFaults, TwoRunsAreTheSameBits) {
  const lang::Robot robot = mecanum_base();
  const std::vector<double> one = record(robot);
  const std::vector<double> other = record(robot);
  ASSERT_EQ(one.size(), other.size());
  EXPECT_EQ(std::memcmp(one.data(), other.data(), one.size() * sizeof(double)), 0);
}

std::string refusal(const lang::Robot& robot, const lang::Scene& scene = {},
                    const MujocoPlantOptions& options = {}) {
  try {
    MujocoPlant plant(robot, scene, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(PlantFaults, RefusesWhatItCannotSimulateAndSaysWhy) {
  EXPECT_EQ(refusal(mecanum_base()), "");
  EXPECT_NE(refusal(mecanum_base(), scene_with_wall(0.3)).find("inside `wall` by "), std::string::npos);

  lang::Scene flat = scene_with_wall(1.0);
  flat.objects[0].size[1] = 0.0;
  EXPECT_NE(refusal(mecanum_base(), flat).find("no size"), std::string::npos);

  lang::Scene broken = scene_with_wall(std::numeric_limits<double>::quiet_NaN());
  EXPECT_NE(refusal(mecanum_base(), broken).find("finite"), std::string::npos);

  lang::Robot bare = differential_base();
  bare.footprint.clear();
  EXPECT_NE(refusal(bare).find("footprint"), std::string::npos);

  EXPECT_NE(refusal(build_base({}, {})).find("wheels"), std::string::npos);
}

// A plate has A + B = C about its principal axes. However it lies in its link, the text keeps A + B >= C, to
// the last digit: MuJoCo refuses less.
TEST(PlantFaults, FlatBodiesStartHoweverTheyLie) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const std::regex numbers("diaginertia=\"([^ ]+) ([^ ]+) ([^\"]+)\"");
  for (int i = 0; i < 200; ++i) {
    const double a = 1.1 + any(random), b = 1.1 + any(random);
    const Matrix3 axes = Eigen::Quaterniond(any(random), any(random), any(random), any(random))
                             .normalized()
                             .toRotationMatrix();
    const Vector3 com(any(random), any(random), any(random));
    const Matrix3 plate = axes * Vector3(a, b, a + b).asDiagonal() * axes.transpose();
    const std::string text = mjcf::inertial(RigidInertia::from_com(2.0, com, plate));
    std::smatch found;
    ASSERT_TRUE(std::regex_search(text, found, numbers)) << text;
    EXPECT_GE(std::stod(found[1]) + std::stod(found[2]), std::stod(found[3])) << text;
    EXPECT_NEAR(std::stod(found[3]), a + b, 1e-9) << text;
  }
}

}  // namespace
}  // namespace zwang::runtime
