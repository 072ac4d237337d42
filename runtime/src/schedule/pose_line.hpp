/// The line through the latest poses of something that moves.
#pragma once

#include <array>
#include <cstddef>

#include "zwang/solver/frame.hpp"

namespace zwang::runtime {

/// Least squares over the samples of the last `window` [s]: positions over time, and the rotation vectors
/// from the newest orientation over time. While the samples cover less than half of the window, what they
/// show counts as standing. Does not allocate, lock, throw or print.
class PoseLine {
 public:
  explicit PoseLine(double window = 0.0) : window_(window) {}

  void clear() noexcept { count_ = 0; }
  /// Later than the last one. Samples come closer than the memory is long: then the newest one stands for
  /// those just before it.
  void add(double time, const solver::Pose& pose) noexcept;
  /// On the line at the time of the newest sample, with the twist along it in world axes.
  solver::FrameMotion at_newest() const noexcept;

 private:
  static constexpr std::size_t most = 64;
  struct Sample {
    double time = 0.0;
    solver::Pose pose;
  };
  const Sample& sample(std::size_t back) const noexcept { return samples_[(newest_ + most - back) % most]; }

  double window_;
  std::array<Sample, most> samples_{};
  std::size_t newest_ = 0;
  std::size_t count_ = 0;
};

/// `dt` [s] later, along an even twist.
solver::FrameMotion carried_on(const solver::FrameMotion& motion, double dt) noexcept;

}  // namespace zwang::runtime
