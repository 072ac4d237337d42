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
  forget();
}

/// The world has let go.
void ContactDepth::forget() noexcept {
  now_.depth = now_.work = deepest_yet_ = force_when_deepest_ = 0.0;
  level_ = -1;
}

/// A contact that presses on after a hit pressed before it, too. So the depth and the work are those of the
/// last time that the force was this weak and grew. They are 0 if the force began with more.
void ContactDepth::keep_what_pressed_before(int level) noexcept {
  while (level >= 0 && (level > level_ || !held_[static_cast<std::size_t>(level)].is_known)) --level;
  const Held held = level < 0 ? Held{} : held_[static_cast<std::size_t>(level)];
  now_.depth = std::min(now_.depth, held.depth);
  now_.work = std::min(now_.work, held.work);
  deepest_yet_ = now_.depth;
  force_when_deepest_ = now_.size;
  level_ = level;
}

/// As the contact is pressed in. Higher levels are forgotten: another contact had them.
void ContactDepth::remember(int level) noexcept {
  for (int i = level_ + 1; i < level; ++i) held_[static_cast<std::size_t>(i)] = {};
  held_[static_cast<std::size_t>(level)] = {now_.depth, now_.work, true};
  level_ = level;
}

void ContactDepth::follow(const solver::FreeMotions& motions, Force p, double power,
                          double kinetic_energy) noexcept {
  now_.size = p.norm();
  if (!(now_.size > least_force(motors_, motions))) {
    forget();
    return;
  }
  const int level = std::clamp(std::ilogb(now_.size) - lowest_level, 0, levels - 1);
  if (now_.size < quiet * force_when_deepest_) keep_what_pressed_before(level);
  const double given = power * period_;
  const double way = given / now_.size;
  now_.given += given;
  now_.way += way;
  now_.gone += std::sqrt(2.0 * std::max(0.0, kinetic_energy)) * period_;
  now_.work = std::max(0.0, now_.work - given);
  now_.depth = std::clamp(now_.depth - way, 0.0, deepest_);
  if (now_.depth >= deepest_yet_) {
    deepest_yet_ = now_.depth;
    force_when_deepest_ = now_.size;
    remember(level);
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
