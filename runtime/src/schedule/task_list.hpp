/// Every task that a run can be in, checked and with its places counted, before the first tick.
#pragma once

#include <vector>

#include "schedule/joint_holds.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::runtime {

/// The program's tasks with the robot's limits and the joints to hold, then `done`, `failed` and `always`. A
/// group `inside` a region has one entry of `axes` that stands for its rows. A group on a feature has the
/// feature's frames as `move` and `in`, the one that the robot can move first.
struct TaskList {
  /// Throws std::invalid_argument on an index that is out of range. `frames` are the program's, with the
  /// base's and those of `joints` among them.
  TaskList(const lang::Program& program, const std::vector<lang::FrameDeclaration>& frames, int base,
           const std::vector<HeldJoint>& joints);

  const lang::Task& operator[](int task) const noexcept { return tasks[static_cast<std::size_t>(task)]; }
  int done() const noexcept { return program_tasks; }
  int failed() const noexcept { return program_tasks + 1; }
  int always() const noexcept { return program_tasks + 2; }
  bool ends(int task) const noexcept { return task >= program_tasks; }

  std::vector<lang::Task> tasks;
  int program_tasks = 0;
  std::vector<bool> leads_back;    ///< of each task: `back` can be reached from it
  std::vector<bool> reaches_done;  ///< of each task: `done` or `back` can be reached by its own exits
  // The most that can be in force at once, `always` included.
  std::size_t most_axes = 0;
  std::size_t most_exits = 0;
  std::size_t most_nodes = 0;     ///< of a condition
  std::size_t most_compared = 0;  ///< comparisons in a task's exits
  int most_rows = 0;
};

}  // namespace zwang::runtime
