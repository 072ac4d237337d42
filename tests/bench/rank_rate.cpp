// The number of cells a second that rank 0 of an MPI job hands out and keeps, if a cell takes no time.
//
// Over TCP, as between machines. The other rank stands for sixty-four: so many records are on their way at
// once. Without a job it starts mpirun with two processes of itself.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
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

/// [s] until all cells are kept.
double time_of(study::Messages& messages, study::ResultStore& store) {
  std::vector<std::size_t> numbers(cells);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  study::WorkCalls calls;
  calls.run = no_op;
  calls.done = [&](const study::CellRecord& record) { store.put(record); };
  calls.wants_to_stop = [] { return false; };
  calls.wait = [&] { store.keep(); };
  const auto start = Clock::now();
  study::run_with_ranks(numbers, {.processes = 0}, calls, identity, messages);
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

int main(int, char** arguments) {
  const auto messages = study::messages_of_job(ZWANG_MPI_LIBRARY);
  if (!messages) {
    execlp("mpirun", "mpirun", "--allow-run-as-root", "--oversubscribe", "--mca", "btl", "tcp,self", "-n",
           "2", arguments[0], nullptr);
    std::perror("mpirun");
    return 2;
  }
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
  const double time = time_of(*messages, store);
  const double rate = static_cast<double>(cells) / time;
  std::printf("rank 0 keeps %.0f no-op cells/s, goal %.0f%s\n", rate, goal,
              rate < goal ? ", MISSED" : ", pass");
  return rate < goal ? 1 : 0;
}
