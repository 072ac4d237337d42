#include "schedule/blend.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

namespace {

using solver::AxisConstraint;
using solver::Driver;
using solver::Range;

unsigned ranges_of(const AxisConstraint& c) {
  return (c.position ? position_bit : 0U) | (c.velocity ? velocity_bit : 0U) |
         (c.acceleration ? acceleration_bit : 0U) | (c.force ? force_bit : 0U);
}

/// Of a boundary other pairs of features may have come near since.
bool is_same_statement(const Origin& a, const Origin& b) {
  return a.task == b.task && a.group == b.group && a.axis == b.axis;
}

/// A boundary's ranges come and go with its distance: it carries whatever there is.
unsigned ranges_of(const Wanted& wanted) {
  return wanted.fence ? all_bits : ranges_of(wanted.constraint);
}

bool same(const solver::AttachedFrame& a, const solver::AttachedFrame& b) {
  return a.body == b.body && a.pose.rotation == b.pose.rotation && a.pose.position == b.pose.position;
}

/// A frame that a signal moves is the same one wherever it is; one that was set in between is another.
bool same(const FrameKey& a, const FrameKey& b) {
  return a.frame >= 0 && a.frame == b.frame && a.settings == b.settings;
}

bool same(const Range& a, const Range& b) {
  return a.low == b.low && a.high == b.high;
}

bool same(const std::optional<Range>& a, const std::optional<Range>& b) {
  return a.has_value() == b.has_value() && (!a || same(*a, *b));
}

/// The same coordinate of the two frames that a constraint speaks of.
bool measures_alike(const AxisConstraint& a, const AxisConstraint& b) {
  return a.measure == b.measure && a.axis == b.axis && a.other_axis == b.other_axis &&
         a.coefficients == b.coefficients;
}

/// The same demand; of one that is measured, whatever the measurement says.
bool asks_alike(const Driver& a, const Driver& b, bool measured) {
  const bool is_one_kind = a.quantity == b.quantity && a.time_constant == b.time_constant &&
                           a.stiffness == b.stiffness && a.damping == b.damping && same(a.force, b.force);
  return is_one_kind && (measured || (a.target == b.target && a.target_rate == b.target_rate &&
                                      a.target_acceleration == b.target_acceleration));
}

/// Of what a constraint said, and of what another one says: the same ranges, as firm.
template <class Said>
bool limits_alike(const Said& a, const AxisConstraint& b) {
  return a.weight == b.weight && same(a.position, b.position) && same(a.velocity, b.velocity) &&
         same(a.acceleration, b.acceleration) && same(a.force, b.force);
}

bool drives_alike(const AxisConstraint& a, const AxisConstraint& b, bool measured) {
  return a.driver.has_value() == b.driver.has_value() &&
         (!a.driver || asks_alike(*a.driver, *b.driver, measured));
}

}  // namespace

int row_bound(const AxisConstraint& c) noexcept {
  return (c.driver || c.force ? 1 : 0) +
         2 * (static_cast<int>(c.position.has_value()) + static_cast<int>(c.velocity.has_value()) +
              static_cast<int>(c.acceleration.has_value()));
}

Blend::Blend(std::size_t most_wanted, int most_rows, double horizon) : most_kept_rows_(3 * most_rows) {
  // A kept constraint has a row at least, or is of `always` and out of reach; a wanted one may join it.
  const std::size_t capacity = static_cast<std::size_t>(most_kept_rows_) + 2 * most_wanted + 1;
  for (BlendedSet& set : sets_) {
    set.constraints =
        solver::ConstraintSet(static_cast<int>(capacity), std::max(1, rows_of_a_set(most_rows)), horizon);
    set.in_force.reserve(capacity);
  }
  for (KeptList& kept : kept_) kept.reserve(capacity);
  for (std::vector<AxisConstraint>& fading : fading_) fading.reserve(capacity);
  taken_.reserve(most_wanted);
  is_renewed_.reserve(most_wanted);
  carried_.reserve(most_wanted);
  entering_.reserve(most_wanted);
}

