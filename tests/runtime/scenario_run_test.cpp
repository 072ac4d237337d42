// Scenarios judged: what holds is said to hold, what does not is missed with its margin.
#include "zwang/runtime/scenario_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "../temporary_folder.hpp"
#include "scenario/steady_force.hpp"

namespace zwang::runtime {
namespace {

namespace fs = std::filesystem;

/// Half a metre a second, for half a second, in a room that ends 1 m ahead.
const char* const roomy = R"(zwang: 1
robot: robots/mecanum_base.yaml
scene: scenes/dock_live.yaml
regions:
  room: {polygon: [[-3 m, -2 m], [1 m, -2 m], [1 m, 2 m], [-3 m, 2 m]]}
always:
  constraints:
    fence: {move: footprint, inside: room}
start: go
tasks:
  go:
    constraints:
      ahead: {move: base_link, in: base_link, x: {velocity: 0.5 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: elapsed > 0.8 s, goto: done}]
)";

/// Runs the first cell of a scenario over the shipped wall alignment, or over the task `lamp`.
CellResult run_scenario(const std::string& text, const std::string& lamp = {}) {
  const zwang::test::TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  for (const char* name : {"robots/mecanum_base.yaml", "robots/mecanum_base.urdf", "robots/skid_base.yaml",
                           "robots/skid_base.urdf", "scenes/wall.yaml", "wall_align.yaml",
                           "scenes/dock_live.yaml", "scenes/open_noisy.yaml", "partners/hold_place.yaml"}) {
    fs::create_directories((folder / name).parent_path());
    fs::copy_file(fs::path(ZWANG_SOURCE_DIR "/specs") / name, folder / name);
  }
  std::ofstream(folder / ".zwang-root");
  std::ofstream(folder / "roomy.yaml") << roomy;
  if (!lamp.empty()) std::ofstream(folder / "lamp.yaml") << lamp;
  const char* const task = text.starts_with("task:") ? "" : "task: wall_align.yaml\n";
  std::ofstream(folder / "scenario.yaml") << "zwang_scenario: 1\n" << task << text;
  lang::Diagnostics of_scenario, of_task;
  const auto scenario = lang::load_scenario(folder / "scenario.yaml", of_scenario);
  const auto run = lang::load_run(folder / "scenario.yaml", 0, of_scenario, of_task);
  std::ostringstream words;
  lang::render_human(of_scenario, words);
  if (!scenario || !run) throw std::runtime_error(words.str());
  std::vector<std::string> codes;
  for (const lang::Diagnostic& d : of_task.all()) codes.push_back(d.code);
  return run_cell(*scenario, scenario->cells[0], *run, codes);
}

TEST(ScenarioRun, TheWallAlignmentKeepsWhatIsExpectedOfIt) {
  const CellResult result = run_scenario(R"(expect:
  - outcome: done
  - {at: end, that: abs(truth.wall.force - 20 N) < 0.2 N and abs(truth.base.yaw) < 0.1 deg}
  - {within: 3 s, of: truth.wall.touched, that: abs(truth.base.yaw) < 0.1 deg}
  - {always: speed(base_link) < 0.12 m/s}
  - {at: end, that: moved(base_link) > 0.4 m and elapsed > 5 s}
)");
  EXPECT_TRUE(result.passed);
  EXPECT_EQ(result.outcome, "done");
  for (const ExpectationResult& expected : result.expectations) EXPECT_TRUE(expected.held) << expected.text;
  ASSERT_TRUE(result.expectations[1].margin);
  EXPECT_GT(*result.expectations[1].margin, 0.5);
  // `within` says how long it took, of a share of 3 s the margin is the rest.
  ASSERT_TRUE(result.expectations[2].value);
  EXPECT_EQ(result.expectations[2].unit, "s");
  EXPECT_NEAR(*result.expectations[2].value, 3.0 * (1.0 - *result.expectations[2].margin), 1e-9);
  ASSERT_TRUE(result.expectations[3].value);
  EXPECT_EQ(result.expectations[3].unit, "m/s");
  EXPECT_NEAR(*result.expectations[3].value, 0.12 * (1.0 - *result.expectations[3].margin), 1e-12);
}

TEST(ScenarioRun, TheRobotStartsWhereTheCellSays) {
  const CellResult result = run_scenario(R"(start_at: [-0.3 m, 0.2 m]
start_yaw: 10 deg
time_limit: 0.1 s
expect:
  - {always: elapsed > 5 ms or abs(truth.base.x + 0.3 m) < 1 mm and abs(truth.base.y - 0.2 m) < 1 mm}
  - {always: elapsed > 5 ms or abs(truth.base.yaw - 10 deg) < 0.1 deg}
)");
  ASSERT_EQ(result.expectations.size(), 2u);
  for (const ExpectationResult& expected : result.expectations) {
    EXPECT_TRUE(expected.held) << expected.text;
    EXPECT_TRUE(expected.value) << "never asked";
  }
}

// `elapsed > ...` opens a window; outside of it nothing is asked, and nothing is a margin.
/// The lamp is set on the way to `done` alone, and `stop` puts it out with the brake.
TEST(ScenarioRun, WhatIsSetOnTheWayToTheEndIsSeenThere) {
  const std::string task = R"(zwang: 2
robot: robots/mecanum_base.yaml
outputs:
  lamp: {type: bool, stop: false}
  lift: {type: number, unit: m, start: 1 cm, stop: keep}
start: go
tasks:
  go:
    constraints: {ahead: {move: base, in: base, x: {velocity: 0.2 m/s}}}
    exits: [{when: moved(base) > 1 cm, for: 10 ms, goto: done, set: {outputs.lamp: true, outputs.lift: 3 cm}}]
    timeout: {after: 3 s, goto: failed}
)";
  const CellResult result = run_scenario(
      "task: lamp.yaml\nscene: scenes/wall.yaml\nexpect:\n"
      "  - outcome: done\n"
      "  - {at: end, that: truth.output.lamp}\n"
      "  - {within: 3 s, that: truth.output.lift > 2.9 cm}\n"
      "  - {within: 3 s, that: truth.output.lamp}\n"
      "  - {always: elapsed < 50 ms or truth.output.lamp}\n",
      task);
  for (const std::size_t expectation : {0u, 1u, 2u, 3u})
    EXPECT_TRUE(result.expectations[expectation].held) << expectation;
  EXPECT_FALSE(result.expectations[4].held);  // neither before it is set nor in the brake
}

