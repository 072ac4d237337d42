// The whole tick of the runtime, from the sample to the torques, on recorded runs: each tick's least time
// over several replays of the same recording. Beside it one step of the simulated plant, timed after each
// replay, as machines have fast and slow minutes: the share is the median of the replays' own.
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "workload.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace {

using namespace zwang;
using Clock = std::chrono::steady_clock;

constexpr double period = 1e-3;
constexpr int replays = 5;

lang::Program load(const std::string& task, const std::string& robot) {
  lang::Diagnostics diagnostics;
  lang::LoadOptions options;
  options.robot = ZWANG_SOURCE_DIR "/specs/robots/" + robot + ".yaml";
  auto program = lang::load(std::string(ZWANG_SOURCE_DIR "/specs/") + task, options, diagnostics);
  if (!program) {
    std::fprintf(stderr, "%s does not load with %s\n", task.c_str(), robot.c_str());
    std::exit(1);
  }
  return *program;
}

std::vector<runtime::Sensed> record(const lang::Program& program, std::size_t most) {
  runtime::ScenePlant plant(program);
  runtime::Runner runner(program, {.period = period});
  std::vector<runtime::Sensed> samples;
  runtime::Sensed sensed(program.robot.model, program.signals.size());
  while (samples.size() < most && !runner.finished()) {
    if (plant.sense(sensed) != runtime::PlantStatus::ok) break;
    samples.push_back(sensed);
    if (plant.apply(runner.step(sensed)) != runtime::PlantStatus::ok) break;
  }
  return samples;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// [us] of one step now, the median of many.
double step_time() {
  static const bench::Workload step = bench::mujoco_step();
  std::vector<double> times;
  for (std::size_t i = 0; i < 4000; ++i) {
    const auto start = Clock::now();
    step.call(i);
    times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
  }
  return quantile(times, 0.5);
}

struct TickTimes {
  std::vector<double> least;   ///< [us] of each tick over the replays: what is left is the tick's own work
  std::vector<double> shares;  ///< by replay: its median tick beside a step right after it
  std::vector<double> steps;   ///< [us] by replay
};

TickTimes time_ticks(const lang::Program& program, const std::vector<runtime::Sensed>& samples) {
  TickTimes times;
  times.least.assign(samples.size(), 1e12);
  std::vector<double> of_replay(samples.size());
  for (int replay = 0; replay < replays; ++replay) {
    runtime::Runner runner(program, {.period = period});
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const auto start = Clock::now();
      runner.step(samples[i]);
      of_replay[i] = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
      times.least[i] = std::min(times.least[i], of_replay[i]);
    }
    times.steps.push_back(step_time());
    times.shares.push_back(quantile(of_replay, 0.5) / times.steps.back());
  }
  return times;
}

void print(const char* name, const std::string& task, const std::string& robot, double goal, bool has_share) {
  const lang::Program program = load(task, robot);
  const std::vector<runtime::Sensed> samples = record(program, 20'000);
  const TickTimes times = time_ticks(program, samples);
  std::printf("%-34s %6zu %8.2f %8.2f %8.2f %6.0f", name, times.least.size(), quantile(times.least, 0.5),
              quantile(times.least, 0.999), quantile(times.least, 1.0), goal);
  if (has_share)
    std::printf("  %4.0f %% of a step of %.2f us (goal 50, stretch 35)", 100.0 * quantile(times.shares, 0.5),
                quantile(times.steps, 0.5));
  std::printf("\n");
}

}  // namespace

int main() {
  cpu_set_t core;
  CPU_ZERO(&core);
  CPU_SET(static_cast<std::size_t>(sched_getcpu()), &core);
  sched_setaffinity(0, sizeof(core), &core);
  std::printf("the tick, sample to torques [us]: least of %d replays of each tick\n", replays);
  std::printf("%-34s %6s %8s %8s %8s %6s\n", "task, robot", "ticks", "median", "p99.9", "worst", "goal");
  print("hospital, mecanum (4 wheels)", "hospital.yaml", "mecanum_base", 10.0, true);
  print("wall_align, mecanum (4 wheels)", "wall_align.yaml", "mecanum_base", 10.0, true);
  print("obstacle, mecanum with 7-joint arm", "obstacle.yaml", "mecanum_arm_base", 60.0, false);
  return 0;
}
