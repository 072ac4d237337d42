/// A process that runs cells, one after the other.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>

#include "study/workers.hpp"

namespace zwang::study {

/// A cell that crashes or hangs takes this process along, and no other: the next cell gets a new one. Must be
/// made before the calling process has threads. Throws std::system_error where no process can be made.
class Worker {
 public:
  explicit Worker(const WorkCalls& calls);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  bool is_free() const { return !cell_; }
  /// A file to wait at: there is something to read when the cell has ended.
  int answers() const { return answers_; }

  void ask(std::size_t cell);
  /// The record of the cell, once it has ended: `crashed` with its process, or `hung`, and its process is
  /// ended, after `limit` [s] of real time.
  std::optional<CellRecord> outcome(double limit);

 private:
  using Clock = std::chrono::steady_clock;
  CellRecord answer();
  CellRecord give_up(const std::string& because);
  void start();
  int end();

  const WorkCalls& calls_;
  pid_t process_ = -1;
  int questions_ = -1, answers_ = -1;
  std::optional<std::size_t> cell_;
  Clock::time_point begin_;
};

}  // namespace zwang::study
