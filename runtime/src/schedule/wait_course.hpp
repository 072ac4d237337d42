/// What the comparisons of a task's exits lacked while it waited: at up to eight ticks, evenly over the wait.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "zwang/lang/program.hpp"

namespace zwang::runtime {

/// A comparison of an exit's condition.
struct Compared {
  std::size_t exit = 0;
  int node = -1;
  int left = -1, right = -1;
  bool wants_less = false;  ///< `left < right`, or `<=`
};

std::vector<Compared> comparisons(const std::vector<lang::Exit>& exits);

/// How far a comparison is from true: positive while it is false. SI; NaN: unknown.
inline double lack_between(double left, double right, bool wants_less) noexcept {
  return wants_less ? left - right : right - left;
}

inline double lack_of(const Compared& one, std::span<const double> values) noexcept {
  return lack_between(values[static_cast<std::size_t>(one.left)], values[static_cast<std::size_t>(one.right)],
                      one.wants_less);
}

/// How a lack went on.
struct Trend {
  std::optional<double> left;  ///< [s] at the pace of late until there is none; none: it does not get less
  double stood = 0.0;          ///< [s] for so long it has been what it is
  bool is_whole = false;       ///< and all the time before, too
  bool grows = false;          ///< from each tick that is kept to the next one
};

/// Does not allocate after construction.
class WaitCourse {
 public:
  explicit WaitCourse(std::size_t most_compared = 0) : lacks_(most_compared * most_kept) {}

  void restart() noexcept { kept_ = 0, stride_ = 1, ticks_ = 0; }
  /// Once a tick. Whether this one is to be kept: `keep` follows for each comparison.
  bool advance() noexcept {
    const bool is_due = ticks_++ % stride_ == 0;
    if (!is_due) return false;
    if (kept_ == most_kept) thin();
    ++kept_;
    return true;
  }
  void keep(std::size_t compared, double lack) noexcept { lacks_[compared * most_kept + kept_ - 1] = lack; }

  /// Of a comparison that lacks `now`. Below a hundredth of it a change is none: at such a pace the wait
  /// would take a hundred times as long. Of one that should be false `now` and what was kept count the other
  /// way round.
  Trend trend(std::size_t compared, double now, bool is_turned, double period) const noexcept;

 private:
  static constexpr std::size_t most_kept = 8;
  /// Every second one stays. The eight are ticks 0, stride, .. 7 stride; the next one is due at 8 stride.
  void thin() noexcept {
    for (std::size_t i = 0; i < lacks_.size(); i += most_kept) {
      for (std::size_t k = 1; k < most_kept / 2; ++k) lacks_[i + k] = lacks_[i + 2 * k];
    }
    kept_ = most_kept / 2;
    stride_ *= 2;
  }

  std::vector<double> lacks_;  ///< by comparison, then tick
  std::size_t kept_ = 0;
  std::size_t stride_ = 1;  ///< ticks from one that is kept to the next
  std::size_t ticks_ = 0;
};

}  // namespace zwang::runtime
