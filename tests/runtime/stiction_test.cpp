// A push against stiction, judged by the simulated plant. Each test prints its figure.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "../is_long.hpp"
#include "constants.hpp"
#include "simulated_case.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

const char* const pressing = R"(
signals:
  wanted: {type: number, unit: N, stale_after: 100 ms}
start: press
tasks:
  press:
    constraints:
      contact: {move: base_link, in: base_link, x: {force: wanted, velocity: [-0.05 m/s, 0.08 m/s]}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: elapsed > 20 s, goto: done}]
)";

/// The program, each motor with this friction.
lang::Program rubbing(lang::Program program, const lang::JointFriction& friction) {
  for (int j = 0; j < program.robot.model.joint_count(); ++j) {
    if (program.robot.model.joint(j).actuated) program.robot.friction[static_cast<std::size_t>(j)] = friction;
  }
  return program;
}

struct Pressed {
  double force = 0.0, least = 1e9, most = 0.0;  ///< [N] on the wall at the end, in the last 5 of 20 s
};

/// `integral` [1/s] of the measured force's error goes into what is asked for, a hit counting as twice the
/// force. The plant is `truth`, what the controller knows is `file`.
Pressed pressed(const lang::Program& truth, const lang::Program& file, double integral = 0.0) {
  ScenePlant plant(truth, {.simulation = {.start_yaw = 0.0}});
  Runner runner(file);
  Sensed sensed(file.robot.model, file.signals.size());
  double wanted = 20.0;
  Pressed pressed;
  while (!runner.finished() && runner.state() == RunState::running) {
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    const double force = plant.truth().objects[0].force;
    const double error = 20.0 - std::min(force, 40.0);
    if (force > 0.0) wanted = std::clamp(wanted + integral * period * error, 0.0, 40.0);
    SignalSample& sample = sensed.signals[0];
    sample.valid = true;
    sample.stamp = sensed.time;
    sample.number = wanted;
    EXPECT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
    pressed.force = force;
    if (sensed.time < 15.0) continue;
    pressed.least = std::min(pressed.least, force);
    pressed.most = std::max(pressed.most, force);
  }
  EXPECT_EQ(runner.state(), RunState::done) << "friction was taken for a fault";
  return pressed;
}

constexpr lang::JointFriction rough{.coulomb = 0.1, .presliding = 0.2e-3, .compensate = 0.9};

struct Rubbing {
  const char* robot;
  double turns;  ///< sum |dq/dx| over the motors [rad/m]
};
const Rubbing rubbing_drives[] = {{"mecanum_base", 4.0 / 0.0759},
                                  {"diff_base", 2.0 / 0.130},
                                  {"omni_base", 2.0 * std::sqrt(0.75) / 0.040},
                                  {"kelo_two_base", 4.0 / 0.0535},
                                  {"kelo_base", 8.0 / 0.0535}};

// Stiction takes up to sum tau_c |dq/dx| from a push without a sensor or adds it, 5.3 N of 20 N on the
// mecanum base. Its compensation leaves (1 - c) of it either way, whatever the wall.
TEST(Push, AgainstStictionHoldsTenPercentWithoutASensorAndOneWithForceFeedback) {
  for (const auto& [robot, turns] : rubbing_drives) {
    const lang::Program program = rubbing(write(pressing, specs / "scenes/wall_far.yaml", robot), rough);
    const bool every_wall = zwang::test::is_long() || robot == rubbing_drives[0].robot;
    for (const double stiffness : every_wall ? std::vector{1e4, 1e5, 1e6} : std::vector{1e5}) {
      lang::Program walled = program;
      walled.scene->objects.at(0).stiffness = stiffness;
      const Pressed without = pressed(walled, walled);
      const double share = turns * rough.coulomb;
      std::printf("%s, 20 N against stiction of %.1f N in all, wall %.0e N/m: %.2f to %.2f N\n", robot, share,
                  stiffness, without.least, without.most);
      EXPECT_GE(without.least, 20.0 - (1.0 - rough.compensate) * share - 0.1) << robot;
      EXPECT_LE(without.most, 20.0 + (1.0 - rough.compensate) * share + 0.1) << robot;
      EXPECT_NEAR(without.least, 20.0, 2.0) << robot;
      EXPECT_NEAR(without.most, 20.0, 2.0) << robot;
    }
    // The robot's limit of 1 m/s^2 is one of the push, too: of the omni base m a = 20.5 N, and stiction takes
    // 0.9 N of that.
    lang::Program unlimited = program;
    std::erase_if(unlimited.robot.limits,
                  [](const auto& limit) { return limit.quantity == solver::Quantity::acceleration; });
    const Pressed with = pressed(unlimited, unlimited, 2.0);
    std::printf("%s, with force feedback %.3f N\n", robot, with.force);
    EXPECT_NEAR(with.force, 20.0, 0.2) << robot;
  }
}

// A push that has come forward misses sum (c tau_file - tau_true) |dq/dx|. Of the presliding 10 % too much
// may leave (1 + c - 2 c / 1.1) of sum tau_c |dq/dx|, 1.8 N; 20 % too little leave 1 N and do not ring.
TEST(Push, AgainstStictionThatTheFileHasWrongMissesByTheDifference) {
  const double turns = rubbing_drives[0].turns;
  const lang::Program program = write(pressing, specs / "scenes/wall_far.yaml");
  const lang::Program truth = rubbing(program, rough);
  for (const double factor :
       zwang::test::is_long() ? std::vector{0.7, 0.8, 1.25, 1.3} : std::vector{0.7, 1.3}) {
    lang::JointFriction friction = rough;
    friction.coulomb *= factor;
    const Pressed result = pressed(truth, rubbing(program, friction));
    const double miss = turns * std::abs(rough.compensate * friction.coulomb - rough.coulomb);
    std::printf("coulomb in the file %.2f of the true one: %.2f to %.2f N, %.2f N off\n", factor,
                result.least, result.most, miss);
    EXPECT_LE(result.most, 20.0 + miss + 0.1);
    EXPECT_GE(result.least, 20.0 - miss - 0.1);
  }
  for (const double factor : {0.8, 1.1}) {
    lang::JointFriction friction = rough;
    friction.presliding *= factor;
    for (const double stiffness : {1e4, 1e6}) {
      lang::Program walled = truth;
      walled.scene->objects.at(0).stiffness = stiffness;
      const Pressed result = pressed(walled, rubbing(walled, friction));
      std::printf("presliding in the file %.2f of the true one, wall %.0e N/m: %.2f to %.2f N\n", factor,
                  stiffness, result.least, result.most);
      EXPECT_NEAR(result.least, 20.0, 2.0);
      EXPECT_NEAR(result.most, 20.0, 2.0);
    }
  }
}

}  // namespace
}  // namespace zwang::runtime
