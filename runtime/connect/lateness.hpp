/// How late ticks were, in bins: nothing grows while the robot moves.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace zwang::connect {

class Lateness {
 public:
  void add(double seconds) noexcept {
    const double bin = std::clamp(seconds / width, 0.0, static_cast<double>(bins - 1));
    ++counts_[static_cast<std::size_t>(bin)];
    ++ticks_;
    most_ = std::max(most_, seconds);
  }
  /// [s] that this share of the ticks was not later than, to the width of a bin.
  double quantile(double share) const noexcept {
    const double wanted = share * static_cast<double>(ticks_);
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < bins; ++i) {
      sum += counts_[i];
      if (static_cast<double>(sum) >= wanted) return std::min(most_, static_cast<double>(i + 1) * width);
    }
    return most_;
  }
  double most() const noexcept { return most_; }  ///< [s]
  std::uint64_t ticks() const noexcept { return ticks_; }

  static constexpr double width = 10e-6;  ///< [s] of a bin

 private:
  static constexpr std::size_t bins = 20'000;  // 0.2 s
  std::array<std::uint64_t, bins> counts_{};
  std::uint64_t ticks_ = 0;
  double most_ = 0.0;
};

}  // namespace zwang::connect
