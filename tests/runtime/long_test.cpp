// Runs that do not end: no allocation in a million ticks, and memory that stays flat for ten hours. By
// default a short piece of each; with ZWANG_LONG in the environment (`./dev test --long`) all of it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "../is_long.hpp"
#include "../solver/malloc_counter.hpp"
#include "../temporary_folder.hpp"
#include "constants.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

lang::Program patrol() {
  lang::Diagnostics diagnostics;
  lang::LoadOptions options;
  options.root = ZWANG_SOURCE_DIR;
  options.robot = ZWANG_SOURCE_DIR "/specs/robots/mecanum_base.yaml";
  options.scene = ZWANG_SOURCE_DIR "/specs/scenes/wall_far.yaml";
  auto program = lang::load(ZWANG_SOURCE_DIR "/tests/runtime/patrol.yaml", options, diagnostics);
  if (!program) throw std::runtime_error("patrol.yaml does not load");
  program->scene->objects.clear();
  return *program;
}

/// [kB] resident now.
long resident() {
  std::ifstream statm("/proc/self/statm");
  long size = 0, pages = 0;
  statm >> size >> pages;
  return pages * 4;
}

/// The runner alone: what the plant allocates is the simulator's business.
TEST(Long, NoTickAllocates) {
  if (!test::can_count_heap_calls()) GTEST_SKIP() << "a sanitizer owns malloc";
  const long ticks = test::is_long() ? 1'000'000 : 30'000;
  const lang::Program program = patrol();
  ScenePlant plant(program);
  Runner runner(program, {.period = period});
  const zwang::test::TemporaryFolder folder;
  const std::filesystem::path log = folder.path() / "log.mcap";
  std::vector<std::unique_ptr<LogSink>> sinks;
  sinks.push_back(mcap_sink(log, {}));
  Recorder recorder(std::move(sinks), runner.columns());
  runner.record_to(&recorder);
  Sensed sensed(program.robot.model);
  long calls = 0;
  for (long i = 0; i < ticks; ++i) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    recorder.wait_for_room();
    test::start_counting_heap_calls();
    const Eigen::VectorXd& tau = runner.step(sensed);
    calls += test::stop_counting_heap_calls();
    ASSERT_EQ(plant.apply(tau), PlantStatus::ok);
  }
  recorder.close();
  std::printf("%ld ticks, %ld heap calls, %llu switches\n", ticks, calls,
              static_cast<unsigned long long>(runner.transition_count()));
  EXPECT_EQ(calls, 0);
  EXPECT_EQ(runner.state(), RunState::running);
  EXPECT_GT(runner.transition_count(), 1u);
}

TEST(Long, MemoryStaysFlat) {
  if (!test::can_count_heap_calls()) GTEST_SKIP() << "a sanitizer keeps what is freed";
  const double span = test::is_long() ? 36000.0 : 20.0;  // [s]
  const lang::Program program = patrol();
  ScenePlant plant(program);
  Runner runner(program, {.period = period});
  Sensed sensed(program.robot.model);
  long warm = 0;
  while (plant.truth().time < span) {
    ASSERT_EQ(plant.sense(sensed), PlantStatus::ok);
    ASSERT_EQ(plant.apply(runner.step(sensed)), PlantStatus::ok);
    if (warm == 0 && plant.truth().time >= 0.1 * span) warm = resident();
  }
  const long end = resident();
  std::printf("%.0f s simulated: %ld kB resident after a tenth, %ld kB at the end, %llu switches\n", span,
              warm, end, static_cast<unsigned long long>(runner.transition_count()));
  EXPECT_EQ(runner.state(), RunState::running);
  EXPECT_LE(end - warm, 256);
}

}  // namespace
}  // namespace zwang::runtime
