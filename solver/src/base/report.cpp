// How the solution of BoundedProblem reads, row by row, and which rows hold another one back.
#include <algorithm>
#include <cmath>

#include "base/bounded_problem.hpp"

namespace zwang::solver {

namespace {

constexpr double bound_tolerance = 1e-9;     // relative: when a force counts as being at its bound
constexpr double residual_tolerance = 1e-8;  // relative to 1 + |d|: when a row counts as met
constexpr double least_opposition = 0.01;    // of the strongest one's, to be named

/// The side of its box that nu is at: -1, 1, or 0 for neither.
int side_of(double nu, double lo, double hi) {
  if (nu == 0.0) return 0;
  const auto size_of = [](double bound) { return std::isfinite(bound) ? std::abs(bound) : 0.0; };
  const double size = std::max({1.0, size_of(lo), size_of(hi)});
  const double width = bound_tolerance * size;
  if (nu >= hi - width && hi > 0.0) return 1;
  if (nu <= lo + width && lo < 0.0) return -1;
  return 0;
}

}  // namespace

/// Whether a motor is.
bool BoundedProblem::is_at_limit(const Vector& tau) const noexcept {
  for (int j = 0; j < motors_; ++j) {
    const double width = bound_tolerance * (tau_hi_(j) - tau_lo_(j));
    if (!std::isfinite(width)) continue;
    if (tau(j) <= tau_lo_(j) + width || tau(j) >= tau_hi_(j) - width) return true;
  }
  return false;
}

/// The limits in the way of the rows of a solved level: a lower level may move a row away again. If motors
/// share a motion, the least torques tell which motor stands at its limit. If the motors do not make every
/// motion, the torques of the last level tell.
void BoundedProblem::note_limits(int level) noexcept {
  const bool motor_limited = motors_reach_all_ && is_at_limit(torques_for(p_) ? candidate_ : tau_);
  for (const int i : posed_) {
    Entry& e = entry(i);
    if (e.level != level) continue;
    e.motor_limited = motor_limited;
    e.sum_limited = is_held_by_sum(i, e.kind == RowKind::force ? e.force : d_(i) - along(i, p_));
  }
}

/// A limit that has room holds, and pushes nothing: that is what a row's solution begins with.
void BoundedProblem::report() noexcept {
  const bool motor_at_limit = is_at_limit(tau_);
  std::fill(solutions_.begin(), solutions_.end(), RowSolution{});
  for (const std::vector<int>* const rows : {&drives_, &sums_}) {
    for (const int i : *rows) report_row(i, motor_at_limit);
  }
  if (are_levels_plain_ && !is_axis_out_) {
    for (const int i : pushing_) report_row(i, motor_at_limit);
    return;
  }
  pose_limits();
  for (const int i : awake_) {
    if (is_one_sided(i)) report_row(i, motor_at_limit);
  }
}

void BoundedProblem::report_row(int i, bool motor_at_limit) noexcept {
  RowSolution& row = solutions_[static_cast<std::size_t>(i)];
  switch (entry(i).kind) {
    case RowKind::force:
      report_force(i, motor_at_limit, row);
      break;
    case RowKind::sum:
      report_sum(i, row);
      break;
    default:
      report_motion(i, motor_at_limit, row);
  }
}

void BoundedProblem::report_force(int i, bool motor_at_limit, RowSolution& row) noexcept {
  const Entry& e = entry(i);
  row.phi = e.phi;
  row.nu = e.phi * e.force;
  row.saturated = e.phi < 1.0 - bound_tolerance;
  if (e.out) {
    row.status = e.status;
  } else if (e.blocked) {
    row.status = RowStatus::blocked;
  } else if (row.saturated) {
    const bool by_motor = motor_at_limit || e.motor_limited;
    const bool by_sum = !by_motor || e.sum_limited || is_held_by_sum(i, e.force);
    row.status = by_sum ? RowStatus::force_limited : RowStatus::torque_limited;
  }
}

void BoundedProblem::report_sum(int i, RowSolution& row) noexcept {
  const Entry& e = entry(i);
  if (e.out) return;
  row.nu = sum_of(i, p_);
  row.saturated = side_of(row.nu, e.lo, e.hi) != 0;
  row.status = row.saturated ? RowStatus::force_limited : RowStatus::held;
}

void BoundedProblem::report_motion(int i, bool motor_at_limit, RowSolution& row) noexcept {
  const Entry& e = entry(i);
  const double s = along(i, p_) - d_(i);
  row.residual = s;
  if (e.is_limit) row.residual = e.kind == RowKind::upper ? std::max(s, 0.0) : std::min(s, 0.0);
  const bool met = std::abs(row.residual) <= residual_tolerance * (1.0 + std::abs(d_(i)));
  if (e.out) {
    row.status = met ? RowStatus::held : e.status;
    return;
  }
  row.nu = e.nu;
  const int side = side_of(e.nu, e.lo, e.hi);
  row.saturated = side != 0;
  if (!met) row.status = status_of_missed(i, side, motor_at_limit, row);
}

/// Of a motion row that did not get what it asked, with its force at that side of its box.
RowStatus BoundedProblem::status_of_missed(int i, int side, bool motor_at_limit, RowSolution& row) noexcept {
  const Entry& e = entry(i);
  const bool is_bounded = side < 0 ? e.bounded_below : side > 0 && e.bounded_above;
  if (!row.saturated && (e.sum_limited || is_held_by_sum(i, -row.residual))) {
    row.saturated = true;
    return RowStatus::force_limited;
  }
  if (e.blocked) return RowStatus::blocked;
  if (is_soft(i) && !row.saturated) return RowStatus::held;
  if (is_bounded && !e.is_limit) return RowStatus::force_limited;
  if (row.saturated && e.is_limit) return RowStatus::conflict;
  return motor_at_limit || e.motor_limited ? RowStatus::torque_limited : RowStatus::conflict;
}

bool BoundedProblem::is_sum_at_bound(int i, double direction) noexcept {
  const Entry& e = entry(i);
  if (e.kind != RowKind::sum || e.out) return false;
  return side_of(sum_of(i, p_), e.lo, e.hi) * direction > 0.0;
}

/// Whether row i, which wants more (`wanted` > 0) or less force, would take a sum beyond its bound.
bool BoundedProblem::is_held_by_sum(int i, double wanted) noexcept {
  for (const int k : sums_) {
    if (!sum_counts(k, entry(i).level)) continue;
    const double share = dot(dimension_, B(k), V(i));  // what the levels above keep of their own counts, too
    if (std::abs(share) <= residual_tolerance * entry(k).length * entry(i).length) continue;
    if (is_sum_at_bound(k, wanted * share)) return true;
  }
  return false;
}

/// The acceleration by which row k keeps row i from `wanted` (a direction), of a `miss` in all.
///   its force    B_i.B_k nu_k, against the direction
///   a level above, frozen: the part of the miss along B_k
///   a sum at its bound: the miss
double BoundedProblem::opposition(int k, int i, double wanted, double miss) noexcept {
  const Entry& e = entry(k);
  if (k == i || !e.is_posed || e.out || e.level > entry(i).level) return 0.0;
  const double share = dot(dimension_, B(i), B(k));
  if (std::abs(share) <= residual_tolerance * entry(i).length * e.length) return 0.0;
  if (e.kind == RowKind::sum) {
    return is_sum_at_bound(k, wanted * share) ? miss : 0.0;
  }
  const double force = e.kind == RowKind::force ? e.phi * e.force : e.nu;
  const double pushed_back = -std::copysign(1.0, wanted) * share * force;
  const bool frozen = e.level < entry(i).level && !is_one_sided(k);
  const double cosine = share / (entry(i).length * e.length);
  return std::max(pushed_back, frozen ? cosine * cosine * miss : 0.0);
}

/// The strongest first.
int BoundedProblem::opposing(int i, std::span<int> out) noexcept {
  if (i < 0 || i >= rows_ || !entry(i).is_posed || entry(i).out) return 0;
  const RowSolution& row = solutions_[static_cast<std::size_t>(i)];
  const Entry& e = entry(i);
  const bool is_force = e.kind == RowKind::force;
  const double wanted = is_force ? e.force : -row.residual;
  const double miss =
      is_force ? (1.0 - e.phi) * std::abs(e.force) * e.length * e.length : std::abs(row.residual);
  const bool met = is_force ? !row.saturated : miss <= residual_tolerance * (1.0 + std::abs(d_(i)));
  if (met) return 0;
  double strongest = 0.0;
  for (int k = 0; k < rows_; ++k) strongest = std::max(strongest, opposition(k, i, wanted, miss));
  int count = 0;
  const auto size = static_cast<int>(out.size());
  for (int k = 0; k < rows_; ++k) {
    const double own = opposition(k, i, wanted, miss);
    if (!(own > least_opposition * strongest)) continue;
    int place = count;
    while (place > 0 && opposition(out[static_cast<std::size_t>(place) - 1], i, wanted, miss) < own) --place;
    if (place == size) continue;
    count = std::min(count + 1, size);
    std::move_backward(out.begin() + place, out.begin() + count - 1, out.begin() + count);
    out[static_cast<std::size_t>(place)] = k;
  }
  return count;
}

}  // namespace zwang::solver
