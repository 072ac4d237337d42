#include "base/bounded_problem.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::solver {

namespace {

constexpr double unreachable_share = 1e-8;      // A Mc A' over A M^-1 A'
constexpr double blocked_share = 1e-8;          // B K B' over B B': what the levels above left free of a row
constexpr double dependent_share = 1e-18;       // the same, of a row against those frozen before it
constexpr double driven_share = 1e-8;           // |B.T| over |B||T|: below, the motor does not move the row
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

double nonzero(double length) {
  return length > 0.0 ? length : 1.0;
}

}  // namespace

BoundedProblem::BoundedProblem(int rows, int motors, int dimension)
    : B_(Eigen::MatrixXd::Zero(rows, dimension)),
      T_(Eigen::MatrixXd::Zero(motors, dimension)),
      V_(Eigen::MatrixXd::Zero(rows, dimension)),
      P_(Eigen::MatrixXd::Zero(rows, dimension)),
      d_(Eigen::VectorXd::Zero(rows)),
      tau_(Eigen::VectorXd::Zero(motors)),
      tau_lo_(Eigen::VectorXd::Zero(motors)),
      tau_hi_(Eigen::VectorXd::Zero(motors)),
      candidate_(Eigen::VectorXd::Zero(motors)),
      p_(Eigen::VectorXd::Zero(dimension)),
      fixed_(Eigen::VectorXd::Zero(dimension)),
      work_(Eigen::VectorXd::Zero(dimension)),
      solved_(Eigen::VectorXd::Zero(dimension)),
      F_(Eigen::MatrixXd::Zero(dimension, dimension)),
      frozen_(Eigen::MatrixXd::Zero(dimension, dimension)),
      gram_(Eigen::MatrixXd::Zero(dimension, dimension)),
      entries_(static_cast<std::size_t>(rows)),
      solutions_(static_cast<std::size_t>(rows)),
      program_(2 * rows + motors, dimension, dimension + rows) {
  posed_.reserve(static_cast<std::size_t>(rows));
  units_.reserve(static_cast<std::size_t>(rows));
  tied_.reserve(static_cast<std::size_t>(rows));
}

void BoundedProblem::resize(int rows, int motors, int dimension) noexcept {
  rows_ = rows;
  motors_ = motors;
  dimension_ = dimension;
}

void BoundedProblem::set_row(int i, const Row& row, double free_share) noexcept {
  Entry& e = entry(i);
  e = Entry{};
  e.kind = row.kind;
  e.quantity = row.quantity;
  e.level = row.level;
  e.lo = row.lo;
  e.hi = row.hi;
  e.weight = row.weight;
  e.fade = std::clamp(row.fade, 0.0, 1.0);
  e.force = e.fade * row.force;
  e.length = B(i).norm();
  if (e.kind == RowKind::sum && e.fade > 0.0) {
    e.lo /= e.fade;
    e.hi /= e.fade;
  }
  if (free_share < unreachable_share || e.fade == 0.0) {
    e.out = true;
    e.status = RowStatus::unreachable;
  }
}

void BoundedProblem::set_motor(int j, double lowest, double highest) noexcept {
  tau_lo_(j) = lowest;
  tau_hi_(j) = highest;
}

/// The levels as a table of contents.
bool BoundedProblem::solve(int max_iterations) noexcept {
  iterations_ = 0;
  frozen_count_ = 0;
  F_.topLeftCorner(dimension_, dimension_).setIdentity();
  p_.head(dimension_).setZero();
  tau_.head(motors_).setZero();
  bool exact = true;
  factorise_motors();
  bound_rows();
  for (int level = next_level(-1); level >= 0; level = next_level(level)) {
    project_rows(level);
    start_sums(level);
    exact = solve_forces(level, max_iterations) && exact;
    exact = solve_motion(level, max_iterations) && exact;
    freeze(level);
  }
  exact = least_torques(max_iterations) && exact;
  report();
  return exact;
}

int BoundedProblem::next_level(int after) const noexcept {
  int next = -1;
  for (int i = 0; i < rows_; ++i) {
    const int level = entries_[static_cast<std::size_t>(i)].level;
    if (level > after && (next < 0 || level < next)) next = level;
  }
  return next;
}

/// T'T, whose inverse gives the torques of least norm. Without full rank the motors do not reach every
/// motion.
void BoundedProblem::factorise_motors() noexcept {
  auto gram = gram_.topLeftCorner(dimension_, dimension_);
  gram.noalias() = T_.topLeftCorner(motors_, dimension_).transpose() * T_.topLeftCorner(motors_, dimension_);
  motors_reach_all_ = true;
  const double least_pivot = motor_rank_tolerance * gram.trace();
  for (int k = 0; k < dimension_; ++k) {  // Cholesky in place, lower
    const double pivot = gram(k, k) - gram.row(k).head(k).squaredNorm();
    if (!(pivot > least_pivot)) {
      motors_reach_all_ = false;
      return;
    }
    gram(k, k) = std::sqrt(pivot);
    for (int i = k + 1; i < dimension_; ++i) {
      gram(i, k) = (gram(i, k) - gram.row(i).head(k).dot(gram.row(k).head(k))) / gram(k, k);
    }
  }
}

