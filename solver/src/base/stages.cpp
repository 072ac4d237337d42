// The stages of one level of BoundedProblem: its force rows, its motion rows, and the torques that make them.
#include <algorithm>
#include <cmath>

#include "base/bounded_problem.hpp"

namespace zwang::solver {

/// min sum (1 - phi)^2 with torques that make the motion, the limits above braking as they must. Mostly
/// phi = 1 is possible: tried first with the limits as they are, then with what they need.
bool BoundedProblem::solve_forces(int level, int max_iterations) noexcept {
  if (forces_.empty()) return true;
  posed_ = forces_;
  copy(p_, work_);
  for (const int i : forces_) push(i, entry(i).force, work_);
  const int forces = static_cast<int>(posed_.size());
  pose_limits_above();
  bool exact = true;
  bool full = limits_above_hold(forces) && sums_hold(level, work_) && torques_for(work_);
  if (!full && static_cast<int>(posed_.size()) > forces && motors_reach_all_) {
    const Push alone = push_alone(forces, level, work_);
    if (alone.row < 0) exact = brake(forces, level, max_iterations);
    full = sums_hold(level, work_) && torques_for(work_);
    if (full && alone.row < 0) take_limits(forces);
    if (full && alone.row >= 0) entry(alone.row).nu = alone.nu;
  }
  if (full) {
    for (int k = 0; k < forces; ++k) entry(posed_[static_cast<std::size_t>(k)]).phi = 1.0;
    tau_.head(motors_) = candidate_.head(motors_);
  } else {
    wake_idle_limits(level);
    posed_.resize(static_cast<std::size_t>(forces));
    pose_limits_above();
    exact = share_torque(forces, level, max_iterations) && exact;
  }
  torques_are_least_ = full;
  copy(work_, p_);
  if (!full) note_limits(level);
  return exact;
}

/// All forces in full and the limits above braking them, motors aside; work_ is the motion.
bool BoundedProblem::brake(int forces, int level, int max_iterations) noexcept {
  const std::vector<int>::iterator begin = posed_.begin();
  std::rotate(begin, begin + forces, posed_.end());
  take_out_limits(work_);
  const int limits = static_cast<int>(posed_.size()) - forces;
  pose_motion(limits, level, Posed::rows);
  const bool exact = program_.solve(max_iterations, iterations_);
  take_p(limits);
  std::rotate(begin, begin + limits, posed_.end());
  return exact;
}

void BoundedProblem::take_limits(int first) noexcept {
  for (int k = first; k < static_cast<int>(posed_.size()); ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    entry(i).nu = program_.z(k - first) * entry(i).inverse_reach;
  }
}

/// Torque does not suffice for all forces.
bool BoundedProblem::share_torque(int forces, int level, int max_iterations) noexcept {
  copy(p_, fixed_);
  const int n = static_cast<int>(posed_.size());
  for (int k = forces; k < n; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    push(i, -entry(i).nu, fixed_);
  }
  list_sums(level);
  resize_program(n, level, 0, Posed::motors);
  for (int k = 0; k < n; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    const Entry& e = entry(i);
    if (k < forces) {
      const double length = nonzero(e.reach * std::abs(e.force));
      units_.push_back(e.force / length);
      program_.R(k) = 2.0 / (length * length);
      program_.g(k) = 2.0 / length;
      program_.lo(k) = 0.0;
      program_.hi(k) = length;
    } else {
      pose_multiplier(k, level);
    }
  }
  pose_motors(n);
  pose_kept(n, level, n + motors_, dimension_);
  const bool exact = program_.solve(max_iterations, iterations_);
  take_p(n);
  take_motors(n);
  for (int k = 0; k < n; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    if (k < forces) {
      entry(i).phi = program_.z(k) / program_.hi(k);
    } else {
      entry(i).nu = program_.z(k) * entry(i).inverse_reach;
    }
  }
  return exact;
}

/// Variables: `n` of rows, then the motors, the room that each limit above keeps, and the listed sums.
void BoundedProblem::resize_program(int n, int level, int curvature_rows, Posed posed) noexcept {
  units_.clear();
  if (posed == Posed::rows) {
    program_.resize(n, curvature_rows, 0);
    return;
  }
  int kept = static_cast<int>(posed_sums_.size());  // a variable and an equation each
  for (int k = 0; k < n; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    if (is_limit_above(i, level)) ++kept;
  }
  const bool with_motors = posed == Posed::motors;
  program_.resize(n + (with_motors ? motors_ : 0) + kept, curvature_rows,
                  (with_motors ? dimension_ : 0) + kept);
}

/// The variable nu |V_i| of a motion row: its bounds, and where it stands.
inline void BoundedProblem::pose_multiplier(int k, int level) noexcept {
  const int i = posed_[static_cast<std::size_t>(k)];
  const Entry& e = entry(i);
  bound(i);
  const Range bounds = bounds_at(i, level);
  units_.push_back(e.inverse_reach);
  program_.lo(k) = bounds.low * e.reach;
  program_.hi(k) = bounds.high * e.reach;
  program_.z(k) = e.is_limit ? e.nu * e.reach : 0.0;
}

/// The equations of the `n` row variables: torques make the motion.
void BoundedProblem::pose_motors(int n) noexcept {
  for (int k = 0; k < n; ++k) {
    add_multiple(dimension_, -units_[static_cast<std::size_t>(k)], V(posed_[static_cast<std::size_t>(k)]),
                 program_.E(k));
  }
  for (int j = 0; j < motors_; ++j) {
    const double length = nonzero(motor_length(j));
    add_multiple(dimension_, 1.0 / length, T(j), program_.E(n + j));
    program_.lo(n + j) = tau_lo_(j) * length;
    program_.hi(n + j) = tau_hi_(j) * length;
    program_.z(n + j) = tau_(j) * length;
  }
}

/// The limits above stay kept, B_i.p + room = b, and so do the listed sums. Without them a level whose torque
/// runs out would trade a limit above for itself.
void BoundedProblem::pose_kept(int n, int level, int variable, int equation) noexcept {
  for (int k = 0; k < n; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    if (!is_limit_above(i, level)) continue;
    const double sign = entry(i).kind == RowKind::upper ? 1.0 : -1.0;
    const double length = entry(i).reach;
    for (int other = 0; other < n; ++other) {
      const double share = dot(dimension_, V(i), V(posed_[static_cast<std::size_t>(other)]));
      program_.E(other)[equation] = sign * share * units_[static_cast<std::size_t>(other)] / length;
    }
    program_.E(variable)[equation++] = 1.0;
    program_.lo(variable) = 0.0;
    program_.hi(variable) = infinity;
    program_.z(variable++) = std::max(0.0, room_of(i, p_) / length);
  }
  pose_sums(n, variable, equation);
}

void BoundedProblem::take_motors(int first) noexcept {
  for (int j = 0; j < motors_; ++j) {
    tau_(j) = std::clamp(program_.z(first + j) / nonzero(motor_length(j)), tau_lo_(j), tau_hi_(j));
  }
}

/// The level's own motion rows, and the limits of the levels above.
void BoundedProblem::pose_rows() noexcept {
  folded_.clear();
  posed_ = motions_;
  pose_limits_above();
}

/// The motion in work_ with the posed rows, and with the drivers that push in vain, motors aside.
bool BoundedProblem::find_motion(int level, int max_iterations) noexcept {
  const int n = static_cast<int>(posed_.size());
  take_out_limits(p_);
  for (const int i : folded_) {
    if (!is_one_sided(i)) push(i, entry(i).nu, fixed_);
  }
  pose_motion(n, level, Posed::rows);
  const bool exact = program_.solve(max_iterations, iterations_);
  take_p(n);
  return exact;
}

/// Most of the time no motor is at its limit: the problem is solved without the motors first, and stands when
/// they can.
bool BoundedProblem::solve_motion(int level, int max_iterations) noexcept {
  pose_rows();
  if (posed_.empty() || limits_rest(level) || one_limit_settles(level)) return true;
  bool exact = true;
  bool possible = false;
  if (motors_reach_all_) {
    fold_limits(level);
    exact = find_motion(level, max_iterations);
    std::size_t unsure =
        folded_.size();  // those that are folded for their room have it where none is recalled
    if (recall_limits()) {
      exact = find_motion(level, max_iterations);
      unsure = folded_.size();
    }
    if (!folded_limits_rest(unsure)) {
      release_drivers();
      unfold_limits();
      exact = find_motion(level, max_iterations);
    }
    possible = sums_hold(level, work_) && torques_for(work_);
  }
  if (possible) {
    tau_.head(motors_) = candidate_.head(motors_);
    torques_are_least_ = true;
  } else {
    exact = move_within_sums(level, max_iterations);
  }
  take_multipliers(level);
  copy(work_, p_);
  if (!possible) note_limits(level);
  exact = least_multipliers(level, max_iterations) && exact;
  unfold_limits();
  take_offsets(level);
  return exact;
}

/// The motion in work_ where a sum or a motor stands in the way. Mostly it is a sum or two, and no motor.
/// Sums and limits join that the motion would break, and the motors only if they do not make it.
bool BoundedProblem::move_within_sums(int level, int max_iterations) noexcept {
  wake_idle_limits(level);
  pose_rows();
  let_limits_wait();
  take_out_limits(p_);
  posed_sums_.clear();
  copy(work_, felt_);
  bool exact = motors_reach_all_;
  while (exact && pose_broken(level)) {
    const int n = static_cast<int>(posed_.size());
    pose_motion(n, level, Posed::sums);
    exact = program_.solve(max_iterations, iterations_);
    take_p(n);
    take_felt(n, level);
  }
  torques_are_least_ = exact && !posed_sums_.empty() && torques_for(work_);
  if (torques_are_least_) {
    folded_.swap(waiting_);
    tau_.head(motors_) = candidate_.head(motors_);
    return true;
  }
  pose_rows();
  list_sums(level);
  const int n = static_cast<int>(posed_.size());
  pose_motion(n, level, Posed::motors);
  exact = program_.solve(max_iterations, iterations_);
  take_p(n);
  take_motors(n);
  return exact;
}

void BoundedProblem::pose_motion(int n, int level, Posed posed) noexcept {
  resize_program(n, level, dimension_, posed);
  for (int k = 0; k < n; ++k) {
    const int i = posed_[static_cast<std::size_t>(k)];
    const Entry& e = entry(i);
    const double unit = e.inverse_reach;
    program_.set_V(k, e.reach_extent, unit, e.V);
    program_.g(k) = (d_(i) + e.offset - along(i, fixed_)) * unit;
    program_.R(k) = softness_at(i, level) * unit * unit;
    pose_multiplier(k, level);
  }
  if (posed == Posed::rows) return;
  const bool with_motors = posed == Posed::motors;
  if (with_motors) pose_motors(n);
  pose_kept(n, level, n + (with_motors ? motors_ : 0), with_motors ? dimension_ : 0);
}

/// p of the stage's solution, in work_.
void BoundedProblem::take_p(int n) noexcept {
  copy(fixed_, work_);
  for (int k = 0; k < n; ++k) {
    const double z = program_.z(k) * units_[static_cast<std::size_t>(k)];
    if (z != 0.0) push(posed_[static_cast<std::size_t>(k)], z, work_);
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
    e.nu = program_.z(variable) * e.inverse_reach;
    if (e.level == level) e.nu = std::clamp(e.nu, e.lo, e.hi);
    if (program_.R(variable) > 0.0) continue;
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
    const double length = entry(i).reach;
    add_multiple(dimension_, 1.0 / length, V(i), program_.E(k));
    program_.R(k) = 1.0 / (length * length);
    program_.lo(k) = bounds_at(i, level).low * length;
    program_.hi(k) = bounds_at(i, level).high * length;
    program_.z(k) = entry(i).nu * length;
  }
  const bool exact = program_.solve(max_iterations, iterations_);
  for (int k = 0; k < n; ++k) {
    const int i = tied_[static_cast<std::size_t>(k)];
    entry(i).nu = program_.z(k) * entry(i).inverse_reach;
  }
  return exact;
}

/// The last stage: of all torques that make p, the smallest; p is what they make then.
bool BoundedProblem::least_torques(int max_iterations) noexcept {
  if (torques_are_least_) return true;
  if (torques_for(p_)) {
    tau_.head(motors_) = candidate_.head(motors_);
    return true;
  }
  program_.resize(motors_, 0, dimension_);
  pose_motors(0);
  for (int j = 0; j < motors_; ++j) {
    const double length = nonzero(motor_length(j));
    program_.R(j) = 1.0 / (length * length);
  }
  const bool exact = program_.solve(max_iterations, iterations_);
  take_motors(0);
  set_zero(dimension_, p_.data());
  for (int j = 0; j < motors_; ++j)
    add_multiple(motor_extents_[static_cast<std::size_t>(j)], tau_(j), T(j), p_.data());
  return exact;
}

}  // namespace zwang::solver
