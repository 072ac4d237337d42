/// The torques that a drive may choose from, so that no choice leaves a row's force bound.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "zwang/solver/solver.hpp"

namespace zwang::runtime {

/// Bounds of forces that are linear in the joints' torques: low_k <= g_k . tau <= high_k, k < count.
struct ForceBounds {
  ForceBounds(Eigen::Index joints, int most)
      : per_torque(Eigen::MatrixXd::Zero(joints, most)),
        low(Eigen::VectorXd::Zero(most)),
        high(Eigen::VectorXd::Zero(most)) {}
  Eigen::MatrixXd per_torque;  ///< column k: g_k [N or N m, for 1 N m or 1 N of each joint]
  Eigen::VectorXd low, high;   ///< [N] or [N m]; infinite: none
  int count = 0;
};

/// The box [tau - d-, tau + d+] around `torque`, inside the motors' `limit`.
///
/// With the slack s+ = high - g . tau and s- = g . tau - low of a bound, and G = sum |g_i|, a change delta
/// of the torques moves the force by
///     g . delta = sum_(g_i > 0) g_i delta_i + sum_(g_i < 0) g_i delta_i
///              <= sum_(g_i > 0) |g_i| d_i+ + sum_(g_i < 0) |g_i| d_i-.
/// So d_i+ = s+/G where g_i > 0 and d_i- = s+/G where g_i < 0 make it s+ at most, and likewise s- of the
/// other direction. Of several bounds the least counts. A bound that `torque` breaks already has no slack.
/// Does not allocate.
void put_box(const ForceBounds& bounds, const Eigen::VectorXd& torque, const Eigen::VectorXd& limit,
             Eigen::VectorXd& lower, Eigen::VectorXd& upper) noexcept;

/// The force bounds of the rows of a solved problem.
///
/// In the coordinates of solver::FreeMotions torques are the force p = T' tau, and row k with the force nu_k
/// is p_k nu_k. Rows that drive share p: p = sum p_k nu_k. With D the dual of the independent ones among
/// them, D = P (P'P)^-1, nu = D'p, so g_k = T D_k. A row that depends on others, and a sum, have the force
/// that they would have alone: D_k = p_k / |p_k|^2.
///
/// A force driver f bounds its own side: g . tau <= f where it pushes ahead, >= f where it pulls.
class RowForces {
 public:
  RowForces(const solver::Model& model, int row_capacity);

  /// After `solver` has solved `rows`. Does not allocate, lock, throw or print.
  const ForceBounds& look(const solver::Solver& solver, const std::vector<solver::Row>& rows) noexcept;
  const solver::FreeMotions& motions() const noexcept { return motions_; }

 private:
  static constexpr int most_independent = 6;
  void choose_independent(const solver::Solver& solver, const std::vector<solver::Row>& rows) noexcept;
  void add(const solver::Row& row, const Eigen::Ref<const Eigen::VectorXd>& dual) noexcept;

  solver::FreeMotions motions_;
  ForceBounds bounds_;
  Eigen::VectorXd p_;
  Eigen::MatrixXd P_;             ///< p_k of the independent rows, each of length 1
  Eigen::MatrixXd orthonormal_;   ///< the same, made orthogonal
  Eigen::MatrixXd dual_;          ///< D
  std::vector<int> independent_;  ///< their numbers among the rows
  std::vector<double> length_;    ///< |p_k| of each
};

}  // namespace zwang::runtime