/// No multiplier is unbounded: what the motors can do along a row bounds it, one-sided rows by a multiple of
/// that.
void BoundedProblem::bound_rows() noexcept {
  double scale = 0.0;
  for (int i = 0; i < rows_; ++i) {
    scale = std::max(
        {scale, std::abs(d_(i)) / nonzero(entry(i).length), std::abs(entry(i).force) * entry(i).length});
  }
  if (scale == 0.0) scale = 1.0;
  for (int i = 0; i < rows_; ++i) {
    Entry& e = entry(i);
    if (e.out || e.kind == RowKind::sum) continue;
    double force = largest_force(i);
    if (force == 0.0) {
      e.out = true;
      e.status = RowStatus::unreachable;
    }
    if (e.out || e.kind == RowKind::force) continue;
    if (!std::isfinite(force)) force = 1e7 * scale / e.length;
    if (is_one_sided(i)) force *= authority(e.quantity);
    e.lo = e.fade * (std::isfinite(e.lo) ? e.lo : -force);
    e.hi = e.fade * (std::isfinite(e.hi) ? e.hi : force);
  }
}

/// Upper bound of |nu| with B_i nu = T'tau: both sides times B_i.
double BoundedProblem::largest_force(int i) noexcept {
  double sum = 0.0;
  for (int j = 0; j < motors_; ++j) {
    const double along = std::abs(B_.row(i).head(dimension_).dot(T_.row(j).head(dimension_)));
    if (along > driven_share * T(j).norm() * entry(i).length)
      sum += along * std::max(-tau_lo_(j), tau_hi_(j));
  }
  const double length = B_.row(i).head(dimension_).squaredNorm();
  return length > 0.0 ? sum / length : 0.0;
}

/// V_i = F'B_i and P_i = F V_i = K B_i: the row as the levels above let it act.
void BoundedProblem::project_rows(int level) noexcept {
  const auto F = F_.topLeftCorner(dimension_, dimension_);
  for (int i = 0; i < rows_; ++i) {
    V(i).noalias() = B(i) * F;
    const bool blocked = V(i).squaredNorm() <= blocked_share * entry(i).length * entry(i).length;
    if (entry(i).level == level) entry(i).blocked = blocked;
    if (blocked) V(i).setZero();
    P(i).noalias() = V(i) * F.transpose();
  }
}

bool BoundedProblem::is_one_sided(int i) const noexcept {
  const RowKind kind = entries_[static_cast<std::size_t>(i)].kind;
  return kind == RowKind::upper || kind == RowKind::lower;
}

bool BoundedProblem::is_motion(int i) const noexcept {
  return is_one_sided(i) || entries_[static_cast<std::size_t>(i)].kind == RowKind::driver;
}

/// A row takes part in a stage while something of it is left free.
bool BoundedProblem::takes_part(int i) const noexcept {
  return !entries_[static_cast<std::size_t>(i)].out && V_.row(i).head(dimension_).squaredNorm() > 0.0;
}

/// Below its own level a row holds what it reached with whatever that takes.
Range BoundedProblem::bounds_at(int i, int level) const noexcept {
  const Entry& e = entries_[static_cast<std::size_t>(i)];
  if (e.level == level) return {e.lo, e.hi};
  return {e.kind == RowKind::lower ? 0.0 : -infinity, e.kind == RowKind::upper ? 0.0 : infinity};
}

/// R = 1/w + L_jj (1 - alpha)/alpha, at the row's own level.
double BoundedProblem::softness(int i) const noexcept {
  const Entry& e = entries_[static_cast<std::size_t>(i)];
  return (is_motion(i) ? 1.0 / e.weight : 0.0) + held_softness(i);
}

/// Of what a row keeps against the levels below it. A weight decides how much of b is worth reaching; what
/// was reached is kept firmly. A fading row lets go in the measure that it fades, so that it never does in
/// one step.
double BoundedProblem::held_softness(int i) const noexcept {
  const Entry& e = entries_[static_cast<std::size_t>(i)];
  return e.fade < 1.0 ? e.length * e.length * (1.0 - e.fade) / e.fade : 0.0;
}

/// What the level's equality and force rows achieved, saturated or not, stays for the levels below:
/// B_i.dp + R dmu = 0 with mu free. From then on a force w moves the robot by K w, and one more row takes
///
///   K := K - K B B'K / (R + B'K B) = F (1 - v v' / (R + v.v)) F',   v = F'B
///
/// A hard row (R = 0) closes its direction, a soft one makes the robot heavier along it.
void BoundedProblem::freeze(int level) noexcept {
  auto F = F_.topLeftCorner(dimension_, dimension_);
  for (int i = 0; i < rows_; ++i) {
    const Entry& e = entry(i);
    if (e.level != level || is_one_sided(i) || e.kind == RowKind::sum || !takes_part(i)) continue;
    if (frozen_count_ == dimension_) return;
    auto v = solved_.head(dimension_);
    v.noalias() = F.transpose() * B(i).transpose();
    for (int c = 0; c < frozen_count_; ++c) {
      const auto other = frozen_.col(c).head(dimension_);
      v -= other.dot(v) * other;
    }
    const double left = v.squaredNorm();
    if (left <= dependent_share * e.length * e.length) continue;
    const double R = held_softness(i);
    if (R == 0.0) frozen_.col(frozen_count_++).head(dimension_) = v / std::sqrt(left);
    work_.head(dimension_).noalias() = F * v;
    work_.head(dimension_) *= (1.0 - std::sqrt(R / (R + left))) / left;
    F.noalias() -= work_.head(dimension_) * v.transpose();
  }
}

}  // namespace zwang::solver
