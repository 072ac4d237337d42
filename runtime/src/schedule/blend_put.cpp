// The sets of a blend in force at its progress: whole, or what of them is new.
#include <algorithm>

#include "schedule/blend.hpp"

namespace zwang::runtime {

namespace {

using solver::AxisConstraint;
using solver::Range;

/// These ranges, and nothing else.
void keep_ranges(unsigned ranges, AxisConstraint& c) {
  c.driver.reset();
  if ((ranges & position_bit) == 0U) c.position.reset();
  if ((ranges & velocity_bit) == 0U) c.velocity.reset();
  if ((ranges & acceleration_bit) == 0U) c.acceleration.reset();
  if ((ranges & force_bit) == 0U) c.force.reset();
}

/// The range that both allow; if they share nothing, the newer one.
Range tighter(const Range& before, const Range& now) {
  if (before.low > now.high || now.low > before.high) return now;
  return {std::max(before.low, now.low), std::min(before.high, now.high)};
}

/// A driver that goes on as one of the same kind.
bool carries_on(const AxisConstraint& before, const AxisConstraint& now) {
  return before.driver && now.driver && before.driver->makes_force() == now.driver->makes_force();
}

}  // namespace

void Blend::advance(double progress) noexcept {
  if (progress >= 1.0) count_ = 1;
  horizon_ = std::max(solver::limit_horizon, (1.0 - progress) * duration_);
  sets_[0].share = count_ == 1 ? 1.0 : progress;
  for (std::size_t set = 1; set < count_; ++set) sets_[set].share = share_from_[set] * (1.0 - progress);
}

void Blend::put(const std::vector<Wanted>& wanted, double progress) noexcept {
  advance(progress);
  is_put_ = true;
  put_newest(wanted);
  for (std::size_t set = 1; set < count_; ++set) put_before(set, wanted);
}

void Blend::put_newest(const std::vector<Wanted>& wanted) noexcept {
  BlendedSet& set = sets_[0];
  set.constraints.clear();
  set.in_force.clear();
  for (Kept& kept : kept_[0]) {
    const auto i = static_cast<std::size_t>(kept.index);
    const Wanted& w = wanted[i];
    kept.place = -1;
    if (w.far) continue;
    // The ranges of a statement without a driver are in all sets.
    const bool drives = w.constraint.driver.has_value();
    kept.place = add(set, w.constraint, {w.origin, true, drives, drives ? set.share : 1.0});
    if (kept.place >= 0 && count_ > 1) stretch(entering_[i], set.constraints[kept.place]);
  }
}

void Blend::put_before(std::size_t index, const std::vector<Wanted>& wanted) noexcept {
  BlendedSet& set = sets_[index];
  set.constraints.clear();
  set.in_force.clear();
  for (Kept& kept : kept_[index]) {
    const Wanted* to = kept.becomes < 0 ? nullptr : &wanted[static_cast<std::size_t>(kept.becomes)];
    kept.place = -1;
    if (to != nullptr && to->far && (kept.lives || kept.joins != 0U)) continue;
    if (to == nullptr && kept.fades < 0) continue;
    const AxisConstraint& c = kept.fades >= 0 ? fading(index, kept) : to->constraint;
    const bool drives = kept.joins == 0U && c.driver;
    const InForce source{to == nullptr ? kept.origin : to->origin, to != nullptr, drives, set.share};
    kept.place = add(set, c, source);
    if (to == nullptr) continue;
    if (kept.place >= 0) make_present(kept, *to, set.constraints[kept.place]);
    if (drives) carry_on(kept, c, *to, set.share);
  }
}

/// The driver of a set before counts in the alpha of the one that it goes on as.
void Blend::carry_on(const Kept& kept, const AxisConstraint& before, const Wanted& to,
                     double share) noexcept {
  if (!carries_on(before, to.constraint)) return;
  const int newest = kept_[0][static_cast<std::size_t>(kept.becomes)].place;
  if (newest >= 0) sets_[0].in_force[static_cast<std::size_t>(newest)].alpha += share;
}

/// The present form of a constraint that a set before keeps, from the one that it lives as, joins or fades
/// from.
void Blend::make_present(const Kept& kept, const Wanted& to, AxisConstraint& c) const noexcept {
  if (kept.lives) return;
  const Ranges entering = entering_[static_cast<std::size_t>(kept.becomes)];
  if (kept.joins != 0U) {
    keep_ranges(kept.joins, c);
    stretch(entering, c);
  } else if (!to.far) {
    tighten(to.constraint, entering, c);
  }
}

int Blend::add(BlendedSet& set, const AxisConstraint& constraint, const InForce& source) noexcept {
  if (set.in_force.size() == set.in_force.capacity() || !set.constraints.add(constraint)) return -1;
  set.in_force.push_back(source);
  return static_cast<int>(set.in_force.size()) - 1;
}

void Blend::stretch(Ranges entering, AxisConstraint& c) const noexcept {
  if ((entering & position_bit) != 0U) c.position_horizon = horizon_;
  if ((entering & velocity_bit) != 0U) c.velocity_horizon = horizon_;
}

/// A constraint of a set before, along the axis of one that is wanted now: no looser than that one.
void Blend::tighten(const AxisConstraint& to, Ranges entering, AxisConstraint& c) const noexcept {
  c.move = to.move;
  c.in = to.in;
  c.curvature = to.curvature;
  c.arc_length = to.arc_length;
  if (to.position && !c.position) {
    c.braking = to.braking;
    c.return_speed = to.return_speed;
  } else if (to.position) {
    c.return_speed = std::min(c.return_speed, to.return_speed);
  }
  const auto meet = [](std::optional<Range>& before, const std::optional<Range>& now) {
    if (now) before = before ? tighter(*before, *now) : *now;
  };
  stretch(entering, c);
  meet(c.position, to.position);
  meet(c.velocity, to.velocity);
  meet(c.acceleration, to.acceleration);
  if (!c.driver) meet(c.force, to.force);
  if (carries_on(c, to)) c.driver->force = tighter(c.driver->force, to.driver->force);
}

void Blend::renew(const std::vector<Wanted>& wanted, const std::vector<int>& renewed,
                  double progress) noexcept {
  if (count_ > 1) advance(progress);
  renew_newest(wanted, renewed);
  if (count_ == 1) return;
  is_renewed_.assign(wanted.size(), 0);
  for (const int i : renewed) is_renewed_[static_cast<std::size_t>(i)] = 1;
  for (std::size_t set = 1; set < count_; ++set) renew_before(set, wanted);
}

void Blend::renew_newest(const std::vector<Wanted>& wanted, const std::vector<int>& renewed) noexcept {
  BlendedSet& set = sets_[0];
  for (const int i : renewed) {
    const int place = kept_[0][static_cast<std::size_t>(i)].place;
    if (place >= 0) set.constraints[place] = wanted[static_cast<std::size_t>(i)].constraint;
  }
  if (count_ == 1) return;
  for (const Kept& kept : kept_[0]) {
    if (kept.place < 0) continue;
    InForce& source = set.in_force[static_cast<std::size_t>(kept.place)];
    source.alpha = source.drives ? set.share : 1.0;
    stretch(entering_[static_cast<std::size_t>(kept.index)], set.constraints[kept.place]);
  }
}

/// A constraint that joins or fades has its present form anew, one that lives only its new values.
void Blend::renew_before(std::size_t index, const std::vector<Wanted>& wanted) noexcept {
  BlendedSet& set = sets_[index];
  for (const Kept& kept : kept_[index]) {
    if (kept.place < 0) continue;
    InForce& source = set.in_force[static_cast<std::size_t>(kept.place)];
    source.alpha = set.share;
    if (kept.becomes < 0) continue;
    const auto i = static_cast<std::size_t>(kept.becomes);
    const Wanted& to = wanted[i];
    const AxisConstraint& c = kept.fades >= 0 ? fading(index, kept) : to.constraint;
    if (!kept.lives || is_renewed_[i] != 0) {
      set.constraints[kept.place] = c;
      make_present(kept, to, set.constraints[kept.place]);
    }
    if (source.drives) carry_on(kept, c, to, set.share);
  }
}

}  // namespace zwang::runtime
