/// The ground taken out of the factor W that the sweeps leave, L = W W'.
///
/// Reflections (Householder 1958) turn the axes of W's lines, which changes no product of two of them. They
/// end when the rows of the ground, in the order of their pivots, are 0 behind a triangle. The ground holds
/// the dimensions of that triangle, after the base's own three. The other dimensions are the motions that the
/// ground leaves, and their number is the mobility. So for any two rows i, k beyond the ground
///
///   A_i Mc A_k' = B_i . B_k,   Mc = M^-1 - M^-1 Jp' (Jp M^-1 Jp')^+ Jp M^-1
///   B_i = the last numbers of row i of W,  W_i N,  N = the last columns of the reflections' product
///
/// and a generalised force f along them becomes p = sum B_i f_i. Forces and accelerations of the constrained
/// robot live in one small space with the identity as its inertia. Redundant ground rows (two wheels on one
/// axle) are passed over: a row counts as dependent when the ones before leave nothing of it. A row is taken
/// in its given order while they leave a tenth of it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "constraint/steered_wheels.hpp"
#include "sweep/columns.hpp"

namespace zwang::solver {

class WhitenedRows {
 public:
  WhitenedRows(const Columns& robot, const Columns& task, const LeastShares& least);

  /// Finds the reflections that make a triangle of the ground's lines, the first ones of the robot's rows,
  /// and turns all of these. That stays until the robot moves.
  void factorise(Columns& robot, int ground) noexcept;
  /// B of the task's rows, which all below is about where nothing else is said.
  void project_task() noexcept;

  int mobility() const noexcept { return dimensions_ - held_; }
  int ground_rank() const noexcept { return rank_; }  ///< of the ground's rows
  const double* B(int row) const noexcept { return first_B_ + row * B_stride_; }
  auto motion(int row) const noexcept { return Eigen::Map<const Eigen::RowVectorXd>(B(row), mobility()); }
  /// B_i of a row of the robot itself, beyond the ground's.
  const double* robot_B(int row) const noexcept { return &robot_->W(row, held_); }
  auto robot_motion(int row) const noexcept { return robot_->W.row(row).segment(held_, mobility()); }
  /// A_i M^-1 A_i', the robot without the ground.
  double free_square(int row) const noexcept { return dot(dimensions_, line(row), line(row)); }
  double robot_free_square(int row) const noexcept {
    return dot(dimensions_, &robot_->W(row, 0), &robot_->W(row, 0));
  }
  /// Of A_i Mc A_i', which is |B_i|^2: with less, nothing moves along the row.
  double least_square(int row) const noexcept { return least_.of_row * free_square(row); }
  double least_share() const noexcept { return least_.of_row; }
  /// A_i Mc A_i' over A_i M^-1 A_i': how much of a row the ground leaves.
  double free_share(int row) const noexcept;

  /// The motion h of the dimensions under the ground. The ground's rows accelerate at `bias` (wanted
  /// acceleration less drift, by row), and the held dimensions of the base at `base_motion`. At 0 the base
  /// keeps its height, roll and pitch.
  void hold_ground(const Eigen::VectorXd& free_motion, const Eigen::VectorXd& bias,
                   const Vector3& base_motion = Vector3::Zero()) noexcept;
  /// The held motion where h is 0.
  void hold_ground_at_rest(const Eigen::VectorXd& bias, const Vector3& base_motion) noexcept;
  /// The acceleration along a row then, without constraint forces.
  double acceleration(int row) const noexcept {
    return task_->drift(row) + dot(dimensions_, line(row), held_motion_.data());
  }
  /// sum B_i f_i of the forces f along the task's rows. (p has a number to spare.)
  void add_up(const double* f, double* p) const noexcept;
  /// The motion by dimension of the sweeps when the forces p act on the motions that are left; none
  /// without p. (`motion` has
  /// a number to spare.)
  void motion(const double* p, Eigen::VectorXd& motion) const noexcept;

 private:
  const double* line(int row) const noexcept { return &task_->W(row, 0); }
  int free_of_ground() const noexcept { return ground_end_ - held_; }
  int next_pivot(int ground) const noexcept;
  void reflect(int row, int first, int ground) noexcept;
  void turn_robot_from(int row) noexcept;
  void find_Q() noexcept;
  void turn(int reflection, double* y) const noexcept;
  void turn_two(int reflection, double* one, double* other) const noexcept;
  void hold(const Eigen::VectorXd& bias, const Vector3& base_motion) noexcept;

  Columns* robot_ = nullptr;
  const Columns* task_ = nullptr;
  LeastShares least_;
  RowMajorMatrix N_;                 ///< by dimension up to the ground's end; behind it N is 1
  RowMajorMatrix Q_held_;            ///< by turned axis that the ground holds
  RowMajorMatrix B_;                 ///< by row of the task; lines have a 0 to spare
  const double* first_B_ = nullptr;  ///< the task's own lines where the ground turns nothing
  Eigen::Index B_stride_ = 0;
  RowMajorMatrix reflections_;  ///< by pivot: v, of  1 - scale v v'
  Eigen::VectorXd scale_;
  Eigen::VectorXd left_, size_;  ///< by row of the ground: square of what is left of it, and of all of it
  Eigen::VectorXd held_motion_;  ///< by dimension: h with the ground's answer
  Eigen::VectorXd unit_;         ///< by dimension
  Eigen::VectorXd free_part_;    ///< by axis that the ground leaves
  Eigen::VectorXd solution_;     ///< by what is held: of the triangle
  Eigen::VectorXd inverse_pivots_;
  std::vector<int> pivots_;  ///< rows of the ground, the pivots first
  int dimensions_ = 0, ground_end_ = 0;
  int base_ = 0;  ///< dimensions of the base that the ground holds
  int rank_ = 0;
  int held_ = 0;  ///< by the ground: base_ + rank_
};

}  // namespace zwang::solver
