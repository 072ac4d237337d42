#include "estimate/disturbance.hpp"

#include <algorithm>
#include <cmath>

#include "estimate/ticks.hpp"
#include "zwang/solver/wheels.hpp"

namespace zwang::runtime {

DisturbanceObserver::DisturbanceObserver(const lang::Robot& robot, double period)
    : motions_(robot.model),
      T_factor_(robot.model.joint_count() + 6),
      C_factor_(robot.model.joint_count() + 6),
      window_(ticks_of(mean_over, period)),
      longest_step_(std::max(longest_step, 1.5 * period)) {
  const solver::Model& model = robot.model;
  const int joints = model.joint_count();
  for (int j = 0; j < joints; ++j) {
    if (turns_wheel(model, j + 1) || model.joint(j).actuated) watched_.push_back(j);
    if (model.joint(j).actuated && !carries_wheel(model, j + 1)) arm_.push_back(j);
  }
  qd_ = expected_ = sent_ = torque_ = Eigen::VectorXd::Zero(joints);
  excess_ = watched_rates_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(watched_.size()));
  excesses_ = Eigen::MatrixXd::Zero(excess_.size(), window_);
  torques_ = Eigen::MatrixXd::Zero(joints, window_);
  const int most = joints + 6;
  p_ = right_ = w_ = yd_ = Eigen::VectorXd::Zero(most);
  T_ = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(watched_.size()), most);
  C_turned_ = Eigen::MatrixXd::Zero(most, 3 + static_cast<Eigen::Index>(arm_.size()));
}

void DisturbanceObserver::expect(const solver::Solver& solver, const solver::Solution& solution,
                                 const solver::State& state, const Eigen::VectorXd& friction,
                                 const Eigen::VectorXd& sent, double time) noexcept {
  take_motions(solver);
  const int m = motions_.count;
  sent_ = sent;
  // p that the solver's torques lack of those that act
  right_.head(m).setZero();
  for (Eigen::Index j = 0; j < sent.size(); ++j) {
    const double more = sent(j) - solution.tau(j) - friction(j);
    if (more != 0.0) right_.head(m) += more * motions_.joint.row(j).head(m).transpose();
  }
  for (const int j : watched_)
    expected_(j) = solution.qdd(j) + motions_.joint.row(j).head(m).dot(right_.head(m));
  qd_ = state.qd;
  time_ = time;
  expects_ = true;
}

void DisturbanceObserver::take_motions(const solver::Solver& solver) noexcept {
  if (!solver.free_motions(motions_)) return;
  for (int a = 0; a < motions_.count; ++a) {
    for (std::size_t i = 0; i < watched_.size(); ++i)
      T_(static_cast<Eigen::Index>(i), a) = motions_.joint(watched_[i], a);
    for (int row = 0; row < 3; ++row) C_turned_(a, row) = motions_.base(row, a);
    for (std::size_t i = 0; i < arm_.size(); ++i)
      C_turned_(a, 3 + static_cast<Eigen::Index>(i)) = motions_.joint(arm_[i], a);
  }
  T_factor_.factorise(T_, T_.rows(), motions_.count);
  C_factor_.factorise(C_turned_, motions_.count, C_turned_.cols());
}

bool DisturbanceObserver::compare(const solver::State& state, double time) noexcept {
  const double dt = time - time_;
  if (!expects_ || !(dt > 0.0) || dt > longest_step_) {
    known_ = 0;
    return expects_ = false;
  }
  expects_ = false;
  remember(state, dt);
  least_squares(excess_, p_);
  const solver::Vector3 w = on_base();
  if (!w.allFinite()) {
    known_ = 0;
    return false;
  }
  const double mean_age = std::min(0.5 * window_ * dt, 0.5 * time_constant);
  filtered_ += (1.0 - std::exp(-dt / (time_constant - mean_age))) * (w - filtered_);
  return true;
}

/// e and tau of the last comparisons, and their means.
void DisturbanceObserver::remember(const solver::State& state, double dt) noexcept {
  column_ = known_ == 0 ? 0 : (column_ + 1) % window_;
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const int j = watched_[i];
    excesses_(static_cast<Eigen::Index>(i), column_) = (state.qd(j) - qd_(j)) / dt - expected_(j);
  }
  torques_.col(column_) = sent_;
  known_ = std::min(known_ + 1, window_);
  excess_ = excesses_.leftCols(known_).rowwise().sum() / known_;
  torque_ = torques_.leftCols(known_).rowwise().sum() / known_;
}

Eigen::Ref<const Eigen::VectorXd> DisturbanceObserver::free_rates(const Eigen::VectorXd& qd) noexcept {
  for (std::size_t i = 0; i < watched_.size(); ++i)
    watched_rates_(static_cast<Eigen::Index>(i)) = qd(watched_[i]);
  least_squares(watched_rates_, yd_);
  return yd_.head(motions_.count);
}

double DisturbanceObserver::kinetic_energy(const Eigen::VectorXd& qd) noexcept {
  return 0.5 * free_rates(qd).squaredNorm();
}

double DisturbanceObserver::power(const Eigen::VectorXd& qd) noexcept {
  return p_.head(motions_.count).dot(free_rates(qd));
}

/// (T'T) y = T'e.
void DisturbanceObserver::least_squares(const Eigen::VectorXd& watched, Eigen::VectorXd& y) noexcept {
  const int m = motions_.count;
  for (int a = 0; a < m; ++a) right_(a) = dot(T_.col(a).data(), watched.data(), T_.rows());
  T_factor_.solve(right_, y);
}

/// w = (C C')^-1 C p.
solver::Vector3 DisturbanceObserver::on_base() noexcept {
  const int m = motions_.count;
  const auto n = static_cast<int>(C_turned_.cols());
  for (int a = 0; a < n; ++a) right_(a) = dot(C_turned_.col(a).data(), p_.data(), m);
  C_factor_.solve(right_, w_);
  return w_.head<3>();
}

}  // namespace zwang::runtime
