// The cost of one call of the solver, beside its peers: `solver_table`, or `./dev bench`.
//
// Google Benchmark times the calls, in repetitions of all of them in a random order, on one core. So other
// load of the machine falls on all alike. A ratio is that of two medians of one run. Outside the timed part:
// building models, workspaces and states. Instruction counts (callgrind, where valgrind is installed) do not
// depend on the machine's load: they are the difference of two runs of different length. Goals are judged by
// counts where there are any, by times else; `solver_table` fails where one is missed.
#include <benchmark/benchmark.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "count_instructions.hpp"
#include "workload.hpp"

namespace {

using zwang::bench::Workload;
using Clock = std::chrono::steady_clock;

constexpr int repetitions = 25;
constexpr double seconds_a_repetition = 0.01;

double median(std::vector<double> numbers) {
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

/// CPU times of the repetitions [ns a call], by benchmark.
using Times = std::map<std::string, std::vector<double>>;

/// Keeps the times; the tables are printed when all are there.
class Keeper : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration)
        times[run.run_name.function_name].push_back(run.GetAdjustedCPUTime());
    }
  }
  Times times;
};

void add_benchmark(const Workload& work) {
  benchmark::RegisterBenchmark(work.name.c_str(),
                               [work](benchmark::State& state) {
                                 std::size_t i = 0;
                                 for (auto _ : state) work.call(i++);
                               })
      ->Repetitions(repetitions)
      ->MinTime(seconds_a_repetition);
}

bool all_good = true;

/// Instructions of a call; nothing without valgrind.
std::optional<double> instructions(const std::string& program, const std::string& name) {
  double totals[2] = {};
  const int calls[2] = {zwang::bench::state_count, 5 * zwang::bench::state_count};
  for (int k = 0; k < 2; ++k) {
    const auto total = zwang::bench::count_instructions("'" + program + "' --repeat '" + name + "' " +
                                                        std::to_string(calls[k]));
    if (!total) return std::nullopt;
    totals[k] = *total;
  }
  return (totals[1] - totals[0]) / (calls[1] - calls[0]);
}

std::string in_thousands(const std::optional<double>& count) {
  if (!count) return "-";
  char text[32];
  std::snprintf(text, sizeof(text), "%.1fk", 1e-3 * *count);
  return text;
}

/// `work` beside `peer`; the ratio is peer over work, or work over peer where the goal is a share.
struct Comparison {
  Workload work, peer;
  bool as_share = false;
  const char* says = "";
  std::optional<double> goal = {};  ///< the most of a share, the least of a ratio
};

std::vector<Comparison> comparisons() {
  using namespace zwang::bench;
  std::vector<Comparison> all;
  // By time 6 is the goal. An instruction of KDL's takes longer than one of ours, so that 5 of them say as
  // much.
  for (const int rows : {1, 3, 6}) {
    all.push_back({arm_zwang(rows), arm_kdl(rows), false, "times as fast",
                   rows == 6 ? std::optional(5.0) : std::nullopt});
  }
#ifdef ZWANG_BENCH_PINOCCHIO
  all.push_back({arm_zwang(6), arm_pinocchio(), false, "times as fast", 2.0});
#endif
  // Nothing of this base stays from call to call: it is the row that does not profit from round wheels.
  all.push_back({eccentric_base_full(), eccentric_base_rows(), true, "of our own unbounded call", 2.0});
  all.push_back({base_full(), base_rows(), true, "of the same with what round wheels keep, most of it"});
  all.push_back({mobile_arm_full(), mobile_arm_rows(), true, "of our own unbounded call", 2.0});
#ifdef ZWANG_BENCH_MUJOCO
  all.push_back({base_full(), mujoco_step(), true, "of a step", 0.35});
  all.push_back({base_with_rows(), mujoco_step(), true, "of a step"});
  all.push_back({base_tick(), mujoco_step(), true, "of a step"});
#endif
  return all;
}

