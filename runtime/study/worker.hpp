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
  /// A file to wait at: there is something to read when the answer is there.
  int answers() const { return answers_; }
  double busy_for() const;  ///< [s] of real time

  void ask(std::size_t cell);
  /// The record that has come; of a process that has died, that it has.
  CellRecord answer();
  /// Ends the process and its cell.
  CellRecord give_up(const std::string& because);

 private:
  using Clock = std::chrono::steady_clock;
  void start();
  int end();

  const WorkCalls& calls_;
  pid_t process_ = -1;
  int questions_ = -1, answers_ = -1;
  std::optional<std::size_t> cell_;
  Clock::time_point begin_;
};

}  // namespace zwang::study
