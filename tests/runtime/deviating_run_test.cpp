// Robots whose wheels are drawn a little beside their axles run like robots that are drawn exactly. The end,
// the path and the torques are the same, to the order of the deviation. The oracle is the exact robot's run.
// With ZWANG_LONG (`./dev test --long`) on every drive, with twenty deviations each.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../deviating_robot.hpp"
#include "../is_long.hpp"
#include "../temporary_folder.hpp"
#include "constants.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

constexpr test::DrawnDeviation most{1e-3, 0.5 * degree};

struct Ran {
  RunState state = RunState::running;
  double time = 0.0;
  double x = 0.0, y = 0.0, yaw = 0.0;
  double torque = 0.0;  // [N m] largest of a motor
};

Ran run(const std::filesystem::path& task, const std::filesystem::path& robot, const std::string& scene,
        double start_yaw) {
  lang::Diagnostics diagnostics;
  lang::LoadOptions load;
  load.root = "/";
  load.robot = robot;
  load.scene = ZWANG_SOURCE_DIR "/specs/scenes/" + scene + ".yaml";
  const auto program = lang::load(task, load, diagnostics);
  if (!program) throw std::runtime_error(task.string() + " does not load with " + robot.string());
  ScenePlantOptions options;
  options.simulation.start_yaw = start_yaw;
  options.simulation.period = SimulationSteps(program->robot.control_period).period();
  ScenePlant plant(*program, options);
  Runner runner(*program);
  Sensed sensed(program->robot.model, program->signals.size());
  Ran ran;
  while (!runner.finished() && plant.truth().time < 40.0) {
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    const Eigen::VectorXd& tau = runner.step(sensed);
    ran.torque = std::max(ran.torque, tau.lpNorm<Eigen::Infinity>());
    EXPECT_EQ(plant.apply(tau), PlantStatus::ok);
  }
  const Truth& truth = plant.truth();
  ran.state = runner.state();
  ran.time = truth.time;
  ran.x = truth.x, ran.y = truth.y, ran.yaw = truth.yaw;
  return ran;
}

struct Drive {
  const char* robot;
  bool holds_y;  // what does not move sideways is told to stand still, so that a nearly held axis would act
};

/// One second ahead at 0.1 m/s.
std::filesystem::path drive_ahead(const std::filesystem::path& folder, const Drive& drive) {
  std::ofstream(folder / "ahead.yaml")
      << "zwang: 1\nrobot: none.yaml\nstart: go\ntasks:\n  go:\n    constraints:\n"
      << "      ahead: {move: base_link, in: base_link, x: {velocity: 0.1 m/s}"
      << (drive.holds_y ? ", y: {velocity: 0 m/s}" : "") << "}\n"
      << "    timeout: {after: 1 s, goto: done}\n";
  return folder / "ahead.yaml";
}

void expect_as_exact(const Drive& drive, unsigned seeds) {
  const test::TemporaryFolder temporary;
  const auto task = drive_ahead(temporary.path(), drive);
  const std::filesystem::path shipped = ZWANG_SOURCE_DIR "/specs/robots";
  const Ran exact = run(task, shipped / (std::string(drive.robot) + ".yaml"), "open", 0.0);
  ASSERT_EQ(exact.state, RunState::done) << drive.robot;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(std::string(drive.robot) + ", seed " + std::to_string(seed));
    const test::TemporaryFolder folder;
    const auto robot = test::write_deviating_robot(folder.path(), drive.robot, most, seed);
    const Ran drawn = run(task, robot, "open", 0.0);
    EXPECT_EQ(drawn.state, RunState::done);
    // Half a degree askew is 1 % of the way aside; a track that is 1 mm of 100 mm shorter, 1 % of it ahead.
    const double way = std::abs(exact.x);
    EXPECT_NEAR(drawn.x, exact.x, 0.02 * way);
    EXPECT_NEAR(drawn.y, exact.y, 0.02 * way);
    EXPECT_NEAR(drawn.torque, exact.torque, 0.05 * exact.torque);
  }
}

constexpr Drive drives[] = {{"diff_base", true},       {"tricycle_base", true}, {"kelo_two_base", true},
                            {"mecanum_base", true},    {"omni_base", true},     {"kelo_base", true},
                            {"skid_base", false},      {"car_base", true},      {"swerve_base", true},
                            {"mecanum_arm_base", true}};

TEST(DeviatingRobots, DriveAsTheExactOnes) {
  const bool is_long = test::is_long();
  for (const Drive& drive : drives) {
    if (!is_long && &drive >= drives + 3) break;
    expect_as_exact(drive, is_long ? 20 : 1);
  }
}

// 13 um or 0.05 deg beside the axle once were a robot that could not turn: stopped for `torque_lost`.
TEST(DeviatingRobots, AreTurnedSquareByTheWall) {
  const std::filesystem::path task = ZWANG_SOURCE_DIR "/specs/wall_align.yaml";
  const bool is_long = test::is_long();
  for (unsigned seed = 0; seed < (is_long ? 20U : 1U); ++seed) {
    const test::TemporaryFolder folder;
    const auto robot = test::write_deviating_robot(folder.path(), "diff_base", most, seed);
    const Ran drawn = run(task, robot, "wall_far", (seed % 2 == 0 ? 20.0 : -18.0) * degree);
    EXPECT_EQ(drawn.state, RunState::done) << seed;
    EXPECT_LE(std::abs(drawn.yaw), 0.1 * degree) << seed;
  }
}

}  // namespace
}  // namespace zwang::runtime
