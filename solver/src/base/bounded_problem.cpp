#include "base/bounded_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/whitened_rows.hpp"

namespace zwang::solver {

namespace {

constexpr int no_level = std::numeric_limits<int>::max();
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
      P_(RowMajorMatrix::Zero(rows, dimension)),
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
      F_(RowMajorMatrix::Zero(dimension, dimension)),
      frozen_(RowMajorMatrix::Zero(dimension, dimension)),
      gram_(RowMajorMatrix::Zero(dimension, spaced(dimension))),
      inverse_pivots_(Vector::Zero(dimension)),
      entries_(static_cast<std::size_t>(rows)),
      solutions_(static_cast<std::size_t>(rows)),
      last_on_axis_(static_cast<std::size_t>(rows)),
      nearest_(static_cast<std::size_t>(rows)),
      program_(2 * rows + motors, dimension, dimension + rows) {
  posed_.reserve(static_cast<std::size_t>(rows));
  folded_.reserve(static_cast<std::size_t>(rows));
  waiting_.reserve(static_cast<std::size_t>(rows));
  awake_.reserve(static_cast<std::size_t>(rows));
  idle_.reserve(static_cast<std::size_t>(rows));
  sums_.reserve(static_cast<std::size_t>(rows));
  for (std::vector<int>* of_level : {&forces_, &motions_, &limits_above_})
    of_level->reserve(static_cast<std::size_t>(rows));
  units_.reserve(static_cast<std::size_t>(rows));
  tied_.reserve(static_cast<std::size_t>(rows));
  soles_.reserve(static_cast<std::size_t>(motors));
  shared_motors_.reserve(static_cast<std::size_t>(motors));
}

void BoundedProblem::clear_motors(int dimension) noexcept {
  motors_ = 0;
  dimension_ = dimension;
}

void BoundedProblem::set_row(int i, const Row& row, const double* B, double least_square) noexcept {
  Entry& e = entry(i);
  e.twin = -1;
  e.axis = i;
  last_on_axis_[static_cast<std::size_t>(i)] = {};
  e.B = B;
  e.extent = extent_of(e.B);
  const double squared = dot(e.extent, e.B, e.B);
  e.length = std::sqrt(squared);
  e.inverse_length = squared > 0.0 ? e.length * (1.0 / squared) : 0.0;
  e.reachable = squared >= least_square && squared > 0.0;
  take_source(e, row);
}

void BoundedProblem::set_twin(int i, const Row& row, int twin) noexcept {
  Entry& e = entry(i);
  const Entry& other = entry(twin);
  e.twin = e.axis = twin;
  e.B = other.B;
  e.extent = other.extent;
  e.length = other.length;
  e.inverse_length = other.inverse_length;
  e.reachable = other.reachable;
  take_source(e, row);
}

/// All that set_row and set_twin have not set. A weight decides how much of b is worth reaching, R = 1/w;
/// what was reached is kept firmly against the levels below.
void BoundedProblem::take_source(Entry& e, const Row& row) noexcept {
  e.reset();
  e.kind = row.kind;
  e.is_limit = row.kind == RowKind::upper || row.kind == RowKind::lower;
  e.quantity = row.quantity;
  e.level = row.level;
  e.lo = row.lo;
  e.hi = row.hi;
  e.bounded_below = std::isfinite(row.lo);
  e.bounded_above = std::isfinite(row.hi);
  const bool is_motion = e.is_limit || e.kind == RowKind::driver;
  e.softness = is_motion && std::isfinite(row.weight) ? 1.0 / row.weight : 0.0;
  e.force = row.force;
  e.out = !e.reachable;
  e.status = e.out ? RowStatus::unreachable : RowStatus::held;
}

void BoundedProblem::limit_motor(int motor, double lowest, double highest) noexcept {
  tau_lo_(motor) = lowest;
  tau_hi_(motor) = highest;
  const double slack = torque_rounding * (highest - lowest);
  tau_slack_(motor) = std::isfinite(slack) ? slack : 0.0;
}

bool BoundedProblem::solve(int max_iterations) noexcept {
  iterations_ = 0;
  motors_drive_all_ = motors_reach_all_;
  for (int j = 0; j < motors_; ++j)
    motors_drive_all_ = motors_drive_all_ && (tau_lo_(j) < 0.0 || tau_hi_(j) > 0.0);
  find_idle_limits();
  bound_rows();
  bool exact = true;
  if (!solve_levels(max_iterations, exact)) {
    wake_idle_limits(first_level());
    for (Entry& e : entries_) e.nu = e.phi = e.offset = 0.0;
    solve_levels(max_iterations, exact);
  }
  exact = least_torques(max_iterations) && exact;
  report();
  return exact;
}

/// The levels as a table of contents. False when an idle limit would have had to push.
bool BoundedProblem::solve_levels(int max_iterations, bool& exact) noexcept {
  frozen_count_ = 0;
  all_free_ = true;
  p_.head(dimension_).setZero();
  tau_.head(motors_).setZero();
  torques_are_least_ = true;
  exact = true;
  for (int level = first_level(); level != no_level; level = next_level_) {
    project_rows(level);
    start_sums(level);
    exact = solve_forces(level, max_iterations) && exact;
    exact = solve_motion(level, max_iterations) && exact;
    if (!idle_limits_rest(level)) return false;
    if (next_level_ != no_level) freeze(level);
  }
  return true;
}

int BoundedProblem::first_level() const noexcept {
  int first = no_level;
  for (const int i : awake_) first = std::min(first, entries_[static_cast<std::size_t>(i)].level);
  return first;
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

/// V_i = F'B_i and P_i = F V_i = K B_i, for the rows of a level that take part and for the limits above. They
/// are the rows as the levels above let them act.
void BoundedProblem::project_rows(int level) noexcept {
  forces_.clear();
  motions_.clear();
  limits_above_.clear();
  next_level_ = no_level;
  for (const int i : awake_) {
    const Entry& e = entry(i);
    if (e.level > level) {
      next_level_ = std::min(next_level_, e.level);
      continue;
    }
    const bool is_above = e.level < level;
    if (e.out || (is_above && !e.is_limit)) continue;
    project_row(i, level);
    if (e.reach == 0.0 || e.kind == RowKind::sum) continue;
    (is_above ? limits_above_ : e.kind == RowKind::force ? forces_ : motions_).push_back(i);
  }
}

void BoundedProblem::project_row(int i, int level) noexcept {
  Entry& e = entry(i);
  e.projected_at = level;
  if (all_free_) {
    e.blocked = false;
    e.V = e.P = e.B;
    e.reach_extent = e.extent;
    e.reach = e.length;
    e.inverse_reach = e.inverse_length;
    return;
  }
  if (e.twin >= 0 && entry(e.twin).projected_at == level) {
    const Entry& twin = entry(e.twin);
    e.V = twin.V;
    e.P = twin.P;
    e.reach_extent = twin.reach_extent;
    e.reach = twin.reach;
    e.inverse_reach = twin.inverse_reach;
    if (e.level == level) e.blocked = twin.reach == 0.0;
    return;
  }
  double* const V = &V_(i, 0);
  double* const P = &P_(i, 0);
  e.V = V;
  e.P = P;
  e.reach_extent = dimension_;
  std::fill_n(V, dimension_, 0.0);
  for (int k = 0; k < e.extent; ++k) add_multiple(dimension_, e.B[k], &F_(k, 0), V);
  const double squared = dot(dimension_, V, V);
  const bool blocked = squared <= blocked_share * e.length * e.length;
  if (e.level == level) e.blocked = blocked;
  e.reach = blocked ? 0.0 : std::sqrt(squared);
  e.inverse_reach = blocked ? 0.0 : 1.0 / e.reach;
  for (int k = 0; k < dimension_; ++k) P[k] = blocked ? 0.0 : dot(dimension_, V, &F_(k, 0));
}

/// The result of the level's equality and force rows, saturated or not, stays for the levels below:
/// B_i.dp = 0 with mu free. From then on a force w moves the robot by K w, and one more row closes its
/// direction:
///
///   K := K - K B B'K / B'K B = F (1 - v v' / v.v) F',   v = F'B
void BoundedProblem::freeze(int level) noexcept {
  double* const v = solved_.data();
  double* const Fv = work_.data();
  for (const int i : awake_) {
    const Entry& e = entry(i);
    if (e.level != level || is_one_sided(i) || e.kind == RowKind::sum || !takes_part(i)) continue;
    if (frozen_count_ == dimension_) return;
    if (all_free_) F_.topLeftCorner(dimension_, dimension_).setIdentity();
    all_free_ = false;
    std::fill_n(v, dimension_, 0.0);
    for (int k = 0; k < e.extent; ++k) add_multiple(dimension_, e.B[k], &F_(k, 0), v);
    for (int c = 0; c < frozen_count_; ++c) {
      add_multiple(dimension_, -dot(dimension_, &frozen_(c, 0), v), &frozen_(c, 0), v);
    }
    const double left = dot(dimension_, v, v);
    if (left <= dependent_share * e.length * e.length) continue;
    double* const frozen = &frozen_(frozen_count_++, 0);
    std::fill_n(frozen, dimension_, 0.0);
    add_multiple(dimension_, 1.0 / std::sqrt(left), v, frozen);
    const double share = 1.0 / left;
    for (int k = 0; k < dimension_; ++k) Fv[k] = share * dot(dimension_, &F_(k, 0), v);
    for (int k = 0; k < dimension_; ++k) add_multiple(dimension_, -Fv[k], v, &F_(k, 0));
  }
}

}  // namespace zwang::solver