void Blend::start(const std::vector<Wanted>& wanted, double duration) noexcept {
  is_put_ = false;
  duration_ = duration;
  if (!(duration > 0.0)) {
    count_ = 0;
  } else if (count_ == 0) {
    start_from_always(wanted);
  } else {
    for (std::size_t set = 0; set < count_; ++set) recall(set);
    make_room();
  }
  push_front(wanted);
  for (std::size_t set = 1; set < count_; ++set) relate(set, wanted);
  find_entering(wanted);
}

/// The constraints before a run: those of `always`, so that its rows hold from the first tick on.
void Blend::start_from_always(const std::vector<Wanted>& wanted) noexcept {
  kept_[0].clear();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i].always) kept_[0].push_back(kept_of(wanted, i));
  }
  sets_[0].share = 1.0;
  count_ = 1;
}

Blend::Kept Blend::kept_of(const std::vector<Wanted>& wanted, std::size_t index) noexcept {
  const Wanted& w = wanted[index];
  Kept kept;
  kept.origin = w.origin;
  kept.move = w.move;
  kept.in = w.in;
  kept.always = w.always;
  kept.fence = w.fence;
  kept.lost = w.lost;
  kept.index = static_cast<int>(index);
  if (w.always && !w.fence) kept.said = said_by(w.constraint);
  return kept;
}

Blend::Said Blend::said_by(const AxisConstraint& c) noexcept {
  return {c.position, c.velocity, c.acceleration, c.force, c.weight};
}

/// Its constraints that were put last; those of `always`, too, that are out of reach.
void Blend::recall(std::size_t set) noexcept {
  KeptList& all = kept_[set];
  for (Kept& kept : all) {
    if (kept.place >= 0 && kept.fence)
      kept.origin = sets_[set].in_force[static_cast<std::size_t>(kept.place)].origin;
    if (kept.joins != 0U) kept.always = false;
    if (kept.place >= 0 && kept.always) kept.said = said_by(put_last(set, kept));
  }
  std::erase_if(all, [](const Kept& kept) { return kept.place < 0 && !kept.always; });
}

int Blend::row_bound(std::size_t set) const noexcept {
  int rows = 0;
  for (const Kept& kept : kept_[set]) rows += kept.place >= 0 ? runtime::row_bound(put_last(set, kept)) : 0;
  return rows;
}

/// The faintest set gives way to one more, and any set that switches without end have filled with ranges.
void Blend::make_room() noexcept {
  for (std::size_t set = count_; set-- > 0;) {
    if (count_ > 1 && row_bound(set) > most_kept_rows_) drop(set);
  }
  if (count_ < most_sets) return;
  std::size_t faintest = 0;
  for (std::size_t set = 1; set < count_; ++set) {
    if (sets_[set].share < sets_[faintest].share) faintest = set;
  }
  drop(faintest);
}

/// The others take its share, each its part of it.
void Blend::drop(std::size_t set) noexcept {
  const auto to_the_end = [&](auto& list) {
    std::rotate(list.begin() + static_cast<std::ptrdiff_t>(set),
                list.begin() + static_cast<std::ptrdiff_t>(set) + 1,
                list.begin() + static_cast<std::ptrdiff_t>(count_));
  };
  to_the_end(sets_);
  to_the_end(kept_);
  to_the_end(fading_);
  --count_;
  double sum = 0.0;
  for (const BlendedSet& left : sets()) sum += left.share;
  for (BlendedSet& left : sets()) left.share /= sum;
}

void Blend::push_front(const std::vector<Wanted>& wanted) noexcept {
  std::rotate(sets_.begin(), sets_.end() - 1, sets_.end());
  std::rotate(kept_.begin(), kept_.end() - 1, kept_.end());
  std::rotate(fading_.begin(), fading_.end() - 1, fading_.end());
  ++count_;
  sets_[0].share = count_ == 1 ? 1.0 : 0.0;
  for (std::size_t set = 0; set < count_; ++set) share_from_[set] = sets_[set].share;
  kept_[0].clear();
  for (std::size_t i = 0; i < wanted.size(); ++i) kept_[0].push_back(kept_of(wanted, i));
}

