// Plain levels, as most are: few rows meet, no motor is at its limit, and no two rows tie. Of the rows that
// decide, the drivers and the limits that push, some are free, the others stand at a bound:
//
//   (V V' + R) nu = d - B.p     of the free ones, V = K B, p with the forces of the others
//
//   a driver beyond a bound of its force stands at that bound; it is free again when it wants away;
//   a limit without room pushes; it is left alone again when it would have to pull
//
// until none changes. The limits along one axis leave an interval of accelerations, so room is a question to
// each axis and not to each limit. A motion that keeps all of this is the minimum of (15), and there is one
// only. Whatever is not clear within a few rounds is left to the stages.
#include <algorithm>
#include <cmath>

#include "base/bounded_problem.hpp"

namespace zwang::solver {

namespace {

// Of a row, its share that the others leave. V V' loses its digits with 1/share, a stage refines its step.
constexpr double ample_pivot = 1e-3;
// Mostly it takes one to four. Of a thousand busy problems one goes in circles; a stage solves that.
constexpr int most_rounds = 10;

}  // namespace

void BoundedProblem::start_room() noexcept {
  for (const int axis : limited_axes_) room_[static_cast<std::size_t>(axis)] = {};
  limited_axes_.clear();
  pushing_.clear();
}

/// A limit leaves an interval along its axis. Clear room is more than a tie:  b - s > tie |b|.
void BoundedProblem::note_limit(int i) noexcept {
  const Row& row = *entry(i).source;
  int& first = first_room_[axis_of(i)];
  int k = first;
  while (k >= 0 && rooms_[static_cast<std::size_t>(k)].level != row.level)
    k = rooms_[static_cast<std::size_t>(k)].other;
  if (k < 0) {
    k = room_count_++;
    rooms_[static_cast<std::size_t>(k)] = {.axis = entry(i).axis, .level = row.level, .other = first};
    first = k;
  }
  Room& room = rooms_[static_cast<std::size_t>(k)];
  const bool is_upper = row.kind == RowKind::upper;
  const double side = is_upper ? 1.0 : -1.0;
  join(is_upper ? room.upper : room.lower, {d_(i) - side * tie * std::abs(d_(i)), i}, side);
}

/// The limits of one more level. False where one comes to a limit that pushes, or contradicts another one:
/// the two ends of an axis leave no interval then.
bool BoundedProblem::allow(int level) noexcept {
  for (int k = 0; k < room_count_; ++k) {
    const Room& own = rooms_[static_cast<std::size_t>(k)];
    if (own.level != level || !entry(own.axis).reachable) continue;
    Room& room = room_[static_cast<std::size_t>(own.axis)];
    if (room.axis < 0) limited_axes_.push_back(own.axis);
    room.axis = own.axis;
    if (!join(room.upper, own.upper, 1.0) || !join(room.lower, own.lower, -1.0)) return false;
    if (room.lower.least > room.upper.least) return false;
  }
  return true;
}

/// One more limit at an end. Mostly it is the first one there, or lies far beyond.
bool BoundedProblem::join(End& end, const End& other, double side) const noexcept {
  if (other.row < 0) return true;
  if (end.pushes) return false;
  if (end.row >= 0) {
    const double beyond = side * (other.least - end.least), rounding = tie * std::abs(d_(other.row));
    if (beyond > 4.0 * rounding) return true;
    const bool is_nearer = beyond < 0.0;
    const bool is_clear = is_beyond(d_(end.row), d_(other.row), is_nearer ? side : -side);
    end.is_tied = !is_clear || (is_nearer ? other.is_tied : end.is_tied);
    if (!is_nearer) return true;
  } else {
    end.is_tied = other.is_tied;
  }
  end.least = other.least;
  end.row = other.row;
  return true;
}

bool BoundedProblem::limits_have_room(const Vector& p) const noexcept {
  return std::all_of(limited_axes_.begin(), limited_axes_.end(), [this, &p](int axis) {
    const Room& room = room_[static_cast<std::size_t>(axis)];
    const double s = along(axis, p);
    return s > room.lower.least && s < room.upper.least;
  });
}

/// p without what the limits above push, and with the forces of the level in full, into fixed_.
bool BoundedProblem::push_plainly(int level, int max_rounds) noexcept {
  copy(p_, fixed_);
  for (const int i : pushing_) {
    project_row(i, level);
    if (entry(i).reach > 0.0) push(i, -entry(i).nu, fixed_);
  }
  if (forces_.empty()) return true;
  for (const int i : forces_) push(i, entry(i).force, fixed_);
  if (pushing_.empty() && limits_have_room(fixed_)) return sums_hold(level, fixed_) && torques_for(fixed_);
  // The limits above brake the forces, before a driver of the level has its say.
  later_motions_.clear();
  later_motions_.swap(motions_);
  const bool is_plain = find_plain_motion(level, max_rounds);
  motions_.swap(later_motions_);
  return is_plain;
}

double BoundedProblem::parked_force(std::size_t k) noexcept {
  const Entry& e = entry(motions_[k]);
  return parked_[k] > 0 ? e.hi : e.lo;
}

/// The k-th free row depends on those before, V_k = sum c_l V_l, as drivers do that want what a limit
/// forbids. The rows push against each other without any motion:  nu_k += t, nu_l -= c_l t. Of both ways the
/// one leads down that has (d - B.p)' nu rise. The driver that meets its bound first stands there, and a
/// limit that would have to pull is left alone. False where neither is, or where the ways tie.
bool BoundedProblem::park_dependent(int k) noexcept {
  double* const rate = free_work_.data();
  for (int l = 0; l < k; ++l) rate[l] = -free_factor_(k, l);
  for (int l = k - 1; l > 0; --l) add_multiple(l, -rate[l], &free_factor_(l, 0), rate);
  rate[k] = 1.0;
  double gain = 0.0, size = 0.0;  // of (d - B.p)' nu
  for (int l = 0; l <= k; ++l) {
    const double term = rate[l] * free_nu_(l);
    gain += term;
    size += std::abs(term);
  }
  if (std::abs(gain) <= tie * size) return false;
  const double way = std::copysign(1.0, gain);
  double least = infinity;
  int first = -1;
  bool goes_up = false;
  for (int l = 0; l <= k; ++l) {
    const Entry& e = entry(free_rows_[static_cast<std::size_t>(l)]);
    const double speed = way * rate[l] * e.inverse_reach;
    const double room = speed > 0.0 ? e.hi - e.plain_nu : e.plain_nu - e.lo;
    if (!(room < least * std::abs(speed))) continue;
    least = room / std::abs(speed);
    first = free_rows_[static_cast<std::size_t>(l)];
    goes_up = speed > 0.0;
  }
  if (first < 0) return false;
  if (is_one_sided(first)) {
    if (entry(first).kind == RowKind::upper ? !goes_up : goes_up) return false;
    release(first);
    pushing_.erase(std::find(pushing_.begin(), pushing_.end(), first));
    return true;
  }
  const auto place = std::find(motions_.begin(), motions_.end(), first) - motions_.begin();
  parked_[static_cast<std::size_t>(place)] = goes_up ? 1 : -1;
  return true;
}

/// The limits that push come first. The forces of the others are added to work_.
void BoundedProblem::list_free_rows() noexcept {
  copy(fixed_, work_);
  free_rows_.clear();
  for (const int i : pushing_) {
    if (entry(i).reach > 0.0) free_rows_.push_back(i);
  }
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    const int i = motions_[k];
    if (parked_[k] == 0) {
      free_rows_.push_back(i);
    } else {
      push(i, entry(i).plain_nu = parked_force(k), work_);
    }
  }
}

