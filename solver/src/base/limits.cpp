// The one-sided rows of a stage: which of them are posed, and what is known of them beforehand.
//
// Limits along one axis are two ends of a range, ranges of several quantities, ranges of several levels.
// Mostly one of them decides, and their bounds tell which:
//
//   a limit beyond another one of its side            has nothing to do while that one holds
//   a limit that contradicts one of a level above     pushes with all its force, and in vain
//
// Both are left out. The first is idle: if the other limit has the same level, the first is left out of all
// that follows. The second is left out of a stage. Its force stays, and the limit above pushes against it.
// Most other limits have room, and wait. The drivers are solved for alone, and the limits that they would
// break join.
//
//   a driver that mostly wants what such a limit forbids    pushes with all its force, and in vain, too
//
// When the stage is solved, the assumptions about the rows that were left out are checked. If one does not
// hold, as when a limit's force did not suffice, all rows take part. Limits that yield (with a weight) and
// equal limits, which share their force, are never left out for another one.
#include <algorithm>
#include <cmath>

#include "base/bounded_problem.hpp"

namespace zwang::solver {

namespace {

constexpr double mostly_along = 0.7;      // a cosine
constexpr double limit_rounding = 1e-12;  // the same, of a limit that stands where it pushes to

}  // namespace

/// Whether the idle limits of this level have room, as they do where the nearest ones hold; the levels below
/// leave those as they are.
bool BoundedProblem::idle_limits_rest(int level) noexcept {
  return std::all_of(idle_.begin(), idle_.end(), [this, level](int i) {
    const Row& row = *entry(i).source;
    if (row.level != level) return true;
    const double beyond = along(entry(i).axis, p_) - d_(i);
    return (row.kind == RowKind::upper ? -beyond : beyond) > tie * std::abs(d_(i));
  });
}

/// From this level on they take part.
void BoundedProblem::wake_idle_limits(int level) noexcept {
  if (idle_.empty()) return;
  for (const int i : idle_) {
    take_source(i);
    bound(i);
  }
  idle_.clear();
  awake_.clear();
  for (int i = 0; i < rows_; ++i) awake_.push_back(i);
  project_rows(level);
}

/// The acceleration that a posed limit asks for.
double BoundedProblem::target_of(int i) const noexcept {
  return d_(i) + entries_[static_cast<std::size_t>(i)].offset;
}

bool BoundedProblem::is_firm_limit(int i, int level) noexcept {
  return is_one_sided(i) && softness_at(i, level) == 0.0;
}

/// Of the firm limits of the levels above along each axis those that leave the least room, by side.
void BoundedProblem::find_nearest_above(int level) noexcept {
  for (const int i : motions_) nearest_[axis_of(i)] = {};
  for (const int i : limits_above_) nearest_[axis_of(i)] = {};
  for (const int i : limits_above_) {
    if (!is_firm_limit(i, level)) continue;
    const bool is_upper = entry(i).kind == RowKind::upper;
    int& place = is_upper ? nearest_[axis_of(i)].upper : nearest_[axis_of(i)].lower;
    if (place < 0 || is_beyond(target_of(place), target_of(i), is_upper ? 1.0 : -1.0)) place = i;
  }
}

/// Whether a limit pushes in vain against one of a level above, which is told of it.
bool BoundedProblem::gives_in(int i, int level) noexcept {
  Entry& e = entry(i);
  const bool is_upper = e.kind == RowKind::upper;
  const Sides& nearest = nearest_[axis_of(i)];
  const int opposite = is_upper ? nearest.lower : nearest.upper;
  if (e.level != level || !is_firm_limit(i, level) || opposite < 0) return false;
  if (!is_beyond(target_of(opposite), target_of(i), is_upper ? 1.0 : -1.0)) return false;
  bound(i);
  e.nu = is_upper ? e.lo : e.hi;
  entry(opposite).nu -= e.nu;
  return true;
}

/// Takes out of posed_ what need not be solved for, and what may not have to.
void BoundedProblem::fold_limits(int level) noexcept {
  folded_.clear();
  waiting_.clear();
  find_nearest_above(level);
  std::size_t kept = 0;
  for (const int i : posed_) {
    if (!is_one_sided(i)) {
      posed_[kept++] = i;
    } else if (gives_in(i, level)) {
      folded_.push_back(i);
    } else if (entry(i).nu == 0.0) {
      waiting_.push_back(i);
    } else {
      posed_[kept++] = i;
    }
  }
  posed_.resize(kept);
}

/// Poses the waiting limits that the motion in work_ would break, and folds the others. False when it breaks
/// none.
bool BoundedProblem::recall_limits() noexcept {
  const std::size_t before = posed_.size();
  for (const int i : waiting_) (has_clear_room(i) ? folded_ : posed_).push_back(i);
  waiting_.clear();
  if (posed_.size() == before) return false;
  for (std::size_t k = posed_.size(); k-- > before;) fold_driver_beyond(posed_[k]);
  return true;
}

/// The first driver that mostly wants what a limit forbids.
void BoundedProblem::fold_driver_beyond(int limit) noexcept {
  const Entry& e = entry(limit);
  for (std::size_t k = 0; k < posed_.size(); ++k) {
    const int i = posed_[k];
    Entry& driver = entry(i);
    if (driver.kind != RowKind::driver || driver.softness > 0.0) continue;
    const double cosine = dot(std::min(e.reach_extent, driver.reach_extent), e.V, driver.V) *
                          e.inverse_reach * driver.inverse_reach;
    if (std::abs(cosine) < mostly_along) continue;
    driver.nu = (cosine > 0.0) == (e.kind == RowKind::upper) ? driver.hi : driver.lo;
    if (driver.nu == 0.0) return;
    folded_.push_back(i);
    posed_.erase(posed_.begin() + static_cast<std::ptrdiff_t>(k));
    return;
  }
}

/// Whether the motion in work_ leaves the first folded limits as assumed: clear room for the limits without
/// force, clearly none for the others. A limit between the two may share a force with another one.
bool BoundedProblem::folded_limits_rest(std::size_t first) noexcept {
  return std::all_of(folded_.begin(), folded_.begin() + static_cast<std::ptrdiff_t>(first),
                     [this](int i) { return has_clear_room(i); });
}

/// Of a limit without force at work_; of a row that pushes in vain, that it clearly misses what it wants.
bool BoundedProblem::has_clear_room(int i) noexcept {
  const Entry& e = entry(i);
  double room = 0.0;
  if (e.is_limit) {
    room = e.nu == 0.0 ? room_of(i, work_) : -room_of(i, work_);
  } else {
    room = std::copysign(1.0, e.nu) * (d_(i) - along(i, work_));
  }
  return room > tie * std::abs(target_of(i));
}

/// Drivers push what the next solution says.
void BoundedProblem::release_drivers() noexcept {
  for (const int i : folded_) {
    if (!is_one_sided(i)) entry(i).nu = 0.0;
  }
}

void BoundedProblem::unfold_limits() noexcept {
  posed_.insert(posed_.end(), folded_.begin(), folded_.end());
  folded_.clear();
}

/// Adds the limits of the levels above: they are posed again.
void BoundedProblem::pose_limits_above() noexcept {
  for (const int i : limits_above_) posed_.push_back(i);
}

/// Whether the posed limits hold at work_ with the multipliers that they have.
bool BoundedProblem::limits_above_hold(int first) noexcept {
  for (std::size_t k = static_cast<std::size_t>(first); k < posed_.size(); ++k) {
    if (room_of(posed_[k], work_) < 0.0) return false;
  }
  return true;
}

/// Of a limit that takes no share of what another one pushes.
double BoundedProblem::least_room(int i) noexcept {
  return 1e3 * limit_rounding * (std::abs(d_(i)) + std::abs(entry(i).offset));
}

/// Whether the posed rows are limits that the present motion satisfies. A limit that pushes stands exactly at
/// its bound, and the others have room. (At no room without a push the share between equals is open.)
bool BoundedProblem::limits_rest(int level) noexcept {
  bool pushes = false;
  for (const int i : posed_) {
    if (!is_one_sided(i)) return false;
    pushes = pushes || entry(i).nu != 0.0;
  }
  for (const int i : posed_) {
    const double room = room_of(i, p_);
    const bool stands =
        entry(i).nu != 0.0 && entry(i).level < level && std::abs(room) <= 1e-3 * least_room(i);
    const bool is_free = entry(i).nu == 0.0 && (pushes ? room > least_room(i) : room >= 0.0);
    if (!stands && !is_free) return false;
  }
  return true;
}

/// fixed_ = p without what the posed limits push.
void BoundedProblem::take_out_limits(const Vector& p) noexcept {
  copy(p, fixed_);
  for (const int i : posed_) {
    if (is_one_sided(i)) push(i, -entry(i).nu, fixed_);
  }
}

/// Where the posed rows from `first` on are limits at rest, and one of them alone stands in the way: what it
/// pushes is added to p.
BoundedProblem::Push BoundedProblem::push_alone(int first, int level, Vector& p) noexcept {
  Push push;
  double miss = 0.0;
  for (std::size_t k = static_cast<std::size_t>(first); k < posed_.size(); ++k) {
    const int i = posed_[k];
    if (!is_one_sided(i) || entry(i).nu != 0.0) return {};
    const double room = room_of(i, p);
    if (room >= 0.0) continue;
    if (push.row >= 0) return {};
    push.row = i;
    miss = entry(i).kind == RowKind::upper ? room : -room;
  }
  if (push.row < 0) return {};
  const Entry& e = entry(push.row);
  push.nu = miss / (e.reach * e.reach + softness_at(push.row, level));
  bound(push.row);
  const Range bounds = bounds_at(push.row, level);
  if (push.nu < bounds.low || push.nu > bounds.high) return {};
  this->push(push.row, push.nu, p);
  for (std::size_t k = static_cast<std::size_t>(first); k < posed_.size(); ++k) {
    const int i = posed_[k];
    if (i == push.row || room_of(i, p) > least_room(i)) continue;
    this->push(push.row, -push.nu, p);
    return {};
  }
  return push;
}

/// The same for a level's motion.
bool BoundedProblem::one_limit_settles(int level) noexcept {
  if (!motors_reach_all_) return false;
  copy(p_, work_);
  const Push alone = push_alone(0, level, work_);
  if (alone.row < 0 || !sums_hold(level, work_) || !torques_for(work_)) return false;
  entry(alone.row).nu = alone.nu;
  tau_.head(motors_) = candidate_.head(motors_);
  torques_are_least_ = true;
  copy(work_, p_);
  take_offsets(level);
  return true;
}

/// How far beyond b a level leaves its limits: what it could not hold, or was not worth it.
void BoundedProblem::take_offsets(int level) noexcept {
  for (const int i : posed_) {
    if (!is_one_sided(i) || entry(i).level != level) continue;
    const double miss = std::max(0.0, -room_of(i, p_));
    entry(i).offset = entry(i).kind == RowKind::lower ? -miss : miss;
  }
}

}  // namespace zwang::solver
