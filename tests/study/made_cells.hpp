/// Cells of a study that are made up: what they end with, and what becomes of them.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "study/workers.hpp"

namespace zwang::study {

inline CellRecord made_outcome(std::size_t cell, const std::string& outcome) {
  CellRecord record;
  record.cell = cell;
  record.outcome = outcome;
  return record;
}

/// Cells that are done, once each, and whose outcomes are kept.
inline WorkCalls calls_of(std::map<std::size_t, std::string>& outcomes) {
  WorkCalls calls;
  calls.run = [](std::size_t cell) { return made_outcome(cell, "done"); };
  calls.fail = [](std::size_t cell, const std::string& outcome, const std::string&) {
    return made_outcome(cell, outcome);
  };
  calls.done = [&](const CellRecord& record) {
    EXPECT_TRUE(outcomes.emplace(record.cell, record.outcome).second) << record.cell << " came twice";
  };
  calls.wants_to_stop = [] { return false; };
  calls.wait = [] {};
  return calls;
}

inline std::vector<std::size_t> first_cells(std::size_t count) {
  std::vector<std::size_t> cells(count);
  std::iota(cells.begin(), cells.end(), std::size_t{0});
  return cells;
}

}  // namespace zwang::study
