// Processes that run cells: each cell once, whatever becomes of the others.
#include "study/workers.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <map>
#include <stdexcept>
#include <thread>

#include "made_cells.hpp"

namespace zwang::study {
namespace {

TEST(Workers, RunEachCellOnce) {
  for (const std::size_t processes : {1U, 3U}) {
    std::map<std::size_t, std::string> outcomes;
    run_all(first_cells(40), {.processes = processes}, calls_of(outcomes));
    EXPECT_EQ(outcomes.size(), 40u);
  }
  std::map<std::size_t, std::string> none;
  run_all({}, {.processes = 2}, calls_of(none));
  EXPECT_TRUE(none.empty());
}

TEST(Workers, TheLimitIsToldAsItWasGiven) {
  std::map<std::size_t, std::string> outcomes;
  std::string why;
  WorkCalls calls = calls_of(outcomes);
  calls.run = [](std::size_t cell) {
    for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
    return made_outcome(cell, "done");
  };
  calls.fail = [&](std::size_t cell, const std::string& outcome, const std::string& because) {
    why = because;
    return made_outcome(cell, outcome);
  };
  run_all(first_cells(1), {.processes = 1, .cell_limit = 0.25}, calls);
  EXPECT_EQ(why, "took longer than 0.25 s");
}

TEST(Workers, TellOfACellThatCrashesHangsOrThrows) {
  std::map<std::size_t, std::string> outcomes;
  WorkCalls calls = calls_of(outcomes);
  calls.run = [](std::size_t cell) {
    if (cell == 3) ::kill(::getpid(), SIGKILL);
    if (cell == 4) throw std::runtime_error("no plant");
    while (cell == 5) std::this_thread::sleep_for(std::chrono::seconds(1));
    if (cell == 6) ::_exit(0);
    return made_outcome(cell, "done");
  };
  // No other cell takes as long, however busy the machine is.
  run_all(first_cells(12), {.processes = 2, .cell_limit = 5.0}, calls);
  ASSERT_EQ(outcomes.size(), 12u);
  EXPECT_EQ(outcomes[3], "crashed");
  EXPECT_EQ(outcomes[4], "error");
  EXPECT_EQ(outcomes[5], "hung");
  EXPECT_EQ(outcomes[6], "crashed");
  for (const auto& [cell, outcome] : outcomes) {
    if (cell < 3 || cell > 6) {
      EXPECT_EQ(outcome, "done") << cell;
    }
  }
}

TEST(Workers, EndAtOnceWhenAsked) {
  std::map<std::size_t, std::string> outcomes;
  WorkCalls calls = calls_of(outcomes);
  calls.wants_to_stop = [&] { return outcomes.size() >= 5; };
  run_all(first_cells(100'000), {.processes = 2}, calls);
  EXPECT_GE(outcomes.size(), 5u);
  EXPECT_LT(outcomes.size(), 20u);
}

}  // namespace
}  // namespace zwang::study
