// Two robots in one world. The one gains the momentum that the other loses. Each is told of the other as the
// scene says. The same seed gives the same run, bit by bit.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "constants.hpp"
#include "scene_program.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

/// A task of a robot that does nothing: it rolls as it is pushed.
const char* const idle_task = R"(zwang: 1
robot: robots/mecanum_base.yaml
start: roll
tasks:
  roll:
    timeout: never
)";

lang::Program idle_program_in(const std::string& scene) {
  return zwang::test::program_in_scene(idle_task, scene);
}

// Equal robots that roll freely, and a contact without damping: they change their speeds. The force of four
// wheels is 4 tau / R, so the acceleration tells the mass, wheels included, and the impulse must fit it.
TEST(TwoRobots, WhatOneLosesInAHitTheOtherGains) {
  const lang::Program program = idle_program_in(R"(robots:
  partner: {task: task.yaml, at: [1.2 m, 0 m], stiffness: 100 kN/m, damping: 0}
)");
  ScenePlant plant(program);
  const double push = 4.0 * 2.0 / program.robot.model.wheels().front().radius;
  const Eigen::VectorXd torque = Eigen::VectorXd::Constant(4, 2.0), none = Eigen::VectorXd::Zero(4);
  double mass = 0.0, before = 0.0, impulse = 0.0;
  for (int i = 0; i < 1500; ++i) {
    ASSERT_EQ(plant.apply(i < 300 ? torque : none), PlantStatus::ok);
    const Truth& truth = plant.truth();
    if (i == 200) mass = push / truth.acceleration.x();
    if (!truth.objects[0].touched) before = truth.velocity.x();
    impulse += truth.objects[0].force * period;
  }
  const double first = plant.truth().velocity.x(), other = plant.truth().robots[0].velocity.x();
  ASSERT_TRUE(plant.truth().objects[0].touched);
  EXPECT_GT(before, 0.4);
  EXPECT_NEAR(first + other, before, 2e-3 * before) << "momentum";
  // The step takes as much of the relative speed as a damping ratio of (h w)^2/4 does, w^2 = 4 K/(m/2).
  const double taken = std::numbers::pi / 4.0 * period * period * 4.0 * 100e3 / (0.5 * mass);
  EXPECT_NEAR(other, before * (1.0 - 0.5 * taken), 0.03 * before) << "energy";
  EXPECT_NEAR(impulse, mass * (before - first), 0.01 * impulse);
}

// A hit without damping: v2 = 2 m1 / (m1 + m2) v1. The payload is the partner's alone.
TEST(TwoRobots, APayloadIsThePartnersOwn) {
  const double payload = 30.0;
  const lang::Program program = idle_program_in(R"(robots:
  partner: {task: task.yaml, at: [1.2 m, 0 m], stiffness: 100 kN/m, damping: 0}
faults:
  - {at: 0 s, robot: partner, payload: 30 kg}
)");
  ScenePlant plant(program);
  const double push = 4.0 * 2.0 / program.robot.model.wheels().front().radius;
  const Eigen::VectorXd torque = Eigen::VectorXd::Constant(4, 2.0), none = Eigen::VectorXd::Zero(4);
  double mass = 0.0, before = 0.0;
  for (int i = 0; i < 1500; ++i) {
    ASSERT_EQ(plant.apply(i < 300 ? torque : none), PlantStatus::ok);
    if (i == 200) mass = push / plant.truth().acceleration.x();
    if (!plant.truth().objects[0].touched) before = plant.truth().velocity.x();
  }
  ASSERT_TRUE(plant.truth().objects[0].touched);
  const double expected = 2.0 * mass / (2.0 * mass + payload) * before;
  EXPECT_NEAR(plant.truth().robots[0].velocity.x(), expected, 0.03 * before);
  EXPECT_GT(before - expected, 0.2 * before) << "the payload tells";
}

