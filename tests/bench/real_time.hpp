/// A runner at 1 kHz in a thread of its own, beside whatever else the machine does.
#pragma once

#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::bench {

/// After the first second, which touches what a run uses.
struct RealTimeRun {
  bool has_priority = false;  ///< SCHED_FIFO was granted
  bool has_locked_pages = false;
  std::vector<double> steps;   ///< [us] of each step
  std::vector<double> probes;  ///< [us] of a piece of arithmetic as long as a step, in the same thread
  long heap_calls = 0;         ///< of the steps
  long page_faults = 0;        ///< of the steps
};

RealTimeRun run_in_real_time(const lang::Program& program, const std::vector<runtime::Sensed>& samples);

}  // namespace zwang::bench
