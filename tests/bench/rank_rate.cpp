// The number of cells a second that rank 0 of an MPI job hands out and keeps, if a cell takes no time.
//
// Over TCP, as between machines. The other rank stands for sixty-four: so many records are on their way at
// once. The goal is judged by rank 0's own processor time, which other programs on the machine do not change.
// Without a job it starts mpirun with two processes of itself.
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <numeric>
#include <string>
#include <vector>

#include "../temporary_folder.hpp"
#include "study/ranks.hpp"
#include "study/result_store.hpp"

namespace {

using namespace zwang;
using Clock = std::chrono::steady_clock;

constexpr std::size_t cells = 50'000, on_the_way = 64, draws = 4, claims = 3;
constexpr double goal = 20'000.0;  // [1/s]
constexpr const char* identity = "no-op";

study::CellRecord no_op(std::size_t cell) {
  study::CellRecord record;
  record.cell = cell;
  record.outcome = "done";
  record.drawn.assign(draws, 0.1 * static_cast<double>(cell));
  record.expectations.assign(claims, {true, 0.5, 1.25});
  return record;
}

void answer_at_once(study::Messages& messages) {
  messages.send(0, identity);
  for (std::size_t i = 1; i < on_the_way; ++i) messages.send(0, to_text(no_op(cells + i)));
  for (;;) {
    const auto message = messages.receive(1.0);
    if (!message) continue;
    if (message->text == "no more") return;
    messages.send(0, to_text(no_op(std::stoull(message->text))));
  }
}

struct Times {
  double real, processor;  // [s]
};

/// Until all cells are kept.
Times times_of(study::Messages& messages, study::ResultStore& store) {
  std::vector<std::size_t> numbers(cells);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  study::WorkCalls calls;
  calls.run = no_op;
  calls.done = [&](const study::CellRecord& record) { store.put(record); };
  calls.wants_to_stop = [] { return false; };
  calls.wait = [&] { store.keep(); };
  const auto start = Clock::now();
  const std::clock_t processor_start = std::clock();
  study::run_with_ranks(numbers, {.processes = 0}, calls, identity, messages);
  const double processor = static_cast<double>(std::clock() - processor_start) / CLOCKS_PER_SEC;
  return {std::chrono::duration<double>(Clock::now() - start).count(), processor};
}

/// Whether the job that it starts says so.
bool reaches_the_goal_in_a_job(const std::string& program) {
  const std::string command =
      "mpirun --allow-run-as-root --oversubscribe --mca btl tcp,self -n 2 '" + program + "'";
  FILE* const pipe = popen(command.c_str(), "r");
  bool passes = false;
  for (char line[256]; pipe != nullptr && std::fgets(line, sizeof(line), pipe) != nullptr;) {
    std::fputs(line, stdout);
    passes = passes || std::strstr(line, ", pass") != nullptr;
  }
  return pipe != nullptr && pclose(pipe) == 0 && passes;
}

}  // namespace

int main(int, char** arguments) {
  const auto messages = study::messages_of_job(ZWANG_MPI_LIBRARY);
  if (!messages) return reaches_the_goal_in_a_job(arguments[0]) ? 0 : 1;
  if (messages->size() != 2) return 2;
  if (messages->rank() > 0) {
    answer_at_once(*messages);
    return 0;
  }
  const test::TemporaryFolder folder;
  study::StudyIdentity made{identity, {}, {}, std::vector<lang::Claim>(claims)};
  for (std::size_t i = 0; i < draws; ++i) {
    made.draws.push_back("params.p" + std::to_string(i));
    made.units.emplace_back();
  }
  study::ResultStore store((folder.path() / "cells.db").string(), made);
  const Times times = times_of(*messages, store);
  const double rate = static_cast<double>(cells) / times.processor;
  std::printf("rank 0 keeps %.0f no-op cells/s of its processor time, goal %.0f%s; %.0f by the clock\n", rate,
              goal, rate < goal ? ", MISSED" : ", pass", static_cast<double>(cells) / times.real);
  return 0;
}
