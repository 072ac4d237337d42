#include "quiet_means.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

namespace {

constexpr double window = 0.02;  ///< [s]

}  // namespace

QuietMeans::QuietMeans(double period)
    : length_(static_cast<std::size_t>(std::max(1.0, std::round(window / period)))),
      period_(period),
      velocities_(length_, Eigen::Vector2d::Zero()),
      pushes_(length_, Eigen::Vector2d::Zero()) {}

void QuietMeans::look(const Eigen::Vector2d& velocity, const Eigen::Vector2d& push, bool is_hit) noexcept {
  const std::size_t slot = steps_ % length_;
  const Eigen::Vector2d gained = velocity - velocities_[slot];
  velocities_[slot] = velocity;
  pushes_[slot] = push;
  ++steps_;
  quiet_steps_ = is_hit ? 0 : quiet_steps_ + 1;
  if (quiet_steps_ >= length_) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& f : pushes_) sum += f;
    push_ = sum.norm() / static_cast<double>(length_);
  }
  // The oldest velocity is from the end of the step before the 20 ms.
  if (quiet_steps_ > length_) acceleration_ = gained.norm() / (static_cast<double>(length_) * period_);
}

}  // namespace zwang::runtime
