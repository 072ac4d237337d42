// A logged run, computed again from what its log says came from outside.
#include "zwang/runtime/replay.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "../temporary_folder.hpp"
#include "constants.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/recorder.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

constexpr int ticks = 3000;
constexpr int change_at = 10;  // tick, long before the cruising speed hides how hard it is pushed

lang::Program wall_alignment() {
  lang::Diagnostics diagnostics;
  auto program = lang::load(ZWANG_SOURCE_DIR "/specs/wall_align.yaml", {}, diagnostics);
  if (!program) throw std::runtime_error("specs/wall_align.yaml does not load");
  return *program;
}

/// [m] where the base came to; the host sets `push` on the way, unless it is not positive.
solver::Vector3 run(
    const lang::Program& program, double push, const std::filesystem::path& log,
    const ScenePlantOptions& options = {},
    const std::function<void(int, Runner&)>& host = [](int, Runner&) {}) {
  ScenePlant plant(program, options);
  Runner runner(program, {.period = period});
  std::vector<std::unique_ptr<LogSink>> sinks;
  sinks.push_back(mcap_sink(log, {}));
  Recorder recorder(std::move(sinks), runner.columns());
  runner.record_to(&recorder);
  Sensed sensed(program.robot.model, program.signals.size());
  for (int i = 0; i < ticks; ++i) {
    if (i == change_at && push > 0.0) {
      EXPECT_TRUE(runner.set_parameter("push", push));
    }
    host(i, runner);
    recorder.wait_for_room();
    EXPECT_EQ(plant.sense(sensed), PlantStatus::ok);
    EXPECT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
  }
  recorder.close();
  EXPECT_TRUE(recorder.status().complete()) << recorder.status().error;
  return {plant.truth().x, plant.truth().y, 0.0};
}

TEST(Replay, KnowsTheParametersThatAHostSetDuringTheRun) {
  const test::TemporaryFolder folder;
  const lang::Program program = wall_alignment();
  const solver::Vector3 left_alone = run(program, 0.0, folder.path() / "left_alone.mcap");
  const solver::Vector3 changed = run(program, 35.0, folder.path() / "changed.mcap");
  EXPECT_GT((changed - left_alone).norm(), 0.001) << "a harder push gains speed sooner";
  for (const char* name : {"left_alone.mcap", "changed.mcap"}) {
    const ReplayResult result = replay(folder.path() / name, program, {.period = period});
    EXPECT_EQ(result.records, ticks);
    EXPECT_EQ(result.equal, result.records) << name;
  }
}

/// The columns of a record lead back to the author's words: an exit's timer and a parameter, too.
TEST(Replay, ColumnsOfExitsAndParametersHaveTheirLines) {
  const Runner runner(wall_alignment(), {.period = period});
  int exits = 0, parameters = 0;
  for (const Column& column : runner.columns()) {
    const bool is_exit = column.name.ends_with(".true_for");
    const bool is_parameter = column.name.starts_with("params.");
    if (!is_exit && !is_parameter) continue;
    EXPECT_TRUE(column.span.exists()) << column.name;
    EXPECT_GT(column.span.begin.line, 1) << column.name;
    (is_exit ? exits : parameters) += 1;
  }
  EXPECT_GE(exits, 2);
  EXPECT_EQ(parameters, 3) << "push, timeout, still";
}

TEST(Replay, KnowsWhenAHostResetTheStop) {
  const test::TemporaryFolder folder;
  const lang::Program program = wall_alignment();
  const std::filesystem::path log = folder.path() / "log.mcap";
  run(program, 0.0, log, {}, [](int tick, Runner& runner) {
    if (tick == 500) runner.guard().stop(EventCode::requested);
    if (tick == 1500) runner.guard().reset();
    if (tick == ticks - 1) {
      EXPECT_EQ(runner.state(), RunState::running);
    }
  });
  const ReplayResult result = replay(log, program, {.period = period});
  EXPECT_EQ(result.records, ticks);
  EXPECT_EQ(result.equal, result.records) << (result.first ? result.first->time : 0.0);
}

/// A slew that the host asks for, and the period, are among the facts of the log.
TEST(Replay, KnowsTheSettingsOfAHost) {
  const test::TemporaryFolder folder;
  const lang::Program program = wall_alignment();
  const std::filesystem::path log = folder.path() / "log.mcap";
  const RunnerSettings settings{.period = 2e-3, .max_slew = 0.5};
  Runner runner(program, settings);
  std::vector<std::unique_ptr<LogSink>> sinks;
  sinks.push_back(mcap_sink(log, {{}, runner.facts()}));
  Recorder recorder(std::move(sinks), runner.columns());
  runner.record_to(&recorder);
  Sensed sensed(program.robot.model, program.signals.size());
  for (int i = 1; i <= 50; ++i) {
    sensed.time = 2e-3 * i;
    runner.step(sensed);
  }
  recorder.close();
  const LogContext context = read_log(log, [](double, std::span<const double>) {}).context;
  EXPECT_EQ(context.facts.at("task"), program.path);
  EXPECT_EQ(context.facts.at("params.push"), "20");
  const RunnerSettings logged = logged_settings(context);
  EXPECT_EQ(logged.period, settings.period);
  EXPECT_EQ(logged.max_slew, settings.max_slew);
  EXPECT_EQ(replay(log, program, logged).equal, 50u);
  EXPECT_LT(replay(log, program, {.period = 2e-3}).equal, 50u) << "of another slew";
}

/// The brake leaves out a motor that is found at fault, and sends it 0 of either sign.
TEST(Replay, KnowsANegativeZeroFromZero) {
  const test::TemporaryFolder folder;
  const lang::Program program = wall_alignment();
  ScenePlantOptions options;
  options.faults.push_back(
      lang::Fault{.kind = lang::FaultKind::torque_lost, .at = 0.1, .joint = "front_left_wheel"});
  const std::filesystem::path log = folder.path() / "log.mcap";
  run(program, 0.0, log, options);
  const ReplayResult result = replay(log, program, {.period = period});
  EXPECT_EQ(result.records, ticks);
  EXPECT_EQ(result.equal, result.records);
}

}  // namespace
}  // namespace zwang::runtime
