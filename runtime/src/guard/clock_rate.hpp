/// Detects a samples' clock that does not run with the control period.
#pragma once

#include <optional>

#include "zwang/runtime/event.hpp"

namespace zwang::runtime {

/// One call of the tick is one control period T. A clock that advances by dt over n calls has the rate
///   r = dt / (n T).
/// A clock of another rate makes every rate, acceleration and dwell wrong by r, and the watches then accuse
/// motors and encoders. Lost samples leave the rate as it is: the clock stands for n - 1 calls and then
/// advances by n T. Does not allocate, lock, throw or print after construction.
class ClockRate {
 public:
  explicit ClockRate(double period);

  /// Every call with a finite stamp. `clock_rate`, a stop, where r stays beyond `fast` or below `slow`;
  /// `clock_drift`, told once, where the mean of r over `window` is off by `drift`. The value is r.
  std::optional<Event> look(double time) noexcept;
  /// The last advances were all too long or all too short: nothing that is computed with dt is evidence.
  bool is_off() const noexcept { return odd_advances_ >= doubtful; }
  double rate() const noexcept;  ///< of these advances
  void begin() noexcept;

  static constexpr double fast = 1.5;         ///< jitter of half a period does not reach it
  static constexpr double slow = 1.0 / fast;  ///< the same, the other way
  static constexpr double dwell = 0.05;       ///< [s] as long as samples may stay away
  static constexpr int least_advances = 10;   ///< where that is fewer periods
  static constexpr int doubtful = 5;          ///< advances: shorter than any watch takes to accuse
  static constexpr double window = 0.5;       ///< [s] 20 lost ticks at its end change r by 4 %
  static constexpr double drift = 0.1;        ///< of r
  static constexpr double jump = 0.1;         ///< [s] an advance beyond it is no rate

 private:
  std::optional<Event> end_window(double time) noexcept;

  double period_;
  int odd_enough_, calls_in_window_;
  bool has_last_ = false;
  double last_ = 0.0;  ///< [s] the last stamp that was another one
  int calls_ = 0;      ///< since then
  int side_ = 0;       ///< 1: the advances are too long, -1: too short
  int odd_advances_ = 0;
  int odd_calls_ = 0;
  double odd_time_ = 0.0;  ///< [s] by which the clock advanced in these calls
  double began_ = 0.0;     ///< [s] the window
  int window_calls_ = 0;
  bool drift_is_told_ = false;
};

}  // namespace zwang::runtime
