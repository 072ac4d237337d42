#include "scenario/steady_force.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

void SteadyForce::look(double force, bool in_touch, const Eigen::Vector3d& velocity, double time) noexcept {
  if (!in_touch) {
    *this = {};
    return;
  }
  constexpr double rounding = 1e-9;  // [s]
  if (count_ > 0 && time > begin_ + length - rounding) finish_part(velocity);
  if (count_ == 0) {
    begin_ = time;
    velocity_ = velocity;
  }
  sum_ += force;
  ++count_;
}

void SteadyForce::finish_part(const Eigen::Vector3d& velocity) noexcept {
  std::shift_right(parts_.begin(), parts_.end(), 1);
  parts_.front() = {sum_ / static_cast<double>(count_), velocity_};
  known_ = std::min(known_ + 1, parts);
  sum_ = 0.0;
  count_ = 0;
  now_.reset();
  if (known_ < parts) return;
  const Eigen::Vector3d gained = velocity - parts_.back().velocity;
  if (gained.head<2>().norm() > same_speed || std::abs(gained.z()) > same_turn) return;
  double sum = 0.0;
  for (const Part& part : parts_) sum += part.mean;
  now_ = sum / parts;
}

}  // namespace zwang::runtime
