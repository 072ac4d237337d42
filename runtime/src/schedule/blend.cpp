#include "schedule/blend.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

namespace {

using solver::AxisConstraint;
using solver::Driver;
using solver::Quantity;
using solver::Range;

constexpr unsigned position_bit = 1U;
constexpr unsigned velocity_bit = 2U;
constexpr unsigned acceleration_bit = 4U;
constexpr unsigned force_bit = 8U;  // of a force range alone; beside a driver it is the driver's

unsigned ranges_of(const AxisConstraint& c) {
  return (c.position ? position_bit : 0U) | (c.velocity ? velocity_bit : 0U) |
         (c.acceleration ? acceleration_bit : 0U) | (c.force ? force_bit : 0U);
}

/// A boundary's ranges come and go with its distance: it carries whatever there is.
unsigned ranges_of(const Wanted& wanted) {
  constexpr unsigned all = position_bit | velocity_bit | acceleration_bit | force_bit;
  return wanted.origin.part >= 0 ? all : ranges_of(wanted.constraint);
}

void keep_only(AxisConstraint& c, bool driver, unsigned ranges) {
  if (!driver) {
    c.driver.reset();
    c.before.reset();
  }
  if ((ranges & position_bit) == 0U) c.position.reset();
  if ((ranges & velocity_bit) == 0U) c.velocity.reset();
  if ((ranges & acceleration_bit) == 0U) c.acceleration.reset();
  if ((ranges & force_bit) == 0U) c.force.reset();
}

bool same(const solver::AttachedFrame& a, const solver::AttachedFrame& b) {
  return a.body == b.body && a.pose.rotation == b.pose.rotation && a.pose.position == b.pose.position;
}

/// A frame that a signal moves is the same one wherever it is; one that was set in between is another.
bool same(const FrameKey& a, const FrameKey& b) {
  return a.frame >= 0 && a.frame == b.frame && a.settings == b.settings;
}

/// The same coordinate of the two frames that a constraint speaks of.
bool measures_alike(const AxisConstraint& a, const AxisConstraint& b) {
  return a.measure == b.measure && a.axis == b.axis && a.other_axis == b.other_axis &&
         a.coefficients == b.coefficients;
}

double lerp(double from, double to, double progress) {
  return from + (to - from) * progress;
}

/// Whether the driver of `c`, which may itself be on its way, is a driver that one can start from.
bool is_one_driver(const AxisConstraint& c) {
  if (!c.before || c.progress >= 1.0) return true;
  if (c.before->quantity != c.driver->quantity) return false;
  if (c.driver->makes_force()) {
    return c.before->stiffness == c.driver->stiffness && c.before->damping == c.driver->damping;
  }
  const bool has_time_constant =
      c.driver->quantity == Quantity::position || c.driver->quantity == Quantity::velocity;
  return !has_time_constant || c.before->time_constant == c.driver->time_constant;
}

/// The driver that asks for what `c` asks for now.
Driver driver_now(const AxisConstraint& c) {
  Driver now = *c.driver;
  if (!c.before || c.progress >= 1.0) return now;
  now.target = lerp(c.before->target, now.target, c.progress);
  now.target_rate = lerp(c.before->target_rate, now.target_rate, c.progress);
  now.target_acceleration = lerp(c.before->target_acceleration, now.target_acceleration, c.progress);
  return now;
}

double finite(double bound, double scale) {
  return std::isfinite(bound) ? bound : std::copysign(scale, bound);
}

}  // namespace

int row_bound(const AxisConstraint& c) noexcept {
  return (c.driver || c.force ? 1 : 0) +
         2 * (static_cast<int>(c.position.has_value()) + static_cast<int>(c.velocity.has_value()) +
              static_cast<int>(c.acceleration.has_value()));
}

Blend::Blend(std::size_t most_wanted, int leaving_row_capacity, double force_scale, double torque_scale)
    : leaving_row_capacity_(leaving_row_capacity), force_scale_(force_scale), torque_scale_(torque_scale) {
  // A wanted constraint and its match split into at most three parts; the rest is for what still leaves.
  const std::size_t capacity = 8 * std::max<std::size_t>(most_wanted, 4);
  parts_.reserve(capacity);
  before_.reserve(capacity);
  taken_.reserve(capacity);
}

/// What the set alone knows of the parts.
void Blend::recall(const solver::ConstraintSet& set) noexcept {
  for (Part& part : parts_) {
    if (part.place >= 0) part.present = set.constraints()[static_cast<std::size_t>(part.place)];
  }
}

