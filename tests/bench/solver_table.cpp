// What one call of the solver costs, beside its peers: `solver_table`, or `./dev bench`.
//
// Every ratio is taken inside one run: the two calls alternate, round by round, on one core, and the ratio is
// the median of the rounds' ratios, so that what else the machine does falls on both. Outside the timed part:
// building models, workspaces and states. Instruction counts (callgrind, where valgrind is installed) do not
// depend on the machine's mood at all: two runs of different length, and their difference.
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "workload.hpp"

namespace {

using zwang::bench::Workload;
using Clock = std::chrono::steady_clock;

constexpr int rounds = 61;

double median(std::vector<double> numbers) {
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

/// One round: all states, often enough for the clock. [ns] a call
double time_round(const Workload& work) {
  constexpr std::size_t calls = zwang::bench::state_count;
  const auto start = Clock::now();
  for (std::size_t i = 0; i < calls; ++i) work.call(i);
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count() / calls;
}

/// The least of all rounds: for a law of growth, whatever else the machine does is an error that only adds.
double least_time(const Workload& work) {
  double least = time_round(work);
  for (int r = 1; r < rounds; ++r) least = std::min(least, time_round(work));
  return least;
}

/// Instructions of a call; nothing without valgrind.
std::optional<double> instructions(const std::string& program, const std::string& name) {
  double totals[2] = {};
  const int calls[2] = {zwang::bench::state_count, 5 * zwang::bench::state_count};
  for (int k = 0; k < 2; ++k) {
    const std::string command = "valgrind --tool=callgrind --callgrind-out-file=/dev/null '" + program +
                                "' --repeat '" + name + "' " + std::to_string(calls[k]) + " 2>&1";
    FILE* const pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) return std::nullopt;
    char line[512];
    while (std::fgets(line, sizeof(line), pipe) != nullptr) {
      if (const char* const found = std::strstr(line, "Collected :"))
        totals[k] = std::strtod(found + 11, nullptr);
    }
    if (pclose(pipe) != 0 || totals[k] == 0.0) return std::nullopt;
  }
  return (totals[1] - totals[0]) / (calls[1] - calls[0]);
}

std::string count_of(const std::string& program, const Workload& work) {
  const std::optional<double> count = instructions(program, work.name);
  if (!count) return "-";
  char text[32];
  std::snprintf(text, sizeof(text), "%.1fk", 1e-3 * *count);
  return text;
}

/// `work` beside `peer`; the ratio is peer over work, or work over peer where the goal is a share.
void compare(const std::string& program, const Workload& work, const Workload& peer, bool as_share,
             const char* goal) {
  std::vector<double> ours, theirs, ratios;
  for (int r = 0; r < rounds; ++r) {
    ours.push_back(time_round(work));
    theirs.push_back(time_round(peer));
    ratios.push_back(as_share ? ours.back() / theirs.back() : theirs.back() / ours.back());
  }
  std::printf("%-26s %8.0f ns %8s   %-31s %8.0f ns %8s   %6.2f  %s\n", work.name.c_str(), median(ours),
              count_of(program, work).c_str(), peer.name.c_str(), median(theirs),
              count_of(program, peer).c_str(), median(ratios), goal);
  std::fflush(stdout);
}

void print_peers(const std::string& program) {
  using namespace zwang::bench;
  std::printf("%-26s %11s %8s   %-31s %11s %8s   %6s\n", "zwang", "median", "instr", "beside", "median",
              "instr", "ratio");
  for (const int rows : {1, 3, 6}) {
    compare(program, arm_zwang(rows), arm_kdl(rows), false,
            rows == 6 ? "times as fast; goal 6, stretch 8" : "times as fast");
  }
  compare(program, base_full(), base_rows(), true, "of our own unbounded call; goal 2");
  compare(program, mobile_arm_full(), mobile_arm_rows(), true, "of our own unbounded call; goal 2");
#ifdef ZWANG_BENCH_MUJOCO
  const Workload step = mujoco_step();
  compare(program, base_full(), step, true, "of a step; goal 0.35, stretch 0.25");
  compare(program, base_with_rows(), step, true, "of a step");
  compare(program, base_tick(), step, true, "of a step");
#endif
  std::printf("\na call of                  does\n");
  for (const Workload& work :
       {arm_zwang(6), arm_kdl(6), base_rows(), base_full(), base_with_rows(), base_tick()}) {
    std::printf("%-26s %s\n", work.name.c_str(), work.includes.c_str());
  }
}

/// Slope of log time over log links.
void print_growth() {
  std::printf("\nleast of %d rounds\nlinks (6 rows):  ", rounds);
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (int links = 8; links <= 256; links *= 2) {
    const double time = least_time(zwang::bench::chain(links, 6));
    std::printf(" %d: %.0f ns ", links, time);
    const double x = std::log(links);
    const double y = std::log(time);
    n += 1.0;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  std::printf(" exponent %.2f (goal 1.0 +- 0.1)\nrows (24 links): ",
              (n * sxy - sx * sy) / (n * sxx - sx * sx));
  for (const int rows : {1, 2, 3, 6, 12, 18, 24}) {
    std::printf(" %d: %.0f ns ", rows, least_time(zwang::bench::chain(24, rows)));
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
  std::printf("%-26s worst step %.2f times the median (%.0f ns); goal 2\n", work.name.c_str(),
              worst / median(least), median(least));
}

int repeat(const std::string& name, int calls) {
  using namespace zwang::bench;
  std::vector<Workload (*)()> makers{base_full, base_with_rows,  base_rows,
                                     base_tick, mobile_arm_full, mobile_arm_rows};
#ifdef ZWANG_BENCH_MUJOCO
  makers.push_back(mujoco_step);
#endif
  std::optional<Workload> work;
  for (const int rows : {1, 3, 6}) {
    if (name == "arm, " + std::to_string(rows) + " rows") work = arm_zwang(rows);
    if (name == "KDL, " + std::to_string(rows) + " rows") work = arm_kdl(rows);
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
  print_peers(arguments[0]);
  print_growth();
  std::printf("\n");
  print_worst_step(zwang::bench::arm_zwang(6));
  print_worst_step(zwang::bench::base_full());
  print_worst_step(zwang::bench::mobile_arm_full());
  return 0;
}
