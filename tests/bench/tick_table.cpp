// The whole tick of the runtime, from the sample to the torques, on recorded runs.
//
// Times are each tick's least over many replays of one recording: what is left is the tick's own work. The
// plant's steps are timed the same way between the replays, as machines have fast and slow minutes. Counts
// are callgrind's inside Runner::step, over the same recordings. `tick_table` fails where a goal is missed.
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "../temporary_folder.hpp"
#include "count_instructions.hpp"
#include "real_time.hpp"
#include "tick_cases.hpp"
#include "workload.hpp"
#include "zwang/runtime/recorder.hpp"
#include "zwang/runtime/replay.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace {

using namespace zwang;
using Clock = std::chrono::steady_clock;

constexpr double period = 1e-3;
constexpr int replays = 25;
constexpr std::size_t no_end = 1'000'000;
constexpr std::size_t ticks_to_count = 2000;  // of a made task: it does the same on each
constexpr std::size_t ticks_between_reloads = 5000;

bool all_good = true;

/// "goal 38, MISSED" where the figure is above it.
std::string judged(double figure, double goal) {
  const bool is_good = figure <= goal;
  all_good = all_good && is_good;
  char text[64];
  std::snprintf(text, sizeof(text), "goal %g%s", goal, is_good ? ", pass" : ", MISSED");
  return text;
}

