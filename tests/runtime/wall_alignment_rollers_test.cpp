// The main job on a base whose wheels are built of eighteen rollers each, which ripple, and which its
// controller takes for smooth ones.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "constants.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/mujoco_plant.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {
namespace {

lang::Program load() {
  lang::Diagnostics diagnostics;
  lang::LoadOptions options;
  options.scene = ZWANG_SOURCE_DIR "/specs/scenes/wall_far.yaml";
  const auto program = lang::load(ZWANG_SOURCE_DIR "/specs/wall_align.yaml", options, diagnostics);
  if (!program) throw std::runtime_error("specs/wall_align.yaml does not load");
  return *program;
}

TEST(RealRollers, AreAlignedByTheWallAndPressItWithTwentyNewtonsOnAverage) {
  for (const double yaw : {-20.0, 5.0, 20.0}) {
    const lang::Program program = load();
    MujocoPlant plant(program.robot, *program.scene,
                      {.period = period, .start_yaw = yaw * degree, .real_rollers = true});
    Runner runner(program);
    Sensed sensed(program.robot.model, program.signals.size());
    double in_plant = 0.0, force = 0.0, turned = 0.0;
    int pressed = 0;
    while (!runner.finished() && plant.truth().time < 30.0) {
      ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
      const Eigen::VectorXd& tau = runner.step(sensed);
      const int task = runner.scheduler().task();
      if (runner.state() == RunState::running && task == 1 && runner.scheduler().elapsed() > 1.0) {
        force += plant.truth().objects[0].force;
        ++pressed;
        turned = plant.truth().yaw;
      }
      const auto begin = std::chrono::steady_clock::now();
      ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
      in_plant += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    force /= std::max(pressed, 1);
    std::printf(
        "real rollers from %.0f deg: %.2f N on average, yaw %.3f deg, touched at %.1f s, plant %.1f x real "
        "time\n",
        yaw, force, turned / degree, plant.truth().objects[0].touched.value_or(-1.0),
        plant.truth().time / in_plant);
    EXPECT_EQ(runner.state(), RunState::done);
    EXPECT_NEAR(force, 20.0, 2.0);
    EXPECT_LT(std::abs(turned), 0.5 * degree);
  }
}

}  // namespace
}  // namespace zwang::runtime
