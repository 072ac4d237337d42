// Loops slower than 1 kHz, as most mobile bases have them, and faster ones, with the same tasks. The plant is
// the judge. Its steps stay 1 ms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "constants.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scenario_run.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

using lang::FaultKind;
using zwang::test::shipped_program;
using zwang::test::specs;

/// Takes the plant through one control period.
void hold(ScenePlant& plant, const SimulationSteps& steps, const Eigen::VectorXd& tau) {
  for (int i = 0; i < steps.per_tick(); ++i) ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
}

TEST(ControlPeriod, IsMadeOfStepsOfTheSimulationOf1MillisecondAtMost) {
  for (const auto& [period, per_tick] :
       {std::pair{0.5 * ms, 1}, {1.0 * ms, 1}, {2.0 * ms, 2}, {2.5 * ms, 3}, {10.0 * ms, 10}}) {
    const SimulationSteps steps(period);
    EXPECT_EQ(steps.per_tick(), per_tick) << period;
    EXPECT_DOUBLE_EQ(steps.per_tick() * steps.period(), period);
  }
}

TEST(ControlPeriod, IsTheRobotFilesUnlessTheHostSaysAnother) {
  lang::Program program = shipped_program("wall_align.yaml", "mecanum");
  EXPECT_EQ(Runner(program).period(), lang::default_control_period);
  program.robot.control_period = 4.0 * ms;
  EXPECT_EQ(Runner(program).period(), 4.0 * ms);
  EXPECT_EQ(Runner(program, {.period = 2.0 * ms}).period(), 2.0 * ms);
  EXPECT_THROW(Runner(program, {.period = 11.0 * ms}), std::invalid_argument);
  EXPECT_THROW(Runner(program, {.period = 0.0}), std::invalid_argument);
}

/// The means, the dwells and the step that may be compared are times: so are the 100 ms.
TEST(ControlPeriod, LeavesNoMotorThatFailsUnwatched) {
  struct Broken {
    const char *robot, *wheel, *task;
    FaultKind kind;
    EventCode code;
  };
  const Broken all[] = {
      {"mecanum", "front_left_wheel", "obstacle.yaml", FaultKind::torque_lost, EventCode::torque_lost},
      {"mecanum", "front_right_wheel", "obstacle.yaml", FaultKind::torque_flipped, EventCode::torque_flipped},
      {"mecanum", "front_left_wheel", "obstacle.yaml", FaultKind::torque_stuck, EventCode::torque_stuck},
      {"omni", "front_right_wheel", "obstacle.yaml", FaultKind::torque_flipped, EventCode::torque_flipped},
      {"diff", "left_wheel", "wall_align.yaml", FaultKind::torque_lost, EventCode::torque_lost},
      {"kelo", "front_left_left_hub", "obstacle.yaml", FaultKind::torque_lost, EventCode::torque_lost}};
  const double at = 0.1;  // [s]
  for (const double period : {0.5 * ms, 2.0 * ms, 2.5 * ms, 5.0 * ms, 10.0 * ms}) {
    for (const Broken& broken : all) {
      lang::Program program = shipped_program(broken.task, broken.robot);
      program.robot.control_period = period;
      const SimulationSteps steps(period);
      ScenePlantOptions options;
      options.simulation.period = steps.period();
      options.faults.push_back({.kind = broken.kind, .at = at, .joint = broken.wheel});
      ScenePlant plant(program, options);
      Runner runner(program);
      Sensed sensed(program.robot.model, program.signals.size());
      double found = -1.0;
      while (found < 0.0 && plant.truth().time < 3.0) {
        ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
        const Eigen::VectorXd tau = runner.step(sensed);
        if (runner.guard().stopped()) found = plant.truth().time - at;
        hold(plant, steps, tau);
      }
      const Event& event = runner.guard().stop_event();
      const std::string what = std::string(broken.robot) + ", " + broken.wheel + ", " +
                               std::to_string(period / ms) + " ms: " + to_string(event.code);
      std::printf("%s after %.0f ms\n", what.c_str(), 1e3 * found);
      EXPECT_GE(found, 0.0) << what;
      EXPECT_LE(found, 0.1 + 0.5 * period) << what;
      EXPECT_EQ(event.code, broken.code) << what;
    }
  }
}

/// As many samples as are 50 ms may be lost in a row, of any period four.
TEST(ControlPeriod, DoesNotMakeItLongerThatARobotIsBlind) {
  for (const auto& [period, lost] : {std::pair{1.0 * ms, 20}, {5.0 * ms, 10}, {10.0 * ms, 5}}) {
    lang::Program program = shipped_program("obstacle.yaml", "mecanum");
    program.robot.control_period = period;
    Runner runner(program);
    Sensed sensed(program.robot.model, program.signals.size());
    for (int i = 0; i < 10; ++i) {
      sensed.time = i * period;
      runner.step(sensed);
    }
    for (int i = 1; i < lost; ++i) {
      runner.step(sensed);  // the same once more: nothing came
      EXPECT_FALSE(runner.guard().stopped()) << period << " s, " << i;
    }
    runner.step(sensed);
    EXPECT_TRUE(runner.guard().stopped()) << period << " s";
  }
}

/// The expectations of the shipped scenarios hold with 100 ticks a second. The robot files do not give the
/// period. The plant's truth is checked every millisecond.
class AtTenMilliseconds : public testing::TestWithParam<const char*> {};

TEST_P(AtTenMilliseconds, TheScenarioHolds) {
  const std::string path = specs("scenarios/" + std::string(GetParam()) + ".yaml");
  lang::Diagnostics of_scenario, of_task;
  const auto scenario = lang::load_scenario(path, of_scenario);
  ASSERT_TRUE(scenario);
  auto run = lang::load_run(path, 0, of_scenario, of_task);
  ASSERT_TRUE(run && run->program);
  run->program->robot.control_period = 10.0 * ms;
  std::vector<std::string> codes;
  for (const lang::Diagnostic& d : of_task.all()) codes.push_back(d.code);
  const CellResult result = run_cell(*scenario, scenario->cells[0], *run, codes);
  for (const ExpectationResult& expected : result.expectations)
    EXPECT_TRUE(expected.held) << expected.text << ", is " << expected.value.value_or(0.0) << " "
                               << expected.unit;
  EXPECT_TRUE(result.passed) << result.outcome << " " << result.because;
}

INSTANTIATE_TEST_SUITE_P(Shipped, AtTenMilliseconds,
                         testing::Values("wall_align", "wall_align_casters", "obstacle_stays",
                                         "obstacle_corner", "docking_live", "hospital_diff", "boundary",
                                         "velocity_limit", "faults_of_motors", "faults_slip",
                                         "wall_align_soft"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace zwang::runtime