void print_comparisons(const std::string& program, const std::vector<Comparison>& all, const Times& times) {
  std::printf("%-28s %11s %8s   %-31s %11s %8s   %6s\n", "zwang", "median", "instr", "beside", "median",
              "instr", "ratio");
  for (const Comparison& c : all) {
    const auto ours = times.find(c.work.name);
    const auto theirs = times.find(c.peer.name);
    if (ours == times.end() || theirs == times.end()) continue;  // left out by --benchmark_filter
    const double a = median(ours->second);
    const double b = median(theirs->second);
    const std::optional<double> work = instructions(program, c.work.name);
    const std::optional<double> peer = instructions(program, c.peer.name);
    const auto ratio = [&](double ours_is, double theirs_is) {
      return c.as_share ? ours_is / theirs_is : theirs_is / ours_is;
    };
    std::printf("%-28s %8.0f ns %8s   %-31s %8.0f ns %8s   %6.2f  %s", c.work.name.c_str(), a,
                in_thousands(work).c_str(), c.peer.name.c_str(), b, in_thousands(peer).c_str(), ratio(a, b),
                c.says);
    if (c.goal) {
      const bool is_counted = work && peer;
      const double judged = is_counted ? ratio(*work, *peer) : ratio(a, b);
      const bool is_good = c.as_share ? judged <= *c.goal : judged >= *c.goal;
      all_good = all_good && is_good;
      std::printf("; by %s %.2f, goal %g%s", is_counted ? "instructions" : "time", judged, *c.goal,
                  is_good ? ", pass" : ", MISSED");
    }
    std::printf("\n");
    std::fflush(stdout);
  }
  std::printf("\na call of                    does\n");
  std::vector<std::string> said;
  for (const Comparison& c : all) {
    for (const Workload& work : {c.work, c.peer}) {
      if (std::find(said.begin(), said.end(), work.name) != said.end()) continue;
      said.push_back(work.name);
      std::printf("%-28s %s\n", work.name.c_str(), work.includes.c_str());
    }
  }
}

constexpr int growing_links[] = {8, 16, 32, 64, 128, 256};
constexpr int growing_rows[] = {1, 2, 3, 6, 12, 18, 24};

void add_growth() {
  for (const int links : growing_links) add_benchmark(zwang::bench::chain(links, 6));
  for (const int rows : growing_rows) {
    if (rows != 6) add_benchmark(zwang::bench::chain(24, rows));
  }
  add_benchmark(zwang::bench::chain(24, 6));
}

/// Slope of log cost over log links.
class Exponent {
 public:
  void add(double links, double cost) {
    const double x = std::log(links);
    const double y = std::log(cost);
    n_ += 1.0;
    sx_ += x;
    sy_ += y;
    sxx_ += x * x;
    sxy_ += x * y;
  }
  double value() const { return (n_ * sxy_ - sx_ * sy_) / (n_ * sxx_ - sx_ * sx_); }

 private:
  double n_ = 0.0, sx_ = 0.0, sy_ = 0.0, sxx_ = 0.0, sxy_ = 0.0;
};

/// The least of the repetitions: for a law of growth, whatever else the machine does is an error that only
/// adds.
void print_growth(const std::string& program, const Times& times) {
  const auto least = [&times](const std::string& name) {
    const std::vector<double>& all = times.at(name);
    return *std::min_element(all.begin(), all.end());
  };
  if (times.count(zwang::bench::chain_name(growing_links[0], 6)) == 0) return;
  std::printf("\nleast of %d repetitions\nlinks (6 rows):  ", repetitions);
  Exponent by_time, by_count;
  std::string counts;
  for (const int links : growing_links) {
    const std::string name = zwang::bench::chain_name(links, 6);
    std::printf(" %d: %.0f ns ", links, least(name));
    by_time.add(links, least(name));
    if (const std::optional<double> count = instructions(program, name)) {
      by_count.add(links, *count);
      char text[64];
      std::snprintf(text, sizeof(text), " %d: %.0f ", links, *count);
      counts += text;
    }
  }
  std::printf(" exponent %.2f (goal 1.0 +- 0.1)\n", by_time.value());
  if (!counts.empty()) std::printf("  instructions:  %s exponent %.2f\n", counts.c_str(), by_count.value());
  std::printf("rows (24 links): ");
  for (const int rows : growing_rows) {
    std::printf(" %d: %.0f ns ", rows, least(zwang::bench::chain_name(24, rows)));
  }
  std::printf("\n");
}

