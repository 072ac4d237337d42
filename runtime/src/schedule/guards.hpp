/// The exits of the active task, or those of `always`, and what they remember from tick to tick.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "schedule/condition.hpp"
#include "schedule/wait_course.hpp"

namespace zwang::runtime {

// Rounding in a clock that adds up periods must not shift a time by a whole tick.
inline constexpr double clock_rounding = 1e-6;  // of a period

enum class Unknown {
  does_not_fire,
  fires_when_stale  ///< at once, without waiting for `for`
};

/// The exits of a task, or of `always`, as guards evaluate them.
struct GuardedExits {
  GuardedExits(const std::vector<lang::Exit>& given, int owner_task);

  const std::vector<lang::Exit>& exits;
  int owner;  ///< as for Facts
  std::vector<Compared> compared;
  std::vector<std::array<int, 2>> sides;  ///< of each comparison its left and right side, among `numbers`
  SharedNumbers numbers;
  std::vector<Decision> decisions;  ///< of each exit
};

class Guards {
 public:
  Guards(std::size_t most_exits, std::size_t most_nodes, std::size_t most_compared, double period,
         Unknown unknown);

  /// Forgets how long each condition has been true, and that it was.
  void restart() noexcept;
  /// Evaluates every condition, once a tick, as far as it takes to decide it.
  void advance(GuardedExits& guarded, const Facts& facts, const std::vector<double>& parameters) noexcept;
  /// Whether the exit has been true for as long as its `for` says.
  bool is_due(const std::vector<lang::Exit>& exits, std::size_t exit,
              const std::vector<double>& parameters) const noexcept;
  /// How long the condition has been true without a break. [s]
  double dwell(std::size_t exit) const noexcept { return states_[exit].true_ticks * period_; }

  /// The longest of these since `restart`. [s]
  double longest(std::size_t exit) const noexcept { return states_[exit].longest_ticks * period_; }
  /// How often it became true since `restart`.
  int times(std::size_t exit) const noexcept { return states_[exit].times; }
  const WaitCourse& course() const noexcept { return course_; }

 private:
  struct GuardState {
    int true_ticks = 0;
    int longest_ticks = 0;
    int times = 0;
    bool held = false;     ///< with `release`: was true, and has not passed it yet
    bool at_once = false;  ///< a stale signal counts as true
  };
  std::vector<GuardState> states_;
  void keep(GuardedExits& guarded, const Facts& facts) noexcept;

  std::vector<double> values_;  ///< of one condition's decision
  WaitCourse course_;
  double period_;
  Unknown unknown_;
};

}  // namespace zwang::runtime
