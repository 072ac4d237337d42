/// Processes that run cells. A cell that crashes or hangs takes its own process along, and no other.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/cell_record.hpp"

namespace zwang::study {

struct WorkSettings {
  std::size_t processes = 1;
  double cell_limit = 600.0;  ///< [s] of real time, after which a cell is `hung`
};

/// The caller is told of cells, and asked, while they run.
struct WorkCalls {
  std::function<CellRecord(std::size_t)> run;  ///< in another process
  std::function<CellRecord(std::size_t, const std::string& outcome, const std::string& because)> fail;
  std::function<void(const CellRecord&)> done;  ///< in the order in which cells end
  std::function<bool()> wants_to_stop;          ///< asked several times a second
  std::function<void()> wait;                   ///< called as often: for a progress line
};

/// Runs the cells, each by the next process that is free. Must be called before the process has threads.
/// Throws std::system_error where no process can be made.
void run_all(const std::vector<std::size_t>& cells, const WorkSettings& settings, const WorkCalls& calls);

}  // namespace zwang::study
