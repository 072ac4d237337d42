/// The exits of the active task, or those of `always`, and what they remember from tick to tick.
#pragma once

#include <cstddef>
#include <vector>

#include "schedule/condition.hpp"

namespace zwang::runtime {

// Rounding in a clock that adds up periods must not shift a time by a whole tick.
inline constexpr double clock_rounding = 1e-6;  // of a period

enum class Unknown {
  does_not_fire,
  fires_when_stale  ///< at once, without waiting for `for`
};

class Guards {
 public:
  Guards(std::size_t most_exits, double period, Unknown unknown);

  /// Forgets how long each condition has been true, and that it was.
  void restart() noexcept;
  /// Evaluates every condition, once a tick. `owner` as for Facts.
  void advance(const std::vector<lang::Exit>& exits, int owner, const Facts& facts,
               const std::vector<double>& parameters, std::vector<double>& scratch) noexcept;
  /// Whether the exit has been true for as long as its `for` says.
  bool is_due(const std::vector<lang::Exit>& exits, std::size_t exit,
              const std::vector<double>& parameters) const noexcept;
  /// How long the condition has been true without a break. [s]
  double dwell(std::size_t exit) const noexcept { return states_[exit].true_ticks * period_; }

 private:
  struct GuardState {
    int true_ticks = 0;
    bool held = false;     ///< with `release`: was true, and has not passed it yet
    bool at_once = false;  ///< a stale signal counts as true
  };
  std::vector<GuardState> states_;
  double period_;
  Unknown unknown_;
};

}  // namespace zwang::runtime
