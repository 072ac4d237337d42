// How the rows of a set become those of BoundedProblem.
//
// Of the limits of one level and side along one axis only the nearest has something to do: the others are
// idle while that one holds. Groups of ranges are full of them, so an idle limit is told before it is
// written. Where the motors do not make every motion none is idle: even a limit that has room may have to
// push there.
#include <algorithm>
#include <cmath>

#include "base/bounded_problem.hpp"

namespace zwang::solver {

namespace {

bool is_firm(const Row& row) {
  return !std::isfinite(row.weight);
}

}  // namespace

void BoundedProblem::resize(int rows) noexcept {
  rows_ = rows;
  limit_count_ = room_count_ = 0;
  last_level_ = no_level;
  are_limits_posed_ = is_axis_out_ = false;
  for (std::vector<int>* list : {&sums_, &drives_, &levels_}) list->clear();
}

void BoundedProblem::set_row(int i, const Row& row, double d, const double* B, double least_square) noexcept {
  Entry& e = entry(i);
  e.twin = -1;
  e.projected_at = no_level;
  e.axis = i;
  last_on_axis_[static_cast<std::size_t>(i)] = {};
  first_room_[static_cast<std::size_t>(i)] = -1;
  e.B = B;
  e.extent = extent_of(e.B);
  const double squared = dot(e.extent, e.B, e.B);
  e.length = std::sqrt(squared);
  e.inverse_length = squared > 0.0 ? e.length * (1.0 / squared) : 0.0;
  e.reachable = squared >= least_square && squared > 0.0;
  is_axis_out_ = is_axis_out_ || !e.reachable;
  take_row(i, row, d);
}

void BoundedProblem::list_drive(int i) noexcept {
  take_source(i);
  (entry(i).kind == RowKind::sum ? sums_ : drives_).push_back(i);
}

/// All of an entry that its source says. A weight decides how much of b is worth reaching, R = 1/w;
/// what was reached is kept firmly against the levels below.
void BoundedProblem::take_source(int i) noexcept {
  Entry& e = entry(i);
  const Row& row = *e.source;
  e.is_posed = true;
  if (e.twin >= 0) {
    const Entry& first = entry(e.twin);
    e.B = first.B;
    e.extent = first.extent;
    e.length = first.length;
    e.inverse_length = first.inverse_length;
    e.reachable = first.reachable;
  }
  e.reset();
  e.kind = row.kind;
  e.is_limit = is_limit(row.kind);
  e.quantity = row.quantity;
  e.level = row.level;
  e.lo = row.lo;
  e.hi = row.hi;
  e.bounded_below = std::isfinite(row.lo);
  e.bounded_above = std::isfinite(row.hi);
  const bool is_motion = e.is_limit || e.kind == RowKind::driver;
  e.softness = is_motion && !is_firm(row) ? 1.0 / row.weight : 0.0;
  e.force = row.force;
  e.out = !e.reachable;
  e.status = e.out ? RowStatus::unreachable : RowStatus::held;
}

bool BoundedProblem::can_be_idle(int i) const noexcept {
  const Entry& e = entries_[static_cast<std::size_t>(i)];
  return motors_reach_all_ && is_limit(e.source->kind) && is_firm(*e.source) &&
         entries_[static_cast<std::size_t>(e.axis)].reachable;
}

/// The limits of a side of an axis so far, without idle ones: as few as there are levels and equal limits.
int& BoundedProblem::last_beside(int i) noexcept {
  Sides& last = last_on_axis_[axis_of(i)];
  return entry(i).source->kind == RowKind::upper ? last.upper : last.lower;
}

/// Whether a limit lies beyond a listed one of its level. Listed ones beyond it are idle, and leave the list.
bool BoundedProblem::is_beyond_another(int i) noexcept {
  const Row& row = *entry(i).source;
  const double side = row.kind == RowKind::upper ? 1.0 : -1.0;
  for (int* k = &last_beside(i); *k >= 0;) {
    Entry& other = entry(*k);
    if (other.level == row.level) {
      if (is_beyond(d_(i), d_(*k), side)) return true;
      other.is_posed = !is_beyond(d_(*k), d_(i), side);
    }
    if (!other.is_posed) {
      *k = other.limit_before;
    } else {
      k = &other.limit_before;
    }
  }
  return false;
}

void BoundedProblem::list_limit(int i) noexcept {
  int& last = last_beside(i);
  entry(i).limit_before = last;
  last = i;
}

void BoundedProblem::pose_limits() noexcept {
  if (are_limits_posed_) return;
  are_limits_posed_ = true;
  awake_.clear();
  idle_.clear();
  for (const int i : limits()) {
    if (can_be_idle(i) && is_beyond_another(i)) continue;
    if (!entry(i).is_posed) take_source(i);  // else it pushes already
    if (can_be_idle(i)) list_limit(i);
  }
  for (int i = 0; i < rows_; ++i) (entry(i).is_posed ? awake_ : idle_).push_back(i);
}

void BoundedProblem::note_level(int level) noexcept {
  last_level_ = level;
  if (std::find(levels_.begin(), levels_.end(), level) != levels_.end()) return;
  levels_.insert(std::upper_bound(levels_.begin(), levels_.end(), level), level);
}

}  // namespace zwang::solver
