/// The waiting conditions of a task at the moment it was left.
#pragma once

#include <vector>

#include "schedule/signal_table.hpp"
#include "schedule/wait_course.hpp"

namespace zwang::runtime {

/// Sized by the constructor: a snapshot is taken within the tick.
struct TaskSnapshot {
  struct Exit {
    std::vector<double> values;  ///< of each node of its condition, as `evaluate` leaves them
    double true_for = 0.0;       ///< [s]
    double longest = 0.0;        ///< [s]
    int times = 0;               ///< that it became true
  };
  TaskSnapshot(std::size_t exit_count, std::size_t most_nodes, std::size_t most_compared,
               std::size_t signal_count)
      : exits(exit_count), course(most_compared), signals(signal_count), required(most_nodes) {
    for (Exit& exit : exits) exit.values.resize(most_nodes);
  }

  double elapsed = 0.0;  ///< [s] since the task was entered
  std::vector<Exit> exits;
  WaitCourse course;
  std::vector<SignalState> signals;
  std::vector<double> required;  ///< of each node of its `require`, when it was asked last
};

}  // namespace zwang::runtime
