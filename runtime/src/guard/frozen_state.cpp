#include "guard/frozen_state.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

void FrozenState::look(const Eigen::VectorXd& q, double dt) noexcept {
  double way = 0.0;
  int fastest = 0;
  for (Eigen::Index j = 0; has_last_ && j < q_.size(); ++j) {
    const double step = std::abs(q(j) - q_(j));
    if (step > 0.0) encoder_step_ = std::min(encoder_step_, step);
    if (step > way) fastest = static_cast<int>(j);
    way = std::max(way, step);
  }
  q_ = q;
  if (!has_last_ || dt <= 0.0) {
    has_last_ = true;
    return;
  }
  if (way == 0.0) {
    const bool rolled_evenly = pace_ > least_pace && last_pace_ > evenly * pace_;
    if (still_ticks_ == 0) is_abrupt_ = rolled_evenly && tick_way_ > steps * encoder_step_;
    ++still_ticks_;
    return;
  }
  still_ticks_ = 0;
  is_abrupt_ = false;
  joint_ = fastest;
  tick_way_ = way;
  last_pace_ = way / dt;
  pace_ += share * (last_pace_ - pace_);
}

void FrozenState::begin() noexcept {
  has_last_ = is_abrupt_ = false;
  still_ticks_ = 0;
  pace_ = last_pace_ = 0.0;
}

}  // namespace zwang::runtime
