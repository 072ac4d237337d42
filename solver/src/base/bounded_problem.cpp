#include "base/bounded_problem.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::solver {

namespace {

constexpr double unreachable_share = 1e-8;      // A Mc A' over A M^-1 A'
constexpr double blocked_share = 1e-8;          // B K B' over B B': what the levels above left free of a row
constexpr double dependent_share = 1e-18;       // the same, of a row against those frozen before it
constexpr double driven_share = 1e-8;           // |B.T| over |B||T|: below, the motor does not move the row
constexpr double bound_tolerance = 1e-9;        // relative: when nu counts as being at its bound
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
  F_.topLeftCorner(dimension_, dimension_).setIdentity();
  p_.head(dimension_).setZero();
  tau_.head(motors_).setZero();
  bool exact = true;
  factorise_motors();
  bound_rows();
  for (int level = next_level(-1); level >= 0; level = next_level(level)) {
    project_rows(level);
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
    if (e.out) continue;
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

/// R = L_jj (1 - alpha)/alpha.
double BoundedProblem::softness(int i) const noexcept {
  const Entry& e = entries_[static_cast<std::size_t>(i)];
  return e.fade < 1.0 ? e.length * e.length * (1.0 - e.fade) / e.fade : 0.0;
}

/// The limits of the levels above that are posed again; with `level` the stage's rows come with them.
void BoundedProblem::pose_limits_above(int level) noexcept {
  for (int i = 0; i < rows_; ++i) {
    if (is_one_sided(i) && entry(i).level < level && takes_part(i)) posed_.push_back(i);
  }
}

/// min sum (1 - phi)^2 with torques that make the motion, the limits above braking as they must. Mostly
/// phi = 1 is possible: tried first with the limits as they are, then with what they need.
bool BoundedProblem::solve_forces(int level, int max_iterations) noexcept {
  posed_.clear();
  fixed_.head(dimension_) = p_.head(dimension_);
  for (int i = 0; i < rows_; ++i) {
    if (entry(i).kind != RowKind::force || entry(i).level != level || !takes_part(i)) continue;
    posed_.push_back(i);
    fixed_.head(dimension_) += P(i).transpose() * entry(i).force;
  }
  if (posed_.empty()) return true;
  const int forces = static_cast<int>(posed_.size());
  pose_limits_above(level);
  bool exact = true;
  work_.head(dimension_) = fixed_.head(dimension_);
  bool full = limits_above_hold(forces) && torques_for(work_);
  if (!full && static_cast<int>(posed_.size()) > forces && motors_reach_all_) {
    exact = brake(forces, level, max_iterations);
    full = torques_for(work_);
    if (full) take_limits(forces);
  }
  if (full) {
    for (int k = 0; k < forces; ++k) entry(posed_[static_cast<std::size_t>(k)]).phi = 1.0;
    tau_.head(motors_) = candidate_.head(motors_);
  } else {
    exact = share_torque(forces, level, max_iterations) && exact;
  }
  p_.head(dimension_) = work_.head(dimension_);
  return exact;
}

/// Whether the posed limits hold at work_ with the multipliers that they have.
bool BoundedProblem::limits_above_hold(int first) noexcept {
  for (std::size_t k = static_cast<std::size_t>(first); k < posed_.size(); ++k) {
    if (room_of(posed_[k], work_) < 0.0) return false;
  }
  return true;
}

/// How far a limit is from what it must keep, with its present multiplier; negative where it does not.
double BoundedProblem::room_of(int i, const Eigen::VectorXd& p) noexcept {
  const Entry& e = entry(i);
  const double s = B(i).dot(p.head(dimension_)) + softness(i) * e.nu - d_(i) - e.offset;
  return e.kind == RowKind::upper ? -s : s;
}

/// All forces in full and the limits above braking them, motors aside; work_ is the motion.
bool BoundedProblem::brake(int forces, int level, int max_iterations) noexcept {
  const std::vector<int>::iterator begin = posed_.begin();
  std::rotate(begin, begin + forces, posed_.end());
  const int limits = static_cast<int>(posed_.size()) - forces;
  for (int k = 0; k < limits; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    fixed_.head(dimension_) -= P(i).transpose() * entry(i).nu;
  }
  pose_motion(limits, level, false);
  const bool exact = program_.solve(max_iterations, iterations_);
  take_p(limits);
  std::rotate(begin, begin + limits, posed_.end());
  return exact;
}

void BoundedProblem::take_limits(int first) noexcept {
  for (int k = first; k < static_cast<int>(posed_.size()); ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    entry(i).nu = program_.z(k - first) / V(i).norm();
  }
}

/// Torque does not suffice for all forces.
bool BoundedProblem::share_torque(int forces, int level, int max_iterations) noexcept {
  fixed_.head(dimension_) = p_.head(dimension_);
  const int n = static_cast<int>(posed_.size());
  for (int k = forces; k < n; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    fixed_.head(dimension_) -= P(i).transpose() * entry(i).nu;
  }
  resize_program(n, level, 0, true);
  for (int k = 0; k < n; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    const Entry& e = entry(i);
    if (k < forces) {
      const double length = nonzero(V(i).norm() * std::abs(e.force));
      units_.push_back(e.force / length);
      program_.R(k) = 2.0 / (length * length);
      program_.g(k) = 2.0 / length;
      program_.lo(k) = 0.0;
      program_.hi(k) = length;
    } else {
      pose_multiplier(k, level);
    }
  }
  pose_motors(n, level);
  const bool exact = program_.solve(max_iterations, iterations_);
  take_p(n);
  take_motors(n);
  for (int k = 0; k < n; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    if (k < forces) {
      entry(i).phi = program_.z(k) / program_.hi(k);
    } else {
      entry(i).nu = program_.z(k) / V(i).norm();
    }
  }
  return exact;
}

/// Variables: `n` of rows, then the motors, then the room that each limit above keeps.
void BoundedProblem::resize_program(int n, int level, int curvature_rows, bool with_motors) noexcept {
  units_.clear();
  int limits = 0;
  for (int k = 0; k < n && with_motors; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    if (is_one_sided(i) && entry(i).level < level) ++limits;
  }
  program_.resize(n + (with_motors ? motors_ + limits : 0), curvature_rows,
                  with_motors ? dimension_ + limits : 0);
}

/// The variable nu |V_i| of a motion row: its bounds, and where it stands.
void BoundedProblem::pose_multiplier(int k, int level) noexcept {
  const int i = posed_[static_cast<std::size_t>(k)];
  const double length = V(i).norm();
  const Range bounds = bounds_at(i, level);
  units_.push_back(1.0 / length);
  program_.lo(k) = bounds.low * length;
  program_.hi(k) = bounds.high * length;
  program_.z(k) = is_one_sided(i) ? entry(i).nu * length : 0.0;
}

/// The equations of the `n` row variables: torques make the motion, and the limits above stay kept,
/// B_i.p + R nu + room = b. Without them a level whose torque runs out would trade a limit above for itself.
void BoundedProblem::pose_motors(int n, int level) noexcept {
  for (int k = 0; k < n; ++k) {
    program_.E(k).head(dimension_) =
        -P(posed_[static_cast<std::size_t>(k)]).transpose() * units_[static_cast<std::size_t>(k)];
  }
  for (int j = 0; j < motors_; ++j) {
    const double length = nonzero(T(j).norm());
    program_.E(n + j).head(dimension_) = T(j).transpose() / length;
    program_.lo(n + j) = tau_lo_(j) * length;
    program_.hi(n + j) = tau_hi_(j) * length;
    program_.z(n + j) = tau_(j) * length;
  }
  int limit = 0;
  for (int k = 0; k < n; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    if (!is_one_sided(i) || entry(i).level >= level) continue;
    const double sign = entry(i).kind == RowKind::upper ? 1.0 : -1.0;
    const double length = V(i).norm();
    const int equation = dimension_ + limit;
    for (int other = 0; other < n; ++other) {
      const double along = V(i).dot(V(posed_[static_cast<std::size_t>(other)]));
      program_.E(other)(equation) = sign * along * units_[static_cast<std::size_t>(other)] / length;
    }
    program_.E(k)(equation) += sign * softness(i) / (length * length);
    const int room = n + motors_ + limit++;
    program_.E(room)(equation) = 1.0;
    program_.lo(room) = 0.0;
    program_.hi(room) = infinity;
    program_.z(room) = std::max(0.0, room_of(i, p_) / length);
  }
}

void BoundedProblem::take_motors(int first) noexcept {
  for (int j = 0; j < motors_; ++j) {
    tau_(j) = std::clamp(program_.z(first + j) / nonzero(T(j).norm()), tau_lo_(j), tau_hi_(j));
  }
}

/// The level's own motion rows, and the limits of the levels above.
void BoundedProblem::pose_rows(int level) noexcept {
  posed_.clear();
  for (int i = 0; i < rows_; ++i) {
    const Entry& e = entry(i);
    if (e.level == level && e.kind != RowKind::force && takes_part(i)) posed_.push_back(i);
  }
  pose_limits_above(level);
}

/// Most of the time no motor is at its limit: the problem is solved without the motors first, and stands when
/// they can.
bool BoundedProblem::solve_motion(int level, int max_iterations) noexcept {
  pose_rows(level);
  if (posed_.empty()) return true;
  const int n = static_cast<int>(posed_.size());
  fixed_.head(dimension_) = p_.head(dimension_);
  for (const int i : posed_) {
    if (is_one_sided(i)) fixed_.head(dimension_) -= P(i).transpose() * entry(i).nu;
  }
  bool exact = true;
  bool possible = false;
  if (motors_reach_all_) {
    pose_motion(n, level, false);
    exact = program_.solve(max_iterations, iterations_);
    take_p(n);
    possible = torques_for(work_);
  }
  if (possible) {
    tau_.head(motors_) = candidate_.head(motors_);
  } else {
    pose_motion(n, level, true);
    exact = program_.solve(max_iterations, iterations_);
    take_p(n);
    take_motors(n);
  }
  take_multipliers(level);
  p_.head(dimension_) = work_.head(dimension_);
  exact = least_multipliers(level, max_iterations) && exact;
  for (const int i : posed_) {
    // A soft row rests where a . Xdd + R nu = b; what is beyond that it could not hold.
    if (is_one_sided(i) && entry(i).level == level) entry(i).offset = std::max(0.0, -room_of(i, p_));
    if (entry(i).kind == RowKind::lower && entry(i).level == level) entry(i).offset *= -1.0;
  }
  return exact;
}

void BoundedProblem::pose_motion(int n, int level, bool with_motors) noexcept {
  resize_program(n, level, dimension_, with_motors);
  for (int k = 0; k < n; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    const double length = V(i).norm();
    program_.V(k) = V(i).transpose() / length;
    program_.g(k) = (d_(i) + entry(i).offset - B(i).dot(fixed_.head(dimension_))) / length;
    program_.R(k) = softness(i) / (length * length);
    pose_multiplier(k, level);
  }
  if (with_motors) pose_motors(n, level);
}

/// p of the stage's solution, in work_.
void BoundedProblem::take_p(int n) noexcept {
  work_.head(dimension_) = fixed_.head(dimension_);
  for (int k = 0; k < n; ++k) {
    const double z = program_.z(k) * units_[static_cast<std::size_t>(k)];
    work_.head(dimension_) += P(posed_[static_cast<std::size_t>(k)]).transpose() * z;
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
    e.nu = program_.z(variable) / V(i).norm();
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
    const double length = V(i).norm();
    program_.E(k) = V(i).transpose() / length;
    program_.R(k) = 1.0 / (length * length);
    program_.lo(k) = bounds_at(i, level).low * length;
    program_.hi(k) = bounds_at(i, level).high * length;
    program_.z(k) = entry(i).nu * length;
  }
  const bool exact = program_.solve(max_iterations, iterations_);
  for (int k = 0; k < n; ++k) {
    const int i = tied_[static_cast<std::size_t>(k)];
    entry(i).nu = program_.z(k) / V(i).norm();
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
  posed_.clear();
  pose_motors(0, 0);
  for (int j = 0; j < motors_; ++j) {
    const double length = nonzero(T(j).norm());
    program_.R(j) = 1.0 / (length * length);
  }
  const bool exact = program_.solve(max_iterations, iterations_);
  take_motors(0);
  return exact;
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
    if (e.level != level || is_one_sided(i) || !takes_part(i)) continue;
    if (frozen_count_ == dimension_) return;
    auto v = solved_.head(dimension_);
    v.noalias() = F.transpose() * B(i).transpose();
    for (int c = 0; c < frozen_count_; ++c) {
      const auto other = frozen_.col(c).head(dimension_);
      v -= other.dot(v) * other;
    }
    const double left = v.squaredNorm();
    if (left <= dependent_share * e.length * e.length) continue;
    const double R = softness(i);
    if (R == 0.0) frozen_.col(frozen_count_++).head(dimension_) = v / std::sqrt(left);
    work_.head(dimension_).noalias() = F * v;
    work_.head(dimension_) *= (1.0 - std::sqrt(R / (R + left))) / left;
    F.noalias() -= work_.head(dimension_) * v.transpose();
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
      row.status = e.out           ? e.status
                   : e.blocked     ? RowStatus::blocked
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
    } else if (e.blocked) {
      row.status = RowStatus::blocked;
    } else {
      row.status = motor_at_limit ? RowStatus::torque_limited : RowStatus::conflict;
    }
  }
}

}  // namespace zwang::solver