TEST(TwoRobots, NobodyStartsInsideAnother) {
  const std::string partner = "robots: {partner: {task: task.yaml, yaw: 90 deg, at: ";
  try {
    idle_program_in(partner + "[0.6 m, 0 m]}}\n");
    FAIL() << "0.4 m and 0.28 m reach farther than 0.6 m";
  } catch (const std::runtime_error& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("E913"), std::string::npos) << refusal.what();
    EXPECT_NE(std::string(refusal.what()).find("overlap by"), std::string::npos) << refusal.what();
  }
  lang::Program program = idle_program_in(partner + "[1 m, 0 m]}}\n");
  program.scene->robots[0].at = {0.6, 0.0};  // as `--start-at` may put them
  try {
    const ScenePlant plant(program);
    FAIL() << "0.4 m and 0.28 m reach farther than 0.6 m";
  } catch (const std::invalid_argument& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("partner"), std::string::npos) << refusal.what();
  }
}

TEST(TwoRobots, RealRollersAreTheScenesToAsk) {
  lang::Program program = idle_program_in("real_rollers: true\n");
  EXPECT_NE(MujocoPlant(program.robot, *program.scene).mjcf().find("roller_3_17"), std::string::npos);
  program.scene->real_rollers = false;
  EXPECT_EQ(MujocoPlant(program.robot, *program.scene).mjcf().find("roller_3_17"), std::string::npos);
}

lang::Program docking_with_a_partner_that_comes() {
  lang::LoadOptions options;
  options.scene = ZWANG_SOURCE_DIR "/specs/scenes/dock_live_meets.yaml";
  lang::Diagnostics diagnostics;
  const auto program = lang::load(ZWANG_SOURCE_DIR "/specs/docking.yaml", options, diagnostics);
  std::ostringstream text;
  lang::render_human(diagnostics, text);
  if (!program) throw std::runtime_error(text.str());
  return *program;
}

/// All torques of both, in their order.
std::vector<double> torques_of(const lang::Program& program, double seconds, std::uint64_t seed) {
  ScenePlantOptions options;
  options.seed = seed;
  ScenePlant plant(program, options);
  Runner runner(program, {.period = period});
  Sensed sensed(program.robot.model, program.signals.size());
  std::vector<double> torques;
  while (plant.truth().time < seconds && plant.sense(sensed) == PlantStatus::ok) {
    const Eigen::VectorXd& tau = runner.step(sensed);
    torques.insert(torques.end(), tau.data(), tau.data() + tau.size());
    if (plant.apply(tau) != PlantStatus::ok) break;
    const Eigen::VectorXd& other = plant.partners()[0].torque;
    torques.insert(torques.end(), other.data(), other.data() + other.size());
  }
  return torques;
}

TEST(TwoRobots, OneSeedIsOneRunBitByBit) {
  const lang::Program program = docking_with_a_partner_that_comes();
  const std::vector<double> once = torques_of(program, 2.0, 7);
  EXPECT_EQ(once.size(), 2000u * 8u);
  EXPECT_TRUE(once == torques_of(program, 2.0, 7));
  EXPECT_FALSE(once == torques_of(program, 2.0, 8)) << "the noise is another";
}

// The first robot stands at the origin and does nothing; the other one looks for it and comes to the
// place 1.8 m behind it.
TEST(TwoRobots, ThePartnerSeesTheFirstRobot) {
  const lang::Program program = docking_with_a_partner_that_comes();
  ScenePlant plant(program);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(4);
  while (plant.truth().time < 14.0) ASSERT_EQ(plant.apply(none), PlantStatus::ok);
  const ObjectTruth& partner = plant.truth().objects.back();
  EXPECT_NEAR(partner.x, -1.8, 0.02);
  EXPECT_NEAR(partner.y, 0.0, 0.02);
  EXPECT_NEAR(partner.yaw, 0.0, 0.01);
  EXPECT_FALSE(partner.touched);
}

}  // namespace
}  // namespace zwang::runtime
