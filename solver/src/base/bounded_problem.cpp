#include "base/bounded_problem.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::solver {

namespace {

constexpr double unreachable_share = 1e-8;  // A Mc A' over A M^-1 A'
constexpr double blocked_share = 1e-6;      // length of a row that the levels above left free, relative
constexpr double bound_tolerance = 1e-9;    // relative: when nu counts as being at its bound
constexpr double motor_rank_tolerance = 1e-12;  // of a pivot of T'T, relative to its trace
constexpr double torque_tolerance =
    1e-12;  // relative: rounding that least-squares torques may show at a limit

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
      BN_(Eigen::MatrixXd::Zero(rows, dimension)),
      d_(Eigen::VectorXd::Zero(rows)),
      tau_(Eigen::VectorXd::Zero(motors)),
      tau_lo_(Eigen::VectorXd::Zero(motors)),
      tau_hi_(Eigen::VectorXd::Zero(motors)),
      candidate_(Eigen::VectorXd::Zero(motors)),
      p_(Eigen::VectorXd::Zero(dimension)),
      fixed_(Eigen::VectorXd::Zero(dimension)),
      work_(Eigen::VectorXd::Zero(dimension)),
      solved_(Eigen::VectorXd::Zero(dimension)),
      frozen_(Eigen::MatrixXd::Zero(dimension, dimension)),
      gram_(Eigen::MatrixXd::Zero(dimension, dimension)),
      entries_(static_cast<std::size_t>(rows)),
      solutions_(static_cast<std::size_t>(rows)),
      program_(rows + motors, dimension) {
  posed_.reserve(static_cast<std::size_t>(rows));
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
  e.fade = std::clamp(row.fade, 0.0, 1.0);
  e.force = e.fade * row.force;
  e.length = B(i).norm();
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
  p_.head(dimension_).setZero();
  tau_.head(motors_).setZero();
  bool exact = true;
  factorise_motors();
  bound_rows();
  for (int level = next_level(-1); level >= 0; level = next_level(level)) {
    project_rows();
    note_achieved();
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
    if (e.out || e.kind == RowKind::force) continue;
    double force = largest_force(i);
    if (force * e.length * e.length < unreachable_share * std::abs(d_(i))) {
      e.out = true;
      e.status = RowStatus::unreachable;
      continue;
    }
    if (!std::isfinite(force)) force = 1e7 * scale / e.length;
    if (is_one_sided(i)) force *= authority(e.quantity);
    e.lo = e.fade * (std::isfinite(e.lo) ? e.lo : -force);
    e.hi = e.fade * (std::isfinite(e.hi) ? e.hi : force);
  }
}

/// Upper bound of |nu| with B_i nu = T'tau: both sides times B_i.
double BoundedProblem::largest_force(int i) const noexcept {
  double sum = 0.0;
  for (int j = 0; j < motors_; ++j) {
    const double along = std::abs(B_.row(i).head(dimension_).dot(T_.row(j).head(dimension_)));
    if (along > 0.0) sum += along * std::max(-tau_lo_(j), tau_hi_(j));
  }
  const double length = B_.row(i).head(dimension_).squaredNorm();
  return length > 0.0 ? sum / length : 0.0;
}

void BoundedProblem::project_rows() noexcept {
  const auto Q = frozen_.topLeftCorner(dimension_, frozen_count_);
  for (int i = 0; i < rows_; ++i) {
    auto row = BN_.row(i).head(dimension_);
    row = B(i);
    for (int c = 0; c < frozen_count_; ++c) row -= row.dot(Q.col(c)) * Q.col(c).transpose();
    if (row.norm() <= blocked_share * entry(i).length) row.setZero();
  }
}

/// Where the soft rows above stand before the level begins.
void BoundedProblem::note_achieved() noexcept {
  for (int i = 0; i < rows_; ++i) entry(i).achieved = B(i).dot(p_.head(dimension_));
}

bool BoundedProblem::is_one_sided(int i) const noexcept {
  const RowKind kind = entries_[static_cast<std::size_t>(i)].kind;
  return kind == RowKind::upper || kind == RowKind::lower;
}

/// A row takes part in a stage while something of it is left free.
bool BoundedProblem::takes_part(int i) const noexcept {
  return !entries_[static_cast<std::size_t>(i)].out && BN_.row(i).head(dimension_).squaredNorm() > 0.0;
}

/// Below its own level a row holds what it reached with whatever that takes.
Range BoundedProblem::bounds_at(int i, int level) const noexcept {
  const Entry& e = entries_[static_cast<std::size_t>(i)];
  if (e.level == level) return {e.lo, e.hi};
  return {e.kind == RowKind::lower ? 0.0 : -infinity, e.kind == RowKind::upper ? 0.0 : infinity};
}

/// R = L_jj (1 - alpha)/alpha.
double BoundedProblem::softness(int i) const noexcept {
  const Entry& e = entries_[static_cast<std::size_t>(i)];
  return e.fade < 1.0 ? e.length * e.length * (1.0 - e.fade) / e.fade : 0.0;
}

/// min sum (1 - phi)^2 with torques that make p + sum BN f phi; mostly phi = 1 is possible, which is tried
/// first.
bool BoundedProblem::solve_forces(int level, int max_iterations) noexcept {
  posed_.clear();
  auto wished = work_.head(dimension_);
  wished = p_.head(dimension_);
  for (int i = 0; i < rows_; ++i) {
    if (entry(i).kind != RowKind::force || entry(i).level != level || !takes_part(i)) continue;
    posed_.push_back(i);
    wished += BN_.row(i).head(dimension_).transpose() * entry(i).force;
  }
  if (posed_.empty()) return true;
  if (torques_for(work_)) {
    for (const int i : posed_) entry(i).phi = 1.0;
    p_.head(dimension_) = wished;
    tau_.head(motors_) = candidate_.head(motors_);
    return true;
  }
  const int n = static_cast<int>(posed_.size());
  program_.resize(n + motors_, 0, dimension_);
  for (int k = 0; k < n; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    const double length = nonzero(BN_.row(i).head(dimension_).norm() * std::abs(entry(i).force));
    program_.R(k) = 2.0 / (length * length);
    program_.g(k) = 2.0 / length;
    program_.lo(k) = 0.0;
    program_.hi(k) = length;
    program_.E(k) = -BN_.row(i).head(dimension_).transpose() * (entry(i).force / length);
  }
  pose_motors(n);
  const bool exact = program_.solve(max_iterations, iterations_);
  for (int k = 0; k < n; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    entry(i).phi = program_.z(k) / program_.hi(k);
    p_.head(dimension_) += BN_.row(i).head(dimension_).transpose() * (entry(i).force * entry(i).phi);
  }
  take_motors(n);
  return exact;
}

void BoundedProblem::pose_motors(int first) noexcept {
  for (int j = 0; j < motors_; ++j) {
    const double length = nonzero(T(j).norm());
    program_.E(first + j) = T(j).transpose() / length;
    program_.lo(first + j) = tau_lo_(j) * length;
    program_.hi(first + j) = tau_hi_(j) * length;
    program_.z(first + j) = tau_(j) * length;
  }
}

void BoundedProblem::take_motors(int first) noexcept {
  for (int j = 0; j < motors_; ++j) {
    tau_(j) = std::clamp(program_.z(first + j) / nonzero(T(j).norm()), tau_lo_(j), tau_hi_(j));
  }
}

/// The rows of the stage: the level's own drivers, the one-sided rows down to it, and the soft rows above it,
/// which resist.
void BoundedProblem::pose_rows(int level) noexcept {
  posed_.clear();
  for (int i = 0; i < rows_; ++i) {
    const Entry& e = entry(i);
    const bool own = e.kind == RowKind::driver && e.level == level;
    const bool limit = is_one_sided(i) && e.level <= level;
    const bool resists = !is_one_sided(i) && e.level < level && e.fade < 1.0;
    if ((own || limit || resists) && takes_part(i)) posed_.push_back(i);
  }
}

/// Most of the time no motor is at its limit: the problem is solved without the motors first, and stands when
/// they can.
bool BoundedProblem::solve_motion(int level, int max_iterations) noexcept {
  pose_rows(level);
  if (posed_.empty()) return true;
  fixed_.head(dimension_) = p_.head(dimension_);
  for (const int i : posed_) {
    if (is_one_sided(i)) fixed_.head(dimension_) -= BN_.row(i).head(dimension_).transpose() * entry(i).nu;
  }
  pose_motion(level, false);
  bool exact = program_.solve(max_iterations, iterations_);
  take_p();
  if (!torques_for(work_)) {
    pose_motion(level, true);
    exact = program_.solve(max_iterations, iterations_);
    take_p();
    take_motors(static_cast<int>(posed_.size()));
  } else {
    tau_.head(motors_) = candidate_.head(motors_);
  }
  take_multipliers(level);
  p_.head(dimension_) = work_.head(dimension_);
  exact = least_multipliers(level, max_iterations) && exact;
  for (const int i : posed_) {
    if (!is_one_sided(i)) continue;
    Entry& e = entry(i);
    // A soft row rests where a . Xdd + R nu = b; what is beyond that it could not hold.
    const double s = B(i).dot(p_.head(dimension_)) + softness(i) * e.nu - d_(i);
    e.offset = e.kind == RowKind::upper ? std::max(e.offset, s) : std::min(e.offset, s);
  }
  return exact;
}

void BoundedProblem::pose_motion(int level, bool with_motors) noexcept {
  const int n = static_cast<int>(posed_.size());
  program_.resize(n + (with_motors ? motors_ : 0), dimension_, with_motors ? dimension_ : 0);
  for (int k = 0; k < n; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    const Entry& e = entry(i);
    const double length = BN_.row(i).head(dimension_).norm();
    const bool resists = e.level < level && !is_one_sided(i);
    const double target = resists ? e.achieved : d_(i) + e.offset;
    const Range bounds = bounds_at(i, level);
    program_.V(k) = BN_.row(i).head(dimension_).transpose() / length;
    program_.g(k) = (target - B(i).dot(fixed_.head(dimension_))) / length;
    program_.R(k) = softness(i) / (length * length);
    program_.lo(k) = bounds.low * length;
    program_.hi(k) = bounds.high * length;
    program_.z(k) = is_one_sided(i) ? e.nu * length : 0.0;
    if (with_motors) program_.E(k) = -program_.V(k);
  }
  if (with_motors) pose_motors(n);
}

/// p of the stage's solution, in work_.
void BoundedProblem::take_p() noexcept {
  work_.head(dimension_) = fixed_.head(dimension_);
  for (std::size_t k = 0; k < posed_.size(); ++k) {
    const auto row = BN_.row(posed_[k]).head(dimension_);
    work_.head(dimension_) += row.transpose() * (program_.z(static_cast<int>(k)) / row.norm());
  }
}

/// Multipliers of the stage's solution; `tied_` are the rows whose share of the force is not unique.
void BoundedProblem::take_multipliers(int level) noexcept {
  tied_.clear();
  bool ambiguous = false;
  for (std::size_t k = 0; k < posed_.size(); ++k) {
    const int variable = static_cast<int>(k);
    const int i = posed_[k];
    Entry& e = entry(i);
    const bool resists = e.level < level && !is_one_sided(i);
    if (resists) continue;
    e.nu = program_.z(variable) / BN_.row(i).head(dimension_).norm();
    if (e.level == level) e.nu = std::clamp(e.nu, e.lo, e.hi);
    if (e.fade < 1.0) continue;
    const bool free = program_.is_free(variable);
    if (!free && std::abs(program_.reduced_gradient(variable)) > 100.0 * program_.gradient_tolerance())
      continue;
    tied_.push_back(i);
    ambiguous = ambiguous || !free;
  }
  if (!ambiguous) tied_.clear();
}

/// min 1/2 |nu|^2 over the tied rows, their sum kept.
bool BoundedProblem::least_multipliers(int level, int max_iterations) noexcept {
  if (tied_.size() < 2) return true;
  const int n = static_cast<int>(tied_.size());
  program_.resize(n, 0, dimension_);
  for (int k = 0; k < n; ++k) {
    const int i = tied_[static_cast<std::size_t>(k)];
    const double length = BN_.row(i).head(dimension_).norm();
    program_.E(k) = BN_.row(i).head(dimension_).transpose() / length;
    program_.R(k) = 1.0 / (length * length);
    program_.lo(k) = bounds_at(i, level).low * length;
    program_.hi(k) = bounds_at(i, level).high * length;
    program_.z(k) = entry(i).nu * length;
  }
  const bool exact = program_.solve(max_iterations, iterations_);
  for (int k = 0; k < n; ++k) {
    const int i = tied_[static_cast<std::size_t>(k)];
    entry(i).nu = program_.z(k) / BN_.row(i).head(dimension_).norm();
  }
  return exact;
}

/// Least-norm torques for p into candidate_; false when the motors do not reach p or a limit is in the way.
bool BoundedProblem::torques_for(const Eigen::VectorXd& p) noexcept {
  if (!motors_reach_all_) return false;
  const auto factor = gram_.topLeftCorner(dimension_, dimension_);
  auto y = solved_.head(dimension_);
  y = p.head(dimension_);
  for (int k = 0; k < dimension_; ++k) y(k) = (y(k) - factor.row(k).head(k).dot(y.head(k))) / factor(k, k);
  for (int k = dimension_ - 1; k >= 0; --k) {
    for (int i = k + 1; i < dimension_; ++i) y(k) -= factor(i, k) * y(i);
    y(k) /= factor(k, k);
  }
  candidate_.head(motors_).noalias() = T_.topLeftCorner(motors_, dimension_) * y;
  for (int j = 0; j < motors_; ++j) {
    const double slack = torque_tolerance * (std::abs(tau_lo_(j)) + std::abs(tau_hi_(j)));
    const double room = std::isfinite(slack) ? slack : 0.0;
    if (candidate_(j) < tau_lo_(j) - room || candidate_(j) > tau_hi_(j) + room) return false;
    candidate_(j) = std::clamp(candidate_(j), tau_lo_(j), tau_hi_(j));
  }
  return true;
}

/// The last stage: of all torques that make p, the smallest.
bool BoundedProblem::least_torques(int max_iterations) noexcept {
  if (torques_for(p_)) {
    tau_.head(motors_) = candidate_.head(motors_);
    return true;
  }
  program_.resize(motors_, 0, dimension_);
  pose_motors(0);
  for (int j = 0; j < motors_; ++j) {
    const double length = nonzero(T(j).norm());
    program_.R(j) = 1.0 / (length * length);
  }
  const bool exact = program_.solve(max_iterations, iterations_);
  take_motors(0);
  return exact;
}

/// What the level's hard rows achieved, saturated ones too, stays: their directions are closed to the levels
/// below.
void BoundedProblem::freeze(int level) noexcept {
  for (int i = 0; i < rows_; ++i) {
    const Entry& e = entry(i);
    if (e.level != level || is_one_sided(i) || e.fade < 1.0 || !takes_part(i)) continue;
    if (frozen_count_ == dimension_) return;
    auto q = frozen_.col(frozen_count_).head(dimension_);
    q = B(i).transpose();
    for (int pass = 0; pass < 2; ++pass) {
      for (int c = 0; c < frozen_count_; ++c) {
        const auto other = frozen_.col(c).head(dimension_);
        q -= other.dot(q) * other;
      }
    }
    const double left = q.norm();
    if (left <= blocked_share * e.length) continue;
    q /= left;
    ++frozen_count_;
  }
}

void BoundedProblem::report() noexcept {
  bool motor_at_limit = false;
  for (int j = 0; j < motors_; ++j) {
    const double width = bound_tolerance * (tau_hi_(j) - tau_lo_(j));
    if (!std::isfinite(width)) continue;
    motor_at_limit = motor_at_limit || tau_(j) <= tau_lo_(j) + width || tau_(j) >= tau_hi_(j) - width;
  }
  for (int i = 0; i < rows_; ++i) {
    const Entry& e = entry(i);
    RowSolution& row = solutions_[static_cast<std::size_t>(i)];
    row = RowSolution{};
    if (e.kind == RowKind::force) {
      row.phi = e.phi;
      row.nu = e.phi * e.force;
      row.saturated = e.phi < 1.0 - bound_tolerance;
      const bool blocked = BN_.row(i).head(dimension_).squaredNorm() == 0.0 && e.phi == 0.0;
      row.status = e.out           ? e.status
                   : blocked       ? RowStatus::blocked
                   : row.saturated ? RowStatus::torque_limited
                                   : RowStatus::held;
      continue;
    }
    const double s = B(i).dot(p_.head(dimension_)) - d_(i);
    row.nu = e.out ? 0.0 : e.nu;
    row.residual = e.kind == RowKind::upper   ? std::max(s, 0.0)
                   : e.kind == RowKind::lower ? std::min(s, 0.0)
                                              : s;
    const double width = bound_tolerance * std::max(1.0, std::max(std::abs(e.lo), std::abs(e.hi)));
    const bool at_low = e.nu <= e.lo + width && e.lo < 0.0;
    const bool at_high = e.nu >= e.hi - width && e.hi > 0.0;
    row.saturated = !e.out && (at_low || at_high);
    const bool met = std::abs(row.residual) <= 1e-8 * (1.0 + std::abs(d_(i)));
    if (met || (is_soft(i) && !row.saturated && !e.out)) {
      row.status = e.out && !met ? e.status : RowStatus::held;
    } else if (e.out) {
      row.status = e.status;
    } else if (row.saturated) {
      row.status = is_one_sided(i) ? RowStatus::conflict : RowStatus::force_limited;
    } else if (BN_.row(i).head(dimension_).squaredNorm() == 0.0) {
      row.status = RowStatus::blocked;
    } else {
      row.status = motor_at_limit ? RowStatus::torque_limited : RowStatus::conflict;
    }
  }
}

}  // namespace zwang::solver
