/// A run of a program on its simulated robot, with a log beside it and an eye on the heap.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "../solver/malloc_counter.hpp"
#include "zwang/runtime/recorder.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::test {

/// Writes `ticks` records into `log`. `calls`: of the heap, by all steps of the runner together.
inline void record_run(const lang::Program& program, const std::filesystem::path& log, int ticks,
                       long& calls) {
  runtime::ScenePlant plant(program);
  runtime::Runner runner(program);
  std::vector<std::unique_ptr<runtime::LogSink>> sinks;
  sinks.push_back(runtime::mcap_sink(log, {}));
  runtime::Recorder recorder(std::move(sinks), runner.columns());
  runner.record_to(&recorder);
  runtime::Sensed sensed(program);
  for (int i = 0; i < ticks; ++i) {
    recorder.wait_for_room();
    ASSERT_EQ(plant.sense(sensed), runtime::PlantStatus::ok);
    start_counting_heap_calls();
    runner.step(sensed);
    calls += stop_counting_heap_calls();
    ASSERT_EQ(plant.follow(runner.command()), runtime::PlantStatus::ok);
  }
  recorder.close();
}

}  // namespace zwang::test