TEST(ScenarioRun, AWindowOfTimeHasTheMarginOfWhatIsAskedInIt) {
  const CellResult result = run_scenario(R"(start_yaw: 0 deg
expect:
  - {always: elapsed < 1 s or truth.base.speed > 4 cm/s or elapsed > 2 s}
  - {always: not (elapsed > 1 s and elapsed < 2 s) or truth.base.x < 10 cm}
  - {always: elapsed < 500 s or truth.base.x < -1 m}
  - {always: elapsed < 100 s}
  - {always: 1 m > truth.base.x}
  - {at: end, that: truth.base.speed < 1 m/s and abs(truth.wall.force) < 40 N}
  - {always: 3 m - $push * 0.1 m / 1 N > truth.base.x}
)");
  ASSERT_EQ(result.expectations.size(), 7u);
  const std::vector<ExpectationResult>& expected = result.expectations;
  EXPECT_TRUE(expected[0].held);
  ASSERT_TRUE(expected[0].value);
  EXPECT_EQ(expected[0].unit, "m/s");
  EXPECT_NEAR(*expected[0].margin, *expected[0].value / 0.04 - 1.0, 1e-12);
  EXPECT_NEAR(*expected[1].margin, 1.0 - *expected[1].value / 0.10, 1e-12);
  EXPECT_NEAR(expected[1].time, 1.999, 2e-3) << "ever nearer, to the window's end";
  EXPECT_TRUE(expected[2].held);
  EXPECT_FALSE(expected[2].margin) << "never asked";
  EXPECT_NEAR(*expected[3].value, result.simulated, 2e-3) << "time alone is what is asked for";
  EXPECT_EQ(*expected[4].unit.c_str(), 'm') << "the side that may change";
  EXPECT_LT(*expected[4].value, 1.0);
  EXPECT_NEAR(*expected[4].margin, 1.0 - *expected[4].value, 1e-12) << "the threshold is 1 m, on either side";
  EXPECT_EQ(expected[6].unit, "m") << "3 m - 20 N * 0.1 m/N";
  EXPECT_NEAR(*expected[6].margin, 1.0 - *expected[6].value, 1e-12);
  EXPECT_EQ(expected[5].unit, "N") << "nearer to its limit";
  EXPECT_NEAR(*expected[5].value, 20.0, 0.1);
}

