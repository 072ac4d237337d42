#include "guard/contact_depth.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

ContactDepth::ContactDepth(const lang::Robot& robot, double period)
    : motors_(wheel_motors(robot, smallest)),
      period_(period),
      deepest_(deepest * std::sqrt(robot.model.total_mass())) {}

void ContactDepth::reset() noexcept {
  now_ = {};
  deepest_yet_ = force_when_deepest_ = 0.0;
}

void ContactDepth::follow(const solver::FreeMotions& motions, Force p, double power,
                          double kinetic_energy) noexcept {
  now_.size = p.norm();
  if (!(now_.size > std::max(least_force(motors_, motions), quiet * force_when_deepest_))) {
    now_.depth = now_.work = deepest_yet_ = force_when_deepest_ = 0.0;
    return;
  }
  const double given = power * period_;
  const double way = given / now_.size;
  now_.given += given;
  now_.way += way;
  now_.gone += std::sqrt(2.0 * std::max(0.0, kinetic_energy)) * period_;
  now_.work = std::max(0.0, now_.work - given);
  now_.depth = std::clamp(now_.depth - way, 0.0, deepest_);
  if (now_.depth > deepest_yet_) {
    deepest_yet_ = now_.depth;
    force_when_deepest_ = now_.size;
  }
}

bool ContactDepth::is_no_spring(const Mark& since) const noexcept {
  const double way = now_.way - since.way;
  const double grown = now_.size / since.size - 1.0;
  const double follows = std::max(0.0, way > 0.0 ? -grown : grown);
  const bool keeps = std::abs(way) > (follows + unexplained) * since.depth;
  return keeps || now_.given - since.given > since.work;
}

bool ContactDepth::goes_along(const Mark& since, double share) const noexcept {
  return std::abs(now_.way - since.way) > share * (now_.gone - since.gone);
}

}  // namespace zwang::runtime