/// The same recording five times, the least time of each step: what is left is the step's own work.
void print_worst_step(const Workload& work) {
  constexpr int replays = 5;
  std::vector<double> least(zwang::bench::state_count, 1e9);
  for (int replay = 0; replay < replays; ++replay) {
    for (std::size_t i = 0; i < least.size(); ++i) {
      const auto start = Clock::now();
      work.call(i);
      least[i] = std::min(least[i], std::chrono::duration<double, std::nano>(Clock::now() - start).count());
    }
  }
  const double worst = *std::max_element(least.begin(), least.end());
  std::printf("%-28s worst step %.2f times the median (%.0f ns); goal 2\n", work.name.c_str(),
              worst / median(least), median(least));
}

int repeat(const std::string& name, int calls) {
  using namespace zwang::bench;
  std::vector<Workload (*)()> makers{base_full,           base_with_rows,      base_rows,
                                     eccentric_base_full, eccentric_base_rows, base_tick,
                                     mobile_arm_full,     mobile_arm_rows};
#ifdef ZWANG_BENCH_MUJOCO
  makers.push_back(mujoco_step);
#endif
  std::optional<Workload> work;
  for (const int rows : {1, 3, 6}) {
    if (name == "arm, " + std::to_string(rows) + " rows") work = arm_zwang(rows);
    if (name == "KDL, " + std::to_string(rows) + " rows") work = arm_kdl(rows);
  }
#ifdef ZWANG_BENCH_PINOCCHIO
  makers.push_back(arm_pinocchio);
#endif
  for (const int links : growing_links) {
    if (name == chain_name(links, 6)) work = chain(links, 6);
  }
  for (const auto make : makers) {
    if (!work && make().name == name) work = make();
  }
  if (!work) return 2;
  for (int i = 0; i < calls; ++i) work->call(static_cast<std::size_t>(i));
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 4 && std::strcmp(arguments[1], "--repeat") == 0)
    return repeat(arguments[2], std::atoi(arguments[3]));
  cpu_set_t core;
  CPU_ZERO(&core);
  CPU_SET(static_cast<std::size_t>(sched_getcpu()), &core);
  sched_setaffinity(0, sizeof(core), &core);

  char interleaved[] = "--benchmark_enable_random_interleaving=true";
  std::vector<char*> options{arguments[0], interleaved};
  options.insert(options.end(), arguments + 1, arguments + count);
  int option_count = static_cast<int>(options.size());
  benchmark::Initialize(&option_count, options.data());
  if (benchmark::ReportUnrecognizedArguments(option_count, options.data())) return 2;

  const std::vector<Comparison> all = comparisons();
  std::vector<std::string> added;
  for (const Comparison& c : all) {
    for (const Workload& work : {c.work, c.peer}) {
      if (std::find(added.begin(), added.end(), work.name) != added.end()) continue;
      added.push_back(work.name);
      add_benchmark(work);
    }
  }
  add_growth();
  Keeper keeper;
  benchmark::RunSpecifiedBenchmarks(&keeper);
  print_comparisons(arguments[0], all, keeper.times);
  print_growth(arguments[0], keeper.times);
  std::printf("\n");
  print_worst_step(zwang::bench::arm_zwang(6));
  print_worst_step(zwang::bench::base_full());
  print_worst_step(zwang::bench::mobile_arm_full());
  return all_good ? 0 : 1;
}