// Without `of` the time counts from the start. Whatever held before, it has to hold from then on.
TEST(ScenarioRun, WithinCountsFromItsTimeAndMeansToTheEnd) {
  const CellResult result = run_scenario(R"(expect:
  - {at: end, that: truth.wall.touched > 0 s}
  - {within: 3 s, of: truth.wall.touched, that: abs(truth.base.yaw) < 0.1 deg}
  - {within: 20 s, that: abs(truth.base.yaw) < 0.1 deg}
  - {within: 20 s, that: truth.base.x < 10 cm}
)");
  ASSERT_EQ(result.expectations.size(), 4u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(result.expectations[i].held) << i;
  EXPECT_NEAR(*result.expectations[2].value, *result.expectations[0].value + *result.expectations[1].value,
              1e-9);
  EXPECT_FALSE(result.expectations[3].held) << "it did at the start";
}

// A state that is told 1 cm/s wrong shakes beyond 5 mm/s at once; in 5 ms the 20 N make 2 mm/s of 60 kg.
TEST(ScenarioRun, IsJudgedByThePlantAndNotByWhatTheRobotIsTold) {
  const CellResult result = run_scenario(R"(scene: scenes/open_noisy.yaml
time_limit: 5 ms
expect: [{always: speed(base_link) < 5 mm/s}, {always: moved(base_link) < 0.05 mm}, {always: truth.base.speed < 5 mm/s}]
)");
  for (const ExpectationResult& expected : result.expectations) EXPECT_TRUE(expected.held) << expected.text;
}

TEST(ScenarioRun, ASteadyForceASwitchAndAnEntryHaveTheirFigures) {
  const CellResult smooth = run_scenario(R"(start_yaw: 0 deg
expect:
  - {at: end, that: abs(truth.wall.steady - 20 N) < 0.1 N}
  - {always: not (truth.wall.steady > 20.1 N)}
  - {at: end, that: run.entered.press < 1 ms and run.entered.hold > truth.wall.touched}
  - {within: 2.5 s, of: run.entered.hold, that: elapsed > run.entered.hold + 1 s}
  - {always: not (elapsed > run.entered.hold) or truth.base.x > 0.5 m}
)");
  for (const ExpectationResult& expected : smooth.expectations) EXPECT_TRUE(expected.held) << expected.text;
  // Of ten degrees the second corner hits later, and harder than the wall is pressed with.
  const CellResult hit = run_scenario(
      "start_yaw: 10 deg\nexpect:\n"
      "  - {at: end, that: truth.wall.peak > 100 N}\n"
      "  - {always: not (truth.wall.steady > 20.1 N)}\n");
  for (const ExpectationResult& expected : hit.expectations) EXPECT_TRUE(expected.held) << expected.text;
}

// A contact takes what the motors press with and what the base loses of its momentum, m dv / T.
TEST(SteadyForce, IsTheMeanOfHalfASecondInWhichTheBaseKeptItsSpeed) {
  const double mass = 50.0;
  const auto after = [&](double push, double swing, double braking, double length) {
    SteadyForce steady;
    for (int i = 0; i <= std::lround(1e3 * length); ++i) {
      const double time = 1e-3 * i, phase = 2.0 * std::numbers::pi * 10.0 * time;
      const double force = push + mass * braking + swing * std::sin(phase);
      const double velocity =
          -braking * time + swing / mass / (2.0 * std::numbers::pi * 10.0) * std::cos(phase);
      steady.look(force, true, {velocity, 0.0, 0.0}, time);
    }
    return steady.now();
  };
  ASSERT_TRUE(after(20.0, 0.0, 0.0, 0.5));
  EXPECT_NEAR(*after(20.0, 0.0, 0.0, 0.5), 20.0, 1e-9);
  EXPECT_NEAR(*after(20.0, 15.0, 0.0, 0.8), 20.0, 0.05) << "what rattles counts with its mean";
  EXPECT_FALSE(after(20.0, 0.0, 0.0, 0.45)) << "not for long enough";
  EXPECT_FALSE(after(20.0, 0.0, 0.002, 1.0)) << "it loses 1 mm/s in half a second";
  EXPECT_TRUE(after(20.0, 0.0, 0.0005, 1.0)) << "a quarter of that";
  SteadyForce interrupted;
  for (int i = 0; i <= 900; ++i) interrupted.look(20.0, i != 500, Eigen::Vector3d::Zero(), 1e-3 * i);
  EXPECT_FALSE(interrupted.now()) << "it let go in between";
}

/// The wall is 0.972 m ahead, the footprint's front 0.40 m: of a room that ends there nothing is left.
TEST(ScenarioRun, HowFarInsideOfARegionTheFootprintIs) {
  const CellResult result = run_scenario(R"(task: roomy.yaml
expect:
  - {always: elapsed > 1 ms or abs(truth.base.inside.room - 0.6 m) < 1 mm}
  - {at: end, that: abs(truth.base.inside.room - 1.0 m + 0.4 m + truth.base.x) < 0.1 mm and truth.base.x > 5 cm}
)");
  for (const ExpectationResult& expected : result.expectations) EXPECT_TRUE(expected.held) << expected.text;
}

TEST(ScenarioRun, AllChanceComesFromItsSeed) {
  const auto speed = [](const char* seed) {
    return *run_scenario("scene: scenes/open_noisy.yaml\ntime_limit: 0.2 s\nseed: " + std::string(seed) +
                         "\nexpect: [{always: truth.base.speed < 1 m/s}]\n")
                .expectations.at(0)
                .value;
  };
  const double first = speed("1");
  EXPECT_EQ(first, speed("1"));
  EXPECT_NE(first, speed("2"));
}

TEST(ScenarioRun, WhatDoesNotHoldIsMissedWithItsMargin) {
  const CellResult result = run_scenario(R"(expect:
  - outcome: failed
  - {at: end, that: truth.wall.force < 10 N}
  - {within: 10 ms, of: truth.wall.touched, that: abs(truth.base.yaw) < 0.1 deg}
  - {always: truth.base.speed < 0.04 m/s}
  - {within: 1 s, of: truth.wall.touched, that: truth.wall.force > 100 N}
  - {at: end, that: not truth.wall.force < 10 N}
)");
  EXPECT_FALSE(result.passed);
  ASSERT_EQ(result.expectations.size(), 6u);
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(result.expectations[static_cast<std::size_t>(i)].held) << i;
  EXPECT_NEAR(*result.expectations[1].margin, -1.0, 0.02) << "20 N where 10 N were allowed";
  EXPECT_LT(*result.expectations[2].margin, 0.0) << "square too late";
  EXPECT_LT(*result.expectations[3].margin, -0.95) << "0.08 m/s and more where 0.04 m/s were allowed";
  EXPECT_FALSE(result.expectations[4].margin) << "it never held to the end";
  EXPECT_TRUE(result.expectations[5].held);
}

TEST(ScenarioRun, ARefusedTaskHasItsCodes) {
  const CellResult refused =
      run_scenario("params: {push: 200 N}\nexpect: [{outcome: refused}, {diagnostic: E204}]\n");
  EXPECT_TRUE(refused.passed) << refused.because;
  const CellResult missed =
      run_scenario("robot: robots/skid_base.yaml\nexpect: [{outcome: done}, {diagnostic: E601}]\n");
  EXPECT_FALSE(missed.passed);
  EXPECT_FALSE(missed.expectations[0].held);
  EXPECT_FALSE(missed.expectations[1].held);
}

/// The shipped scene with a robot that holds its place, 1.8 m behind one that runs into nothing.
TEST(ScenarioRun, TheOutcomeOfAPartnerIsJudgedAsItsOwn) {
  const CellResult result = run_scenario(R"(scene: scenes/dock_live.yaml
time_limit: 0.5 s
expect:
  - outcome: unfinished
  - {outcome: unfinished, of: partner}
  - {always: abs(truth.partner.x + 1.8 m) < 5 mm and truth.partner.speed < 1 cm/s}
  - {always: truth.partner.stopped < 1 s}
  - {at: end, that: truth.partner.torque < 0.5}
)");
  ASSERT_EQ(result.expectations.size(), 5u);
  EXPECT_TRUE(result.expectations[0].held);
  EXPECT_TRUE(result.expectations[1].held);
  EXPECT_TRUE(result.expectations[2].held);
  EXPECT_FALSE(result.expectations[3].held) << "it never stopped";
  EXPECT_TRUE(result.expectations[4].held);
  ASSERT_EQ(result.partners.size(), 1u);
  EXPECT_EQ(result.partners[0].name, "partner");
  const CellResult other = run_scenario(
      "scene: scenes/dock_live.yaml\ntime_limit: 0.5 s\nexpect: [{outcome: done, of: partner}]\n");
  EXPECT_FALSE(other.expectations.at(0).held);
}

TEST(ScenarioRun, ARunThatGoesOnForTooLongIsUnfinished) {
  const CellResult result = run_scenario("time_limit: 0.5 s\nexpect: [{outcome: done}]\n");
  EXPECT_EQ(result.outcome, "unfinished");
  EXPECT_FALSE(result.passed);
  EXPECT_NEAR(result.simulated, 0.5, 1e-6);
}

TEST(ScenarioRun, APlantThatFailsIsNeverAPass) {
  const CellResult result = run_scenario(R"(faults: {broken: [{at: 1 s, plant: diverges}]}
matrix: {faults: [broken]}
expect: [{outcome: done}]
)");
  EXPECT_EQ(result.outcome, "diverged");
  EXPECT_FALSE(result.passed);
}

/// `press` is entered once, and the wall is not touched yet: both figures equal their thresholds.
TEST(ScenarioRun, EqualValuesAreNeitherAboveNorBelow) {
  for (const std::string comparison : {"entries(press) OP 1", "truth.wall.peak OP 0 N"}) {
    for (const std::string op : {"<", ">", "<=", ">="}) {
      std::string that = comparison;
      that.replace(that.find("OP"), 2, op);
      const CellResult result =
          run_scenario("time_limit: 0.3 s\nexpect:\n  - {at: end, that: " + that + "}\n  - {always: " + that +
                       "}\n  - {at: end, that: not (" + that + ")}\n");
      const bool may_be_equal = op.ends_with("=");
      ASSERT_EQ(result.expectations.size(), 3u);
      EXPECT_EQ(result.expectations[0].held, may_be_equal) << that;
      EXPECT_EQ(result.expectations[1].held, may_be_equal) << that;
      EXPECT_EQ(result.expectations[2].held, !may_be_equal) << that;
      EXPECT_EQ(result.expectations[0].margin, 0.0) << that;
    }
  }
}

TEST(ScenarioRun, WhatCannotBeSimulatedHoldsNothing) {
  std::string without_scene = roomy;
  without_scene.erase(without_scene.find("scene: "), std::string("scene: scenes/dock_live.yaml\n").size());
  const CellResult result = run_scenario(
      "task: lamp.yaml\nexpect: [{diagnostic: W302}, {at: end, that: elapsed < 1 h}]\n", without_scene);
  EXPECT_EQ(result.outcome, "error");
  EXPECT_FALSE(result.passed);
}

/// 5 kg of payload, and 20 kg from 0.1 s on: the base of 46 kg weighs 66 kg.
TEST(ScenarioRun, OfTwoFaultsOfAKindTheLaterOneActs) {
  const CellResult result = run_scenario(R"(time_limit: 0.3 s
faults: {load: [{at: 0 s, payload: 5 kg}, {at: 0.1 s, payload: 20 kg}]}
matrix: {faults: [load]}
expect: [{at: end, that: abs(truth.base.mass - 66 kg) < 1 g}]
)");
  EXPECT_TRUE(result.passed) << result.expectations.front().value.value_or(0.0);
}

TEST(ScenarioRun, AFaultOfAMotorThatTheRobotDoesNotHaveIsSaidBeforeItRuns) {
  const char* text = R"(faults: {broken: [{at: 1 s, wheel: left_wheel, torque: lost}]}
matrix: {faults: [broken]}
expect: [{outcome: done}]
)";
  try {
    run_scenario(text);
    ADD_FAILURE() << "it ran";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("E301: no joint with a motor named `left_wheel`"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace zwang::runtime
