#include "base/bounded_problem.hpp"

#include <algorithm>
#include <cmath>

#include "base/whitened_rows.hpp"

namespace zwang::solver {

namespace {

constexpr double blocked_share = 1e-8;          // B K B' over B B': what the levels above left free of a row
constexpr double dependent_share = 1e-18;       // the same, of a row against those frozen before it
constexpr double driven_share = 1e-8;           // |B.T| over |B||T|: below, the motor does not move the row
constexpr double torque_rounding = 1e-12;       // of a motor's range
constexpr double motor_rank_tolerance = 1e-12;  // of a pivot of T'T, relative to its trace

/// One-sided rows push harder than any driver can, and harder the higher they rank: so where ranges
/// contradict, acceleration wins over velocity over position.
double authority(Quantity quantity) {
  switch (quantity) {
    case Quantity::acceleration:
      return 64.0;
    case Quantity::velocity:
      return 16.0;
    default:
      return 4.0;
  }
}

}  // namespace

BoundedProblem::BoundedProblem(int rows, int motors, int dimension)
    : V_(RowMajorMatrix::Zero(rows, dimension)),
      T_(static_cast<std::size_t>(motors)),
      d_(Vector::Zero(rows)),
      tau_(Vector::Zero(motors)),
      tau_lo_(Vector::Zero(motors)),
      tau_hi_(Vector::Zero(motors)),
      candidate_(Vector::Zero(motors)),
      tau_slack_(Vector::Zero(motors)),
      motor_square_(Vector::Zero(motors)),
      motor_extents_(static_cast<std::size_t>(motors)),
      last_of_(static_cast<std::size_t>(dimension)),
      p_(Vector::Zero(dimension)),
      fixed_(Vector::Zero(dimension)),
      work_(Vector::Zero(dimension)),
      solved_(Vector::Zero(dimension)),
      felt_(Vector::Zero(dimension)),
      frozen_(RowMajorMatrix::Zero(dimension, dimension)),
      gram_(RowMajorMatrix::Zero(dimension, spaced(dimension))),
      inverse_pivots_(Vector::Zero(dimension)),
      entries_(static_cast<std::size_t>(rows)),
      limits_(static_cast<std::size_t>(rows)),
      last_on_axis_(static_cast<std::size_t>(rows)),
      nearest_(static_cast<std::size_t>(rows)),
      rooms_(static_cast<std::size_t>(rows)),
      first_room_(static_cast<std::size_t>(rows)),
      room_(static_cast<std::size_t>(rows)),
      parked_(static_cast<std::size_t>(rows)),
      free_factor_(RowMajorMatrix::Zero(dimension + 1, dimension + 1)),
      free_inverse_D_(Vector::Zero(dimension + 1)),
      free_work_(Vector::Zero(dimension + 1)),
      free_nu_(Vector::Zero(dimension + 1)),
      program_(2 * rows + motors, dimension, dimension + rows) {
  for (std::vector<int>* list :
       {&posed_, &posed_sums_, &folded_, &waiting_, &awake_, &idle_, &sums_, &drives_, &levels_, &forces_,
        &motions_, &limits_above_, &tied_, &limited_axes_, &pushing_, &pushed_, &free_rows_, &later_motions_})
    list->reserve(static_cast<std::size_t>(rows));
  units_.reserve(static_cast<std::size_t>(rows));
  soles_.reserve(static_cast<std::size_t>(motors));
  shared_motors_.reserve(static_cast<std::size_t>(motors));
}

void BoundedProblem::clear_motors(int dimension) noexcept {
  motors_ = 0;
  dimension_ = dimension;
}

void BoundedProblem::limit_motor(int motor, double lowest, double highest) noexcept {
  tau_lo_(motor) = lowest;
  tau_hi_(motor) = highest;
  const double slack = torque_rounding * (highest - lowest);
  tau_slack_(motor) = std::isfinite(slack) ? slack : 0.0;
}

bool BoundedProblem::solve(int max_iterations, std::span<RowSolution> solutions) noexcept {
  solutions_ = solutions;
  iterations_ = 0;
  motors_drive_all_ = motors_reach_all_;
  for (int j = 0; j < motors_; ++j)
    motors_drive_all_ = motors_drive_all_ && (tau_lo_(j) < 0.0 || tau_hi_(j) > 0.0);
  bound_rows();
  bool exact = true;
  if (!solve_levels(max_iterations, exact)) {
    wake_idle_limits(levels_.front());
    are_levels_plain_ = false;
    for (Entry& e : entries_) {
      e.nu = e.phi = e.offset = 0.0;
      e.projected_at = no_level;
    }
    solve_levels(max_iterations, exact);
  }
  exact = least_torques(max_iterations) && exact;
  report();
  return exact;
}

/// The levels as a table of contents. From the first level on that is not plain, stages solve them. False
/// when an idle limit would have had to push.
bool BoundedProblem::solve_levels(int max_iterations, bool& exact) noexcept {
  frozen_count_ = 0;
  p_.head(dimension_).setZero();
  tau_.head(motors_).setZero();
  torques_are_least_ = true;
  exact = true;
  are_levels_plain_ = motors_drive_all_;
  start_room();
  for (const int level : levels_) {
    start_sums(level);
    are_levels_plain_ = are_levels_plain_ && solve_plainly(level, max_iterations);
    if (!are_levels_plain_) {
      pose_limits();
      project_rows(level);
      exact = solve_forces(level, max_iterations) && exact;
      exact = solve_motion(level, max_iterations) && exact;
      if (!idle_limits_rest(level)) return false;
    }
    if (level != levels_.back()) freeze(level);
  }
  return true;
}

/// Torques of least norm for p = T'tau. T is nearly a triangle: the dimensions of joints that carry no wheels
/// come one after the other. The last motor of an arm alone drives the last of them, so its torque is known,
/// then the next one's. The remaining motors, mostly of wheels, share their motions: by T'T. Without full
/// rank the motors do not reach every motion.
void BoundedProblem::factorise_motors() noexcept {
  constexpr int none = -1, several = -2;
  std::fill_n(last_of_.begin(), dimension_, none);
  double trace = 0.0;
  for (int j = 0; j < motors_; ++j) {
    const int extent = extent_of(T(j));
    motor_extents_[static_cast<std::size_t>(j)] = extent;
    const double squared = dot(extent, T(j), T(j));
    motor_square_(j) = squared;
    trace += squared;
    if (extent == 0) continue;
    int& last = last_of_[static_cast<std::size_t>(extent - 1)];
    last = last == none ? j : several;
  }
  const double least = motor_rank_tolerance * trace;
  soles_.clear();
  int open = dimension_;
  for (; open > 0; --open) {
    const int j = last_of_[static_cast<std::size_t>(open - 1)];
    if (j < 0 || !(T(j)[open - 1] * T(j)[open - 1] > least)) break;
    soles_.push_back({j, 1.0 / T(j)[open - 1]});
  }
  shared_dimensions_ = open;
  shared_motors_.clear();
  for (int k = 0; k < open; ++k) set_zero(k + 1, &gram_(k, 0));
  for (int j = 0; j < motors_; ++j) {
    const int extent = motor_extents_[static_cast<std::size_t>(j)];
    if (extent > open) continue;
    shared_motors_.push_back(j);
    add_square(0, extent, 1.0, T(j), gram_.data(), gram_.outerStride());
  }
  motors_reach_all_ = factorise_gram(open, least);
}

/// T'T = G D G', and G^-1 in the place of G:  W_kc = -G_kc - sum G_ke W_ec over c < e < k. False where a
/// pivot is not above `least_pivot`.
bool BoundedProblem::factorise_gram(int count, double least_pivot) noexcept {
  for (int k = 0; k < count; ++k) {
    double* const row = &gram_(k, 0);
    double pivot = row[k];
    // Row k of G D from W alone:  G D = T'T W'.
    for (int c = k - 1; c >= 0; --c) {
      double rest = row[c];
      for (int e = 0; e < c; ++e) rest += gram_(c, e) * row[e];
      row[c] = rest * inverse_pivots_(c);
      pivot -= rest * row[c];
    }
    if (!(pivot > least_pivot)) return false;
    inverse_pivots_(k) = 1.0 / pivot;
    for (int c = 0; c < k; ++c) {
      double sum = -row[c];
      for (int e = c + 1; e < k; ++e) sum -= row[e] * gram_(e, c);
      row[c] = sum;
    }
  }
  return true;
}

/// A line is 0 from here on: the whitened axes come from joints, one after the other.
int BoundedProblem::extent_of(const double* x) const noexcept {
  int extent = dimension_;
  while (extent > 0 && x[extent - 1] == 0.0) --extent;
  return extent;
}

/// No multiplier is unbounded: what the motors can do along a row bounds it, one-sided rows by a multiple of
/// that. Where motors drive every motion, a row is bounded when it is posed; else those that no motor drives
/// are to be known beforehand.
void BoundedProblem::bound_rows() noexcept {
  if (motors_drive_all_) return;
  pose_limits();
  for (const int i : awake_) bound(i);
}

void BoundedProblem::bound_row(int i) noexcept {
  Entry& e = entry(i);
  e.has_bounds = true;
  if (e.out || e.kind == RowKind::sum) return;
  const bool is_bounded = e.kind == RowKind::force || (std::isfinite(e.lo) && std::isfinite(e.hi));
  if (is_bounded && motors_drive_all_) return;
  const bool is_known = e.twin >= 0 && entry(e.twin).largest_force >= 0.0;
  double force = e.largest_force = is_known ? entry(e.twin).largest_force : largest_force(i);
  if (force == 0.0) {
    e.out = true;
    e.status = RowStatus::unreachable;
    is_axis_out_ = true;
  }
  if (e.out || e.kind == RowKind::force) return;
  if (!std::isfinite(force)) force = 1e7 * largest_demand() / e.length;
  if (is_one_sided(i)) force *= authority(e.quantity);
  if (!std::isfinite(e.lo)) e.lo = -force;
  if (!std::isfinite(e.hi)) e.hi = force;
}

/// Of all rows, as an acceleration of the whitened axes.
double BoundedProblem::largest_demand() noexcept {
  double largest = 0.0;
  for (int i = 0; i < rows_; ++i) {
    const Entry& e = entry(i);
    largest = std::max({largest, std::abs(d_(i)) / nonzero(e.length), std::abs(e.force) * e.length});
  }
  return nonzero(largest);
}

/// Upper bound of |nu| with B_i nu = T'tau: both sides times B_i. 0 where no motor drives the row.
double BoundedProblem::largest_force(int i) noexcept {
  const double length = entry(i).length;
  const double least = driven_share * driven_share * length * length;
  double sum = 0.0;
  for (int j = 0; j < motors_; ++j) {
    const int extent = motor_extents_[static_cast<std::size_t>(j)];
    const double share = std::abs(dot(std::min(extent, entry(i).extent), B(i), T(j)));
    if (share * share > least * motor_square_(j)) sum += share * std::max(-tau_lo_(j), tau_hi_(j));
  }
  return length > 0.0 ? sum / (length * length) : 0.0;
}

/// V_i = K B_i for the rows of a level that take part and for the limits above: the rows as the levels above
/// let them act.
void BoundedProblem::project_rows(int level) noexcept {
  forces_.clear();
  motions_.clear();
  limits_above_.clear();
  for (const int i : awake_) {
    const Entry& e = entry(i);
    if (e.level > level) continue;
    const bool is_above = e.level < level;
    if (e.out || (is_above && !e.is_limit)) continue;
    project_row(i, level);
    if (e.reach == 0.0 || e.kind == RowKind::sum) continue;
    (is_above ? limits_above_ : e.kind == RowKind::force ? forces_ : motions_).push_back(i);
  }
}

void BoundedProblem::project_row(int i, int level) noexcept {
  Entry& e = entry(i);
  if (e.projected_at == level) return;
  e.projected_at = level;
  if (frozen_count_ == 0) {
    e.blocked = false;
    e.V = e.B;
    e.reach_extent = e.extent;
    e.reach = e.length;
    e.inverse_reach = e.inverse_length;
    return;
  }
  if (e.twin >= 0) {
    project_row(e.twin, level);
    const Entry& twin = entry(e.twin);
    e.V = twin.V;
    e.reach_extent = twin.reach_extent;
    e.reach = twin.reach;
    e.inverse_reach = twin.inverse_reach;
    if (e.level == level) e.blocked = twin.reach == 0.0;
    return;
  }
  double* const V = &V_(i, 0);
  e.V = V;
  e.reach_extent = dimension_;
  solver::copy(e.extent, e.B, V);
  set_zero(dimension_ - e.extent, V + e.extent);
  take_out_frozen(V);
  const double squared = dot(dimension_, V, V);
  const bool blocked = squared <= blocked_share * e.length * e.length;
  if (e.level == level) e.blocked = blocked;
  e.reach = blocked ? 0.0 : std::sqrt(squared);
  e.inverse_reach = blocked ? 0.0 : 1.0 / e.reach;
  if (blocked) set_zero(dimension_, V);
}

/// x := K x,  K = 1 - sum q q' over the frozen directions q. Twice: rounding of the first pass goes with the
/// second.
void BoundedProblem::take_out_frozen(double* x) const noexcept {
  for (int pass = 0; pass < 2; ++pass) {
    for (int c = 0; c < frozen_count_; ++c) {
      const double* const q = &frozen_(c, 0);
      add_multiple(dimension_, -dot(dimension_, q, x), q, x);
    }
  }
}

/// The result of the level's equality and force rows, saturated or not, stays for the levels below:
/// B_i.dp = 0 with mu free. From then on a force w moves the robot by K w, and one more row closes its
/// direction:
///
///   K := K - K B B'K / B'K B,   K = 1 - sum q q',   q = K B / |K B|
void BoundedProblem::freeze(int level) noexcept {
  for (const int i : drives_) {
    const Entry& e = entry(i);
    if (e.level != level || !takes_part(i)) continue;
    if (frozen_count_ == dimension_) return;
    double* const q = &frozen_(frozen_count_, 0);
    solver::copy(e.extent, e.B, q);
    set_zero(dimension_ - e.extent, q + e.extent);
    take_out_frozen(q);
    const double left = dot(dimension_, q, q);
    if (left <= dependent_share * e.length * e.length) continue;
    scaled_copy(dimension_, 1.0 / std::sqrt(left), q, q);
    ++frozen_count_;
  }
}

}  // namespace zwang::solver