/// Runs the task on its plant. `log`: a file that takes the records, too.
std::vector<runtime::Sensed> record(const lang::Program& program, std::size_t most,
                                    const std::string& log = "") {
  runtime::ScenePlant plant(program);
  runtime::Runner runner(program, {.period = period});
  std::unique_ptr<runtime::Recorder> recorder;
  if (!log.empty()) {
    std::vector<std::unique_ptr<runtime::LogSink>> sinks;
    sinks.push_back(runtime::mcap_sink(log, {}));
    recorder = std::make_unique<runtime::Recorder>(std::move(sinks), runner.columns());
    runner.record_to(recorder.get());
  }
  std::vector<runtime::Sensed> samples;
  runtime::Sensed sensed(program.robot.model, program.signals.size());
  while (samples.size() < most && !runner.finished()) {
    if (plant.sense(sensed) != runtime::PlantStatus::ok) break;
    samples.push_back(sensed);
    if (recorder) recorder->wait_for_room();
    if (plant.apply(runner.step(sensed)) != runtime::PlantStatus::ok) break;
  }
  if (recorder) recorder->close();
  return samples;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// [us] of each tick and of each step, the least over the replays.
struct TickTimes {
  std::vector<double> ticks, steps;
};

void time_steps(std::vector<double>& least) {
  const bench::Workload step = bench::mujoco_step();  // anew: it drives off faster and faster
  for (std::size_t i = 0; i < least.size(); ++i) {
    const auto start = Clock::now();
    step.call(i);
    least[i] = std::min(least[i], std::chrono::duration<double, std::micro>(Clock::now() - start).count());
  }
}

/// Parameters are set again now and then, as a host does: the next tick computes all values anew.
void reload_parameters(const lang::Program& program, runtime::Runner& runner) {
  for (std::size_t i = 0; i < program.parameters.size(); ++i)
    runner.set_parameter(program.parameters[i].name, runner.scheduler().parameters()[i]);
}

TickTimes time_ticks(const lang::Program& program, const std::vector<runtime::Sensed>& samples) {
  TickTimes least;
  least.ticks.assign(samples.size(), 1e12);
  least.steps.assign(4000, 1e12);
  for (int replay = 0; replay < replays; ++replay) {
    runtime::Runner runner(program, {.period = period});
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (i % ticks_between_reloads == ticks_between_reloads - 1) reload_parameters(program, runner);
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
double print_times(const char* name, double most_us, std::optional<double> most_of_median) {
  const lang::Program program = bench::program_of(name);
  const TickTimes least = time_ticks(program, record(program, no_end));
  const double tick = quantile(least.ticks, 0.5), step = quantile(least.steps, 0.5);
  const auto worst = std::max_element(least.ticks.begin(), least.ticks.end());
  std::printf("%-12s %7zu %8.2f %8.2f %8.2f at %7.3f s   median %s; ", name, least.ticks.size(), tick,
              quantile(least.ticks, 0.999), *worst,
              period * static_cast<double>(std::distance(least.ticks.begin(), worst)),
              judged(tick, most_us).c_str());
  std::printf("worst %.1f medians", *worst / tick);
  if (most_of_median) std::printf(", %s", judged(*worst / tick, *most_of_median).c_str());
  std::printf("; %.0f %% of a step of %.2f us\n", 100.0 * tick / step, step);
  std::fflush(stdout);
  return tick;
}

/// Instructions of a tick, the mean of all of a recording.
std::optional<double> count_of(const std::string& program_file, const std::string& name, std::size_t most) {
  const test::TemporaryFolder folder;
  const std::string log = folder.path() / "log.mcap";
  const std::size_t ticks = record(bench::program_of(name), most, log).size();
  const auto total = bench::count_instructions("'" + program_file + "' --replay '" + log + "' '" + name + "'",
                                               "zwang::runtime::Runner::step(*");
  if (!total) return std::nullopt;
  return *total / static_cast<double>(ticks);
}

void print_count(const std::string& program_file, const char* name, std::size_t most, double goal) {
  const std::optional<double> count = count_of(program_file, name, most);
  if (!count) return;
  std::printf("%-16s %7.1fk   %s\n", name, 1e-3 * *count, judged(1e-3 * *count, goal).c_str());
  std::fflush(stdout);
}

void print_growth(const std::string& program_file, const char* of, const std::vector<int>& sizes) {
  std::printf("%-9s", of);
  for (const int size : sizes) {
    const auto count = count_of(program_file, std::to_string(size) + " " + of, ticks_to_count / 4);
    if (count) std::printf("  %d: %.1fk", size, 1e-3 * *count);
    std::fflush(stdout);
  }
  std::printf("\n");
}

void stay_on_one_core() {
  cpu_set_t core;
  CPU_ZERO(&core);
  CPU_SET(static_cast<std::size_t>(sched_getcpu()), &core);
  sched_setaffinity(0, sizeof(core), &core);
}

int replay(const char* log, const char* name) {
  const runtime::ReplayResult result = runtime::replay(log, bench::program_of(name), {.period = period});
  return result.equal == result.records && result.records > 0 ? 0 : 1;
}

void print_all_times() {
  std::printf("the tick, sample to torques [us]: least of %d replays of each tick\n", replays);
  std::printf("%-12s %7s %8s %8s %8s\n", "task", "ticks", "median", "p99.9", "worst");
  const double hospital = print_times("hospital", 10.0, 2.5);
  const double crowded = print_times("crowded", 15.0, std::nullopt);
  std::printf("%-12s %.2f x the hospital's tick, %s\n", "", crowded / hospital,
              judged(crowded / hospital, 1.5).c_str());
  print_times("wall_align", 10.0, std::nullopt);
  print_times("obstacle", 60.0, std::nullopt);
}

void print_real_time() {
  const lang::Program program = bench::program_of("hospital");
  const bench::RealTimeRun run = bench::run_in_real_time(program, record(program, 20'000));
  std::printf("\na runner at 1 kHz, %s, %zu ticks of the hospital after the first second [us]\n",
              run.has_priority ? "SCHED_FIFO" : "no SCHED_FIFO here", run.steps.size());
  std::printf("%-12s p50 %6.1f  p99.9 %6.1f  worst %6.1f\n", "step", quantile(run.steps, 0.5),
              quantile(run.steps, 0.999), quantile(run.steps, 1.0));
  std::printf("%-12s p50 %6.1f  p99.9 %6.1f  worst %6.1f\n", "probe", quantile(run.probes, 0.5),
              quantile(run.probes, 0.999), quantile(run.probes, 1.0));
  std::printf("%-12s %ld, %s\n", "heap calls", run.heap_calls,
              judged(static_cast<double>(run.heap_calls), 0.0).c_str());
  if (!run.has_locked_pages) return;
  std::printf("%-12s %ld, %s\n", "page faults", run.page_faults,
              judged(static_cast<double>(run.page_faults), 0.0).c_str());
}

void print_all_counts(const std::string& program_file) {
  std::printf("\ninstructions of a tick, mean of all ticks, by callgrind\n");
  print_count(program_file, "hospital", no_end, 38.0);
  print_count(program_file, "16 groups", ticks_to_count, 70.0);
  print_count(program_file, "256 exits", ticks_to_count, 90.0);
  print_count(program_file, "1000 vertices", ticks_to_count, 80.0);
  std::printf("\nhow it grows\n");
  print_growth(program_file, "groups", {1, 2, 4, 8, 16, 32});
  print_growth(program_file, "exits", {1, 16, 64, 256});
  print_growth(program_file, "vertices", {4, 16, 64, 250, 1000});
  print_growth(program_file, "tasks", {1, 10, 100, 250});
  print_growth(program_file, "wheels", {2, 3, 4, 8});
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 4 && std::strcmp(arguments[1], "--replay") == 0) return replay(arguments[2], arguments[3]);
  stay_on_one_core();
  const bool counts_alone = count == 2 && std::strcmp(arguments[1], "--counts") == 0;
  const bool loop_alone = count == 2 && std::strcmp(arguments[1], "--loop") == 0;
  const bool times_alone = count == 2 && std::strcmp(arguments[1], "--times") == 0;
  if (!counts_alone && !loop_alone) print_all_times();
  if (!counts_alone && !times_alone) print_real_time();
  if (!times_alone && !loop_alone) print_all_counts(arguments[0]);
  return all_good ? 0 : 1;
}