/// The free rows' nu, and the motion with it into work_. `some`: another row is free.
BoundedProblem::Change BoundedProblem::drive_plainly() noexcept {
  list_free_rows();
  const auto n = static_cast<int>(free_rows_.size());
  double* const nu = free_nu_.data();
  for (int k = 0; k < n; ++k) {
    const int i = free_rows_[static_cast<std::size_t>(k)];
    nu[k] = (d_(i) - along(i, work_)) * entry(i).inverse_reach;
    if (!factorise_plainly(k)) return park_dependent(k) ? Change::some : Change::unclear;
  }
  substitute(free_factor_, free_inverse_D_, n, nu);
  for (int k = 0; k < n; ++k) {
    const int i = free_rows_[static_cast<std::size_t>(k)];
    Entry& e = entry(i);
    push(i, e.plain_nu = nu[k] * e.inverse_reach, work_);
  }
  return Change::none;
}

/// The k-th line of V V' + R, of rows of length 1, eliminated.
bool BoundedProblem::factorise_plainly(int k) noexcept {
  double* const t = free_work_.data();
  const Entry& e = entry(free_rows_[static_cast<std::size_t>(k)]);
  const double unit = e.inverse_reach, own = 1.0 + e.softness * unit * unit;
  for (int l = 0; l < k; ++l) {
    const Entry& other = entry(free_rows_[static_cast<std::size_t>(l)]);
    t[l] = dot(std::min(e.reach_extent, other.reach_extent), e.V, other.V) * (unit * other.inverse_reach);
  }
  const double pivot = eliminate_row(free_factor_, free_inverse_D_, k, own, t);
  free_inverse_D_(k) = 1.0 / pivot;
  return pivot > ample_pivot * own;
}

