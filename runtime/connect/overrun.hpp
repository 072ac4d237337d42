/// A computer that is too slow for its control period.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace zwang::connect {

/// Control cycles that were skipped. One is a hiccup of the scheduler; `many` within `window` are the event
/// `overrun`.
class Overrun {
 public:
  static constexpr std::size_t many = 5;
  static constexpr double window = 1.0;  ///< [s]

  /// Once a cycle: how many were `skipped` before it, at `time` [s]. Whether an overrun begins. It ends when
  /// fewer than `many` were skipped within the last `window`.
  bool add(std::uint64_t skipped, double time) noexcept {
    for (std::uint64_t i = std::min<std::uint64_t>(skipped, many); i > 0; --i) {
      times_[next_] = time;
      next_ = (next_ + 1) % many;
    }
    // The oldest of the last `many`.
    const bool is_now = time - times_[next_] < window;
    const bool begins = is_now && !is_overrun_;
    is_overrun_ = is_now;
    return begins;
  }

 private:
  std::array<double, many> times_ = [] {
    std::array<double, many> long_ago{};
    long_ago.fill(-2.0 * window);
    return long_ago;
  }();
  std::size_t next_ = 0;
  bool is_overrun_ = false;
};

}  // namespace zwang::connect