void Blend::start(const std::vector<Wanted>& wanted, double duration,
                  const solver::ConstraintSet& set) noexcept {
  recall(set);
  is_put_ = false;
  duration_ = duration;
  if (!(duration > 0.0)) {
    settle(wanted);
    return;
  }
  settled_ = false;
  before_.swap(parts_);
  parts_.clear();
  taken_.assign(before_.size(), 0);
  for (int i = 0; i < static_cast<int>(wanted.size()); ++i) {
    const Wanted& w = wanted[static_cast<std::size_t>(i)];
    const int old = match(w);
    if (old < 0) {
      add_entering(wanted, i, w.constraint.driver.has_value(), ranges_of(w));
    } else {
      taken_[static_cast<std::size_t>(old)] = 1;
      join(wanted, i, before_[static_cast<std::size_t>(old)]);
    }
  }
  for (std::size_t i = 0; i < before_.size(); ++i) {
    const AxisConstraint& c = before_[i].present;
    if (taken_[i] == 0 && !before_[i].far) add_leaving(before_[i], c.driver.has_value(), ranges_of(c));
  }
  make_room();
}

void Blend::settle(const std::vector<Wanted>& wanted) noexcept {
  settled_ = true;
  parts_.clear();
  for (int i = 0; i < static_cast<int>(wanted.size()); ++i) {
    const Wanted& w = wanted[static_cast<std::size_t>(i)];
    add_entering(wanted, i, w.constraint.driver.has_value(), ranges_of(w));
    parts_.back().alpha_from = 1.0;
    parts_.back().entering = false;
  }
}

bool Blend::is_match(const Part& part, const Wanted& wanted) noexcept {
  if (part.always || wanted.always) return part.always && wanted.always && part.origin == wanted.origin;
  const AxisConstraint& a = part.present;
  const AxisConstraint& b = wanted.constraint;
  return measures_alike(a, b) && a.level == b.level &&
         (same(part.move, wanted.move) || same(a.move, b.move)) &&
         (same(part.in, wanted.in) || same(a.in, b.in));
}

int Blend::match(const Wanted& wanted) const noexcept {
  int best = -1;
  for (std::size_t i = 0; i < before_.size(); ++i) {
    if (taken_[i] != 0 || !is_match(before_[i], wanted)) continue;
    const double alpha = before_[i].present.alpha;
    if (best < 0 || alpha > before_[static_cast<std::size_t>(best)].present.alpha) best = static_cast<int>(i);
  }
  return best;
}

/// A boundary that goes out of reach is remembered as it was put last.
void Blend::recall_what_goes_far(const std::vector<Wanted>& wanted,
                                 const solver::ConstraintSet& set) noexcept {
  for (Part& part : parts_) {
    if (part.place < 0 || part.wanted < 0 || !wanted[static_cast<std::size_t>(part.wanted)].far) continue;
    part.present = set.constraints()[static_cast<std::size_t>(part.place)];
  }
}

/// The wanted constraint `index` speaks of the axis of `from`.
void Blend::join(const std::vector<Wanted>& wanted, int index, const Part& from) noexcept {
  const AxisConstraint& to = wanted[static_cast<std::size_t>(index)].constraint;
  const Ranges in_new = ranges_of(wanted[static_cast<std::size_t>(index)]);
  const Ranges in_old = from.origin.part >= 0 ? in_new : ranges_of(from.present);
  const Ranges in_both = in_old & in_new;
  const bool drove = from.present.driver.has_value();
  const bool drives = to.driver.has_value();
  const bool driver_persists = drove && drives &&
                               from.present.driver->makes_force() == to.driver->makes_force() &&
                               is_one_driver(from.present);
  if (driver_persists || (!drove && !drives)) {
    if (drives || in_both != 0U) add_persisting(wanted, index, from, drives, in_both);
    if ((in_new & ~in_both) != 0U) add_entering(wanted, index, false, in_new & ~in_both);
    if ((in_old & ~in_both) != 0U) add_leaving(from, false, in_old & ~in_both);
    return;
  }
  // Another kind of driver, or none: the drivers change over, the ranges that both have stay in force
  // throughout.
  if (drives || (in_new & ~in_both) != 0U) add_entering(wanted, index, drives, in_new & ~in_both);
  if (in_both != 0U) add_persisting(wanted, index, from, false, in_both);
  if (drove || (in_old & ~in_both) != 0U) add_leaving(from, drove, in_old & ~in_both);
}

Blend::Part Blend::part_of(const std::vector<Wanted>& wanted, int index) noexcept {
  const Wanted& w = wanted[static_cast<std::size_t>(index)];
  Part part;
  part.origin = w.origin;
  part.move = w.move;
  part.in = w.in;
  part.always = w.always;
  part.wanted = index;
  return part;
}