/// Drivers beyond a bound, and those at one that want away.
BoundedProblem::Change BoundedProblem::change_drivers() noexcept {
  Change change = Change::none;
  for (std::size_t k = 0; k < motions_.size(); ++k) {
    const int i = motions_[k];
    const Entry& e = entry(i);
    if (parked_[k] == 0) {
      if (e.plain_nu > e.lo && e.plain_nu < e.hi) continue;
      parked_[k] = e.plain_nu >= e.hi ? 1 : -1;
    } else {
      const double s = along(i, work_) + e.softness * e.plain_nu;
      const double wanted = parked_[k] > 0 ? d_(i) - s : s - d_(i),
                   rounding = tie * (std::abs(d_(i)) + std::abs(s));
      if (wanted > rounding) continue;
      if (wanted > -rounding) return Change::unclear;
      parked_[k] = 0;
    }
    change = Change::some;
  }
  return change;
}

/// Limits that would have to pull, and the one that is farthest from having room.
BoundedProblem::Change BoundedProblem::change_limits(int level) noexcept {
  Change change = Change::none;
  std::size_t kept = 0;
  for (const int i : pushing_) {
    const Entry& e = entry(i);
    const bool is_upper = e.kind == RowKind::upper;
    if (e.reach == 0.0 || (is_upper ? e.plain_nu < 0.0 : e.plain_nu > 0.0)) {
      if (e.reach > 0.0 && e.level == level && (e.plain_nu < e.lo || e.plain_nu > e.hi))
        return Change::unclear;
      pushing_[kept++] = i;
      continue;
    }
    release(i);
    change = Change::some;
  }
  pushing_.resize(kept);
  if (change == Change::some) return change;  // a limit just left alone stands at its bound: no room yet
  End* farthest = nullptr;
  double most = -1.0;
  for (const int axis : limited_axes_) {
    Room& room = room_[static_cast<std::size_t>(axis)];
    const double s = along(axis, work_);
    const bool is_above = !room.upper.pushes && !(s < room.upper.least);
    if (!is_above && (room.lower.pushes || s > room.lower.least)) continue;
    const double beyond =
        (is_above ? s - room.upper.least : room.lower.least - s) * entry(axis).inverse_length;
    if (beyond <= most) continue;
    most = beyond;
    farthest = is_above ? &room.upper : &room.lower;
  }
  if (farthest == nullptr) return change;
  return let_push(*farthest, level) ? Change::some : Change::unclear;
}

/// The limit pushes no more.
void BoundedProblem::release(int limit) noexcept {
  Room& room = room_[axis_of(limit)];
  (entry(limit).kind == RowKind::upper ? room.upper : room.lower).pushes = false;
  entry(limit).plain_nu = 0.0;
}

bool BoundedProblem::let_push(End& end, int level) noexcept {
  const int i = end.row;
  if (end.is_tied || i < 0) return false;
  Entry& e = entry(i);
  if (!e.is_posed) take_source(i);
  if (e.softness > 0.0) return false;
  e.plain_nu = 0.0;
  bound(i);
  project_row(i, level);
  end.pushes = true;
  pushing_.push_back(i);
  return e.reach > 0.0;
}

/// The motion of the level into work_, and each row's force.
bool BoundedProblem::find_plain_motion(int level, int max_rounds) noexcept {
  std::fill_n(parked_.begin(), motions_.size(), static_cast<signed char>(0));
  for (const int i : motions_) {
    bound(i);
    entry(i).plain_nu = 0.0;
  }
  for (int round = 0; round < std::min(max_rounds, most_rounds); ++round) {
    ++iterations_;
    Change change = drive_plainly();
    if (change == Change::unclear) return false;
    if (change == Change::some) continue;
    change = change_drivers();
    const Change of_limits = change_limits(level);
    if (change == Change::unclear || of_limits == Change::unclear) return false;
    if (change == Change::none && of_limits == Change::none)
      return sums_hold(level, work_) && torques_for(work_);
  }
  return false;
}

void BoundedProblem::settle(const Vector& p) noexcept {
  for (const int i : forces_) entry(i).phi = 1.0;
  for (const int i : pushed_) {
    if (entry(i).reach > 0.0) entry(i).nu = 0.0;
  }
  for (const std::vector<int>* const rows : {&motions_, &pushing_}) {
    for (const int i : *rows) {
      if (entry(i).reach > 0.0) entry(i).nu = entry(i).plain_nu;
    }
  }
  tau_.head(motors_) = candidate_.head(motors_);
  copy(p, p_);
}

/// False, and nothing is settled, where the level is not plain.
bool BoundedProblem::solve_plainly(int level, int max_rounds) noexcept {
  forces_.clear();
  motions_.clear();
  for (const int i : drives_) {
    const Entry& e = entry(i);
    if (e.level != level || e.out) continue;
    project_row(i, level);
    if (e.reach > 0.0) (e.kind == RowKind::force ? forces_ : motions_).push_back(i);
  }
  pushed_ = pushing_;
  if (!push_plainly(level, max_rounds) || !allow(level)) return false;
  if (motions_.empty() && pushing_.empty() && limits_have_room(fixed_)) {
    if (!forces_.empty()) settle(fixed_);
    return true;
  }
  if (!find_plain_motion(level, max_rounds)) return false;
  settle(work_);
  return true;
}

}  // namespace zwang::solver
