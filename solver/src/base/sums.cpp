// The sums of BoundedProblem: what all levels together push along an axis stays within a range.
#include <algorithm>
#include <cmath>

#include "base/bounded_problem.hpp"

namespace zwang::solver {

namespace {

constexpr double sum_rounding = 1e-12;  // relative: what sums may show at a limit

}  // namespace

/// From its level on a sum counts what is added to p.
void BoundedProblem::start_sums(int level) noexcept {
  for (const int i : sums_) {
    Entry& e = entry(i);
    if (e.level != level || e.out) continue;
    e.above = 0.0;
    e.above = sum_of(i, p_);
  }
}

bool BoundedProblem::sum_counts(int i, int level) const noexcept {
  const Entry& e = entries_[static_cast<std::size_t>(i)];
  return e.kind == RowKind::sum && e.level <= level && !e.out;
}

double BoundedProblem::sum_of(int i, const Vector& p) noexcept {
  const Entry& e = entry(i);
  return along(i, p) / (e.length * e.length) - e.above;
}

/// How far a sum is beyond its bounds; 0 where it holds them but for rounding.
double BoundedProblem::sum_beyond(int i, const Vector& p) noexcept {
  const Entry& e = entry(i);
  const double sum = sum_of(i, p);
  if (!(sum <= e.hi + sum_rounding * std::abs(e.hi))) return sum - e.hi;
  if (!(sum >= e.lo - sum_rounding * std::abs(e.lo))) return e.lo - sum;
  return 0.0;
}

bool BoundedProblem::sums_hold(int level, const Vector& p) noexcept {
  return std::all_of(sums_.begin(), sums_.end(),
                     [&](int i) { return !sum_counts(i, level) || sum_beyond(i, p) == 0.0; });
}

void BoundedProblem::list_sums(int level) noexcept {
  posed_sums_.clear();
  for (const int i : sums_) {
    if (sum_counts(i, level)) posed_sums_.push_back(i);
  }
}

/// Takes out of posed_ the limits that push nothing.
void BoundedProblem::let_limits_wait() noexcept {
  waiting_.clear();
  std::size_t kept = 0;
  for (const int i : posed_) {
    if (is_one_sided(i) && entry(i).nu == 0.0) {
      waiting_.push_back(i);
    } else {
      posed_[kept++] = i;
    }
  }
  posed_.resize(kept);
}

/// Adds the sum that the motion in work_ breaks most, and each waiting limit without room. A limit without
/// room at felt_ joins, too: it wants to push. False where nothing joins.
bool BoundedProblem::pose_broken(int level) noexcept {
  int worst = -1;
  double most = 0.0;
  for (const int i : sums_) {
    if (!sum_counts(i, level)) continue;
    const double beyond = sum_beyond(i, work_) * entry(i).length;
    if (beyond <= most || std::find(posed_sums_.begin(), posed_sums_.end(), i) != posed_sums_.end()) continue;
    most = beyond;
    worst = i;
  }
  if (worst >= 0) posed_sums_.push_back(worst);
  const std::size_t waiting = waiting_.size();
  std::size_t kept = 0;
  for (const int i : waiting_) {
    const double least = tie * std::abs(target_of(i));
    if (room_of(i, work_) > least && room_of(i, felt_) > least) {
      waiting_[kept++] = i;
    } else {
      posed_.push_back(i);
    }
  }
  waiting_.resize(kept);
  return worst >= 0 || kept < waiting;
}

/// Sums and limits above stand in the way of p. A row gets what it wants of another motion:
///
///     felt = p - sum_e y_e E_e
///
/// y_e is the multiplier of an equation, E_e its direction.
void BoundedProblem::take_felt(int n, int level) noexcept {
  copy(work_, felt_);
  int equation = 0;
  for (int k = 0; k < n; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    if (!is_limit_above(i, level)) continue;
    const double sign = entry(i).kind == RowKind::upper ? 1.0 : -1.0;
    push(i, -sign * program_.multiplier(equation++) * entry(i).inverse_reach, felt_);
  }
  for (const int i : posed_sums_) {
    project_row(i, level);
    push(i, -program_.multiplier(equation++) * entry(i).inverse_length, felt_);
  }
}

/// The variable sigma = |B_S| (the sum): B_S.p / |B_S| = sigma + what the levels above made of it.
void BoundedProblem::pose_sums(int n, int variable, int equation) noexcept {
  for (const int i : posed_sums_) {
    const double length = entry(i).length;
    for (int k = 0; k < n; ++k) {
      const double share = dot(dimension_, B(i), V(posed_[static_cast<std::size_t>(k)])) / length;
      program_.E(k)[equation] = share * units_[static_cast<std::size_t>(k)];
    }
    program_.E(variable)[equation] = -1.0;
    program_.lo(variable) = entry(i).lo * length;
    program_.hi(variable) = entry(i).hi * length;
    program_.z(variable) = std::clamp(sum_of(i, p_), entry(i).lo, entry(i).hi) * length;
    ++variable;
    ++equation;
  }
}

}  // namespace zwang::solver
