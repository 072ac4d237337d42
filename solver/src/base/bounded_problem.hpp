/// Phase 3 of the sweeps, at the base: all multipliers, bounded and by level, and the torques that make them.
///
/// Everything happens in the whitened space of WhitenedRows, whose dimension is the mobility. Row i of the
/// task has the direction B_i there, motor j the direction T_j. With p the constraint forces' sum, the rows'
/// accelerations are g_i + B_i.p, and Gauss's principle with bounded multipliers reads
///
///   min 1/2 |p|^2 - d' nu + 1/2 nu' R nu,   p = sum B_i nu_i = sum T_j tau_j,   lo <= nu <= hi,  |tau| <=
///   limit
///
/// with d = b - g. Levels are lexicographic: before level k what the hard equality and force rows above
/// achieved is frozen (the lower rows act in the rest of the space), higher one-sided rows are posed again,
/// and higher soft rows resist with the same R. Within a level the force rows come first: phi is as near to 1
/// as the motors allow, then fixed.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "base/quadratic_program.hpp"
#include "zwang/solver/constraint.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::solver {

class BoundedProblem {
 public:
  BoundedProblem(int row_capacity, int motor_capacity, int dimension_capacity);

  void resize(int rows, int motors, int dimension) noexcept;
  auto B(int row) noexcept { return B_.row(row).head(dimension_); }
  auto T(int motor) noexcept { return T_.row(motor).head(dimension_); }
  double& d(int row) noexcept { return d_(row); }
  void set_row(int row, const Row& source, double free_share) noexcept;
  void set_motor(int motor, double lowest, double highest) noexcept;

  /// False when an active set met its iteration cap; all results stay inside their bounds.
  bool solve(int max_iterations) noexcept;

  const RowSolution& row(int i) const noexcept { return solutions_[static_cast<std::size_t>(i)]; }
  double tau(int motor) const noexcept { return tau_(motor); }
  int iterations() const noexcept { return iterations_; }

 private:
  struct Entry {
    RowKind kind = RowKind::driver;
    Quantity quantity = Quantity::velocity;
    int level = 1;
    double lo = 0.0, hi = 0.0;  ///< of nu, in its own unit, fading included; finite
    double force = 0.0;         ///< f, fading included
    double fade = 1.0;
    double length = 0.0;  ///< |B_i|
    double offset = 0.0;  ///< what a violated one-sided row achieved beyond b when it was last solved
    double achieved = 0.0;      ///< B_i.p before the present level
    bool out = false;     ///< unreachable or blocked: takes no part
    RowStatus status = RowStatus::held;
    double nu = 0.0, phi = 0.0;
  };
  Entry& entry(int i) noexcept { return entries_[static_cast<std::size_t>(i)]; }
  bool is_one_sided(int i) const noexcept;
  bool is_soft(int i) noexcept { return entry(i).fade < 1.0; }
  bool takes_part(int i) const noexcept;
  Range bounds_at(int i, int level) const noexcept;
  double softness(int i) const noexcept;
  double largest_force(int row) const noexcept;
  int next_level(int after) const noexcept;

  void factorise_motors() noexcept;
  void bound_rows() noexcept;
  void project_rows() noexcept;
  void note_achieved() noexcept;
  bool solve_forces(int level, int max_iterations) noexcept;
  bool solve_motion(int level, int max_iterations) noexcept;
  bool least_multipliers(int level, int max_iterations) noexcept;
  void freeze(int level) noexcept;
  bool least_torques(int max_iterations) noexcept;
  void report() noexcept;

  void pose_rows(int level) noexcept;
  void pose_motion(int level, bool with_motors) noexcept;
  void pose_motors(int first) noexcept;
  void take_p() noexcept;
  void take_multipliers(int level) noexcept;
  void take_motors(int first) noexcept;
  bool torques_for(const Eigen::VectorXd& p) noexcept;

  int rows_ = 0, motors_ = 0, dimension_ = 0, iterations_ = 0;
  Eigen::MatrixXd B_, T_;
  Eigen::MatrixXd BN_;  ///< B projected on what the levels above left free
  Eigen::VectorXd d_, tau_, tau_lo_, tau_hi_, candidate_;
  Eigen::VectorXd p_;      ///< sum of the constraint forces so far
  Eigen::VectorXd fixed_;  ///< its part that the present stage cannot change
  Eigen::VectorXd work_, solved_;
  Eigen::MatrixXd frozen_;  ///< orthonormal columns
  int frozen_count_ = 0;
  Eigen::MatrixXd gram_;  ///< Cholesky factor of T'T
  bool motors_reach_all_ = false;
  std::vector<Entry> entries_;
  std::vector<RowSolution> solutions_;
  std::vector<int> posed_;  ///< row of each variable of the present stage
  std::vector<int> tied_;   ///< rows of the present stage whose multipliers are not unique
  QuadraticProgram program_;
};

}  // namespace zwang::solver
