/// A run of a program on its simulated robot, with a log beside it and an eye on the heap.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "../solver/malloc_counter.hpp"
#include "../temporary_folder.hpp"
#include "zwang/runtime/recorder.hpp"
#include "zwang/runtime/replay.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::test {

/// Writes `ticks` records into `log`; a host stops the run at the tick `stopped_at`. `calls`: of the heap, by
/// all steps of the runner together.
inline void record_run(const lang::Program& program, const std::filesystem::path& log, int ticks, long& calls,
                       int stopped_at = -1) {
  runtime::ScenePlant plant(program);
  runtime::Runner runner(program);
  std::vector<std::unique_ptr<runtime::LogSink>> sinks;
  sinks.push_back(runtime::mcap_sink(log, {}));
  runtime::Recorder recorder(std::move(sinks), runner.columns());
  runner.record_to(&recorder);
  runtime::Sensed sensed(program);
  for (int i = 0; i < ticks; ++i) {
    recorder.wait_for_room();
    if (i == stopped_at) runner.guard().stop(runtime::EventCode::requested);
    ASSERT_EQ(plant.sense(sensed), runtime::PlantStatus::ok);
    start_counting_heap_calls();
    runner.step(sensed);
    calls += stop_counting_heap_calls();
    ASSERT_EQ(plant.follow(runner.command()), runtime::PlantStatus::ok);
  }
  recorder.close();
}

/// The runner's steps make no call of the heap, and the log of `ticks` replays to the last bit.
inline void expect_replay_without_heap_calls(const lang::Program& program, int ticks, int stopped_at = -1) {
  const TemporaryFolder folder;
  const std::filesystem::path log = folder.path() / "log.mcap";
  long calls = 0;
  record_run(program, log, ticks, calls, stopped_at);
  EXPECT_EQ(calls, 0);
  const runtime::ReplayResult result = runtime::replay(log, program, {});
  EXPECT_EQ(result.records, ticks);
  EXPECT_EQ(result.equal, result.records);
}

}  // namespace zwang::test