/// Which of what is wanted each constraint of a set goes on as, and which ranges join the set.
void Blend::relate(std::size_t set, const std::vector<Wanted>& wanted) noexcept {
  taken_.assign(wanted.size(), 0);
  carried_.assign(wanted.size(), 0);
  fading_[set].clear();
  for (Kept& kept : kept_[set]) {
    kept.joins = 0;
    kept.fades = -1;
    kept.becomes = match(set, kept, wanted);
    if (kept.becomes < 0) {
      fade(set, kept, nullptr);
      continue;
    }
    const auto i = static_cast<std::size_t>(kept.becomes);
    const Wanted& w = wanted[i];
    taken_[i] = 1;
    kept.lives = w.fence || is_unchanged(set, kept, w);
    if (!kept.lives) fade(set, kept, &w);
    // A sum beside a driver of the set holds for others than this driver: it joins on its own.
    carried_[i] |= kept.lives || !fading(set, kept).driver ? all_bits : all_bits & ~force_bit;
    kept.index = kept.becomes;
  }
  join_ranges(set, wanted);
}

void Blend::join_ranges(std::size_t set, const std::vector<Wanted>& wanted) noexcept {
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Ranges joins = ranges_of(wanted[i]) & ~carried_[i];
    if (joins == 0U || kept_[set].size() == kept_[set].capacity()) continue;
    Kept& kept = kept_[set].emplace_back(kept_of(wanted, i));
    kept.becomes = static_cast<int>(i);
    kept.joins = joins;
  }
}

/// Whether it is what is wanted now. Out of force, it is of `always` and drives nothing.
bool Blend::is_unchanged(std::size_t set, const Kept& kept, const Wanted& w) const noexcept {
  if (kept.lost != w.lost) return false;
  if (kept.place < 0) return limits_alike(kept.said, w.constraint);
  const AxisConstraint& put = put_last(set, kept);
  return limits_alike(put, w.constraint) && drives_alike(put, w.constraint, w.measured);
}

/// Keeps it as it was put last; out of force, as it said last.
void Blend::fade(std::size_t set, Kept& kept, const Wanted* now) noexcept {
  std::vector<AxisConstraint>& all = fading_[set];
  if (kept.place < 0 && now == nullptr) return;
  kept.fades = static_cast<int>(all.size());
  AxisConstraint& c = all.emplace_back(kept.place >= 0 ? put_last(set, kept) : now->constraint);
  c.position_horizon = c.velocity_horizon = solver::limit_horizon;
  if (kept.place >= 0) return;
  c.position = kept.said.position;
  c.velocity = kept.said.velocity;
  c.acceleration = kept.said.acceleration;
  c.force = kept.said.force;
  c.weight = kept.said.weight;
}

int Blend::match(std::size_t set, const Kept& kept, const std::vector<Wanted>& wanted) const noexcept {
  const auto is_match = [&](std::size_t i) {
    const Wanted& w = wanted[i];
    if (taken_[i] != 0 || (w.far && !w.always)) return false;
    if (kept.always || w.always) return kept.always && w.always && is_same_statement(kept.origin, w.origin);
    const AxisConstraint& a = put_last(set, kept);
    const AxisConstraint& b = w.constraint;
    return measures_alike(a, b) && a.level == b.level && (same(kept.move, w.move) || same(a.move, b.move)) &&
           (same(kept.in, w.in) || same(a.in, b.in));
  };
  // `always` is listed first, and stays where it is.
  const auto own = static_cast<std::size_t>(kept.index);
  if (kept.always) return own < wanted.size() && is_match(own) ? kept.index : -1;
  if (kept.place < 0) return -1;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (is_match(i)) return static_cast<int>(i);
  }
  return -1;
}

void Blend::find_entering(const std::vector<Wanted>& wanted) noexcept {
  entering_.assign(wanted.size(), 0);
  if (count_ < 2) return;
  for (std::size_t i = 0; i < wanted.size(); ++i) entering_[i] = ranges_of(wanted[i]);
  for (const Kept& kept : kept_[1]) {
    if (kept.becomes < 0 || kept.joins != 0U) continue;
    Ranges& entering = entering_[static_cast<std::size_t>(kept.becomes)];
    entering &= kept.lives || kept.fence ? 0U : ~ranges_of(fading(1, kept));
  }
}

}  // namespace zwang::runtime
