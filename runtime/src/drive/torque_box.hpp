/// The torques that a drive may choose from, so that no choice leaves a row's bound of force or acceleration.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "zwang/runtime/scheduler.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::runtime {

/// Bounds of what is linear in the joints' torques, as forces and accelerations are:
/// low_k <= g_k . tau <= high_k, k < count.
struct TorqueBounds {
  TorqueBounds(Eigen::Index joints, int most)
      : per_torque(Eigen::MatrixXd::Zero(joints, most)),
        low(Eigen::VectorXd::Zero(most)),
        high(Eigen::VectorXd::Zero(most)) {}
  Eigen::MatrixXd per_torque;  ///< column k: g_k, for 1 N m or 1 N of each joint
  Eigen::VectorXd low, high;   ///< [N], [N m], [m/s^2] or [rad/s^2]; infinite: none
  int count = 0;
};

/// The box [tau - d-, tau + d+] around `torque`, inside the motors' `limit`.
///
/// A bound has the slack s+ = high - g . tau and s- = g . tau - low. G is the sum of |g_i| over joints with
/// motors. A change delta of the torques moves g . tau by
///     g . delta = sum_(g_i > 0) g_i delta_i + sum_(g_i < 0) g_i delta_i
///              <= sum_(g_i > 0) |g_i| d_i+ + sum_(g_i < 0) |g_i| d_i-.
/// So d_i+ = s+/G where g_i > 0 and d_i- = s+/G where g_i < 0 make it s+ at most, and likewise s- for the
/// other direction. If there are several bounds, the smallest slack counts. A bound that `torque` breaks
/// already has no slack. Does not allocate.
void put_box(const TorqueBounds& bounds, const Eigen::VectorXd& torque, const Eigen::VectorXd& limit,
             Eigen::VectorXd& lower, Eigen::VectorXd& upper) noexcept;

/// The bounds of the rows of a solved problem, for each of its sets alone. While solutions blend, the blended
/// torques keep each bound that all sets have.
///
/// In the coordinates of solver::FreeMotions torques are the force p = T' tau, and row k with the force nu_k
/// is p_k nu_k. Rows that drive share p: p = sum p_k nu_k. With D the dual of the independent ones among
/// them, D = P (P'P)^-1, nu = D'p, so g_k = T D_k. A row that depends on others, and a sum, have the force
/// that they would have alone: D_k = p_k / |p_k|^2.
///
/// A force driver f bounds its own side: g . tau <= f where it pushes ahead, >= f where it pulls.
///
/// The acceleration along row k is p_k . ydd, and ydd changes with p: so with g_k = T p_k a limit bounds
/// g_k . tau, too. No torque inside the bounds breaks a limit until the next command.
class RowBounds {
 public:
  RowBounds(const solver::Model& model, int row_capacity);

  /// After `solver` has solved the sets of `scheduler`. Does not allocate, lock, throw or print.
  const TorqueBounds& look(const solver::Solver& solver, const Scheduler& scheduler,
                           const solver::Solution& solution) noexcept;
  const solver::FreeMotions& motions() const noexcept { return motions_; }

 private:
  static constexpr int most_independent = 6;
  /// `first`: of its rows, among those of all sets.
  void look_at_set(const solver::Solver& solver, const std::vector<solver::Row>& rows, int first,
                   const solver::Solution& solution) noexcept;
  void choose_independent(const solver::Solver& solver, const std::vector<solver::Row>& rows,
                          int first) noexcept;
  void add(const solver::Range& range, const Eigen::Ref<const Eigen::VectorXd>& per_force) noexcept;
  void add_limit(const solver::Row& row, const solver::Solution& solution) noexcept;

  solver::FreeMotions motions_;
  TorqueBounds bounds_;
  Eigen::VectorXd p_;
  Eigen::MatrixXd P_;             ///< p_k of the independent rows, each of length 1
  Eigen::MatrixXd orthonormal_;   ///< the same, made orthogonal
  Eigen::MatrixXd dual_;          ///< D
  std::vector<int> independent_;  ///< their numbers among the rows
  std::vector<double> length_;    ///< |p_k| of each
};

}  // namespace zwang::runtime
