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

bool BoundedProblem::sums_hold(int level, const Vector& p) noexcept {
  for (const int i : sums_) {
    if (!sum_counts(i, level)) continue;
    const Entry& e = entry(i);
    const double sum = sum_of(i, p);
    if (sum < e.lo - sum_rounding * std::abs(e.lo) || sum > e.hi + sum_rounding * std::abs(e.hi))
      return false;
  }
  return true;
}

/// The variable sigma = |B_S| (the sum): B_S.p / |B_S| = sigma + what the levels above made of it.
void BoundedProblem::pose_sums(int n, int level, int variable, int equation) noexcept {
  for (const int i : sums_) {
    if (!sum_counts(i, level)) continue;
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