void Blend::add(const Part& part) noexcept {
  if (parts_.size() < parts_.capacity()) parts_.push_back(part);
}

void Blend::add_entering(const std::vector<Wanted>& wanted, int index, bool drives, Ranges ranges) noexcept {
  Part part = part_of(wanted, index);
  part.drives = drives;
  part.ranges = ranges;
  part.entering = true;
  add(part);
}

void Blend::add_persisting(const std::vector<Wanted>& wanted, int index, const Part& from, bool drives,
                           Ranges ranges) noexcept {
  Part part = part_of(wanted, index);
  part.old = from.present;
  if (drives) part.old.driver = driver_now(from.present);
  part.drives = drives;
  part.persists = true;
  part.ranges = ranges;
  part.alpha_from = from.present.alpha;
  add(part);
}

void Blend::add_leaving(const Part& from, bool drives, Ranges ranges) noexcept {
  Part part;
  part.old = from.present;
  keep_only(part.old, drives, ranges);
  part.origin = from.origin;
  part.move = from.move;
  part.in = from.in;
  part.drives = drives;
  part.alpha_from = from.present.alpha;
  part.present = part.old;
  add(part);
}

/// Drops the faintest of what leaves until the rest fits.
void Blend::make_room() noexcept {
  for (;;) {
    int rows = 0;
    std::size_t faintest = parts_.size();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (parts_[i].wanted < 0) {
        rows += row_bound(parts_[i].old);
        if (faintest == parts_.size() || parts_[i].alpha_from < parts_[faintest].alpha_from) faintest = i;
      }
    }
    if (rows <= leaving_row_capacity_ || faintest == parts_.size()) return;
    parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(faintest));
  }
}

Range Blend::loosened(const Range& from, const Range& to, double progress, double scale) const noexcept {
  if (from.low > to.high || to.low > from.high) return to;
  Range now = to;
  if (to.high > from.high && progress < 1.0) now.high = lerp(from.high, finite(to.high, scale), progress);
  if (to.low < from.low && progress < 1.0) now.low = lerp(from.low, finite(to.low, scale), progress);
  return now;
}

/// Makes of `c`, what the part becomes or what leaves, what is in force at `progress`.
void Blend::fade(const Part& part, double progress, AxisConstraint& c) const noexcept {
  if (part.wanted < 0) {
    c.leaving = true;
    c.alpha = lerp(part.alpha_from, 0.0, progress);
    return;
  }
  keep_only(c, part.drives, part.ranges);
  c.alpha = lerp(part.alpha_from, 1.0, progress);
  c.blend = part.entering ? duration_ : 0.0;
  if (!part.persists) return;
  const auto loosen = [&](std::optional<Range>& to, const std::optional<Range>& from) {
    if (to && from) to = loosened(*from, *to, progress, force_scale_);
  };
  loosen(c.position, part.old.position);
  loosen(c.velocity, part.old.velocity);
  loosen(c.acceleration, part.old.acceleration);
  loosen(c.force, part.old.force);
  if (c.driver && part.old.driver) {
    const double scale = c.axis >= solver::Axis::rx ? torque_scale_ : force_scale_;
    c.driver->force = loosened(part.old.driver->force, c.driver->force, progress, scale);
    c.before = part.old.driver;
    c.before->force = {};  // the driver's bounds already are on their way from the old ones
  }
  c.progress = progress;
}

void Blend::put(const std::vector<Wanted>& wanted, double progress, solver::ConstraintSet& set,
                std::vector<InForce>& in_force) noexcept {
  if (progress >= 1.0 && !settled_) settle(wanted);
  recall_what_goes_far(wanted, set);
  is_put_ = true;
  set.clear();
  in_force.clear();
  for (Part& part : parts_) {
    const bool leaves = part.wanted < 0;
    const Wanted* to = leaves ? nullptr : &wanted[static_cast<std::size_t>(part.wanted)];
    part.place = -1;
    part.far = !leaves && to->far;
    if (part.far || in_force.size() == in_force.capacity()) continue;
    if (!set.add(leaves ? part.old : to->constraint)) continue;
    part.place = static_cast<int>(in_force.size());
    fade(part, progress, set[part.place]);
    in_force.push_back({part.origin, !leaves, part.drives});
  }
}

void Blend::renew(const std::vector<Wanted>& wanted, const std::vector<int>& renewed,
                  solver::ConstraintSet& set) const noexcept {
  for (const int i : renewed) {
    const Part& part = parts_[static_cast<std::size_t>(i)];
    if (part.place < 0) continue;
    set[part.place] = wanted[static_cast<std::size_t>(i)].constraint;
    fade(part, 1.0, set[part.place]);
  }
}

}  // namespace zwang::runtime
