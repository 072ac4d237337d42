// The whole tick of the runtime, from the sample to the torques, on recorded runs: each tick's least time
// over many replays of the same recording. Beside it the same of the simulated plant's steps, timed after
// each replay, as machines have fast and slow minutes.
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
constexpr int replays = 25;

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

void time_steps(std::vector<double>& least) {
  const bench::Workload step = bench::mujoco_step();  // anew: it drives off faster and faster
  for (std::size_t i = 0; i < least.size(); ++i) {
    const auto start = Clock::now();
    step.call(i);
    least[i] = std::min(least[i], std::chrono::duration<double, std::micro>(Clock::now() - start).count());
  }
}

/// [us] of each tick and of each step, the least over the replays: what is left is their own work.
struct TickTimes {
  std::vector<double> ticks, steps;
};

TickTimes time_ticks(const lang::Program& program, const std::vector<runtime::Sensed>& samples) {
  TickTimes least;
  least.ticks.assign(samples.size(), 1e12);
  least.steps.assign(4000, 1e12);
  for (int replay = 0; replay < replays; ++replay) {
    runtime::Runner runner(program, {.period = period});
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const auto start = Clock::now();
      runner.step(samples[i]);
      const double time = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
      least.ticks[i] = std::min(least.ticks[i], time);
    }
    time_steps(least.steps);
  }
  return least;
}

/// Returns the median of the tick [us].
double print(const char* name, const std::string& task, const std::string& robot, double goal,
             bool has_share) {
  const lang::Program program = load(task, robot);
  const std::vector<runtime::Sensed> samples = record(program, 20'000);
  const TickTimes least = time_ticks(program, samples);
  const double tick = quantile(least.ticks, 0.5), step = quantile(least.steps, 0.5);
  std::printf("%-34s %6zu %8.2f %8.2f %8.2f %6.0f", name, least.ticks.size(), tick,
              quantile(least.ticks, 0.999), quantile(least.ticks, 1.0), goal);
  if (has_share)
    std::printf("  %4.0f %% of a step of %.2f us (goal 50, stretch 35)", 100.0 * tick / step, step);
  std::printf("\n");
  return tick;
}

}  // namespace

int main() {
  cpu_set_t core;
  CPU_ZERO(&core);
  CPU_SET(static_cast<std::size_t>(sched_getcpu()), &core);
  sched_setaffinity(0, sizeof(core), &core);
  std::printf("the tick, sample to torques [us]: least of %d replays of each tick\n", replays);
  std::printf("%-34s %6s %8s %8s %8s %6s\n", "task, robot", "ticks", "median", "p99.9", "worst", "goal");
  const double hospital = print("hospital, mecanum (4 wheels)", "hospital.yaml", "mecanum_base", 10.0, true);
  const double crowded =
      print("path, bearing, 2 yields, 16 sums", "laws/crowded.yaml", "mecanum_base", 1.5 * hospital, false);
  std::printf("%-34s %.2f x the hospital's tick (goal 1.5)\n", "", crowded / hospital);
  print("wall_align, mecanum (4 wheels)", "wall_align.yaml", "mecanum_base", 10.0, true);
  print("obstacle, mecanum with 7-joint arm", "obstacle.yaml", "mecanum_arm_base", 60.0, false);
  return 0;
}
