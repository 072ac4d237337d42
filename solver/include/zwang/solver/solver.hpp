/// The one problem: rows, torque limits and the ground in, torques and accelerations out.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/solver/constraint.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::solver {

/// The result of a call.
enum class Status {
  ok,
  invalid_input,      ///< a non-finite number in the state or a row; outputs untouched
  wrong_size,         ///< a vector or a row that does not fit the model; outputs untouched
  capacity_exceeded,  ///< more rows than the workspace holds; outputs untouched
  iteration_limit,    ///< the active set met its cap; outputs finite and inside every bound
  degenerate_model,   ///< an inertia that the sweeps cannot invert; outputs untouched
};
ZWANG_EXPORT const char* to_string(Status status) noexcept;

/// The result of a row in one word.
enum class RowStatus {
  held,            ///< the acceleration meets b (or a one-sided row is met)
  force_limited,   ///< nu at its bound, or a sum that it adds to, as intended
  torque_limited,  ///< a motor at its limit is what keeps the row from b, or phi from 1
  unreachable,     ///< nothing the robot can do moves this axis
  blocked,         ///< higher rows leave this axis no freedom
  conflict,        ///< rows of the same level, or limits of one above, contradict it
};
ZWANG_EXPORT const char* to_string(RowStatus status) noexcept;

/// The answer to one row.
struct RowSolution {
  double nu = 0.0;   ///< the row's constraint force on the robot [N] or [N m]; phi f of a force row; of a sum
                     ///< its value
  double phi = 0.0;  ///< of a force row, in [0, 1]
  double residual =
      0.0;  ///< s = a . Xdd - b [m/s^2] or [rad/s^2]; of a one-sided row only where b is violated
  bool saturated = false;  ///< nu at its bound, or held back by a sum at its bound; a force row: phi < 1
  RowStatus status = RowStatus::held;
};

/// One set of rows, and the share that its solution has in the torques. The shares of all sets add up to 1.
struct RowSet {
  const std::vector<Row>* rows = nullptr;
  double share = 1.0;
};

/// Sized for a model by its constructor, which throws std::invalid_argument on a capacity below 1.
struct ZWANG_EXPORT Solution {
  explicit Solution(const Model& model, int row_capacity = 64);

  /// Torque to command [N m] or [N], one entry a joint, feed-forward included; 0 where there is no motor.
  Eigen::VectorXd tau;
  Eigen::VectorXd qdd;                     ///< [rad/s^2] or [m/s^2], one entry a joint
  std::vector<MotionVector> acceleration;  ///< spatial acceleration of each body, in body coordinates
  std::vector<RowSolution> rows;  ///< parallel to the rows of the first set, then to those of the next ones
  int mobility = 0;               ///< freedoms that the ground leaves
  int iterations = 0;             ///< of the active set, all stages
};

/// The motions that the ground leaves, in coordinates y in which the robot is a unit mass. A generalised
/// force p accelerates it with ydd = p. A motor's torque tau is the force p = T' tau.
struct ZWANG_EXPORT FreeMotions {
  explicit FreeMotions(const Model& model);

  int count = 0;          ///< the mobility; of each matrix the first columns
  Eigen::MatrixXd joint;  ///< T, a line a joint: acceleration of the joints = T ydd
  Eigen::MatrixXd base;   ///< B, three lines: of the base along its own x, y and about its own z = B ydd

  /// Of the solver that wrote them: they stay while no mass of the robot moves in the base's axes.
  std::uint64_t factorisation = 0;
};

/// Sizes and options, fixed at construction.
struct Settings {
  int row_capacity = 64;     ///< of all sets together
  int set_capacity = 0;      ///< of the rows of one set; 0: the same
  int max_iterations = 400;  ///< hard cap of the active set, of each stage
  bool base_motion = false;  ///< FreeMotions::base is wanted
  /// Solution::acceleration is wanted of all bodies. Otherwise it is computed for the base, for the bodies
  /// that rows act on and for the bodies that carry them. The entries of the other bodies keep their old
  /// values.
  bool every_acceleration = true;
};

/// Solves the bounded problem for one model. Throws std::invalid_argument from its constructor only.
class ZWANG_EXPORT Solver {
 public:
  explicit Solver(const Model& model, const Settings& settings = {});
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  /// Does not allocate, lock, throw or print. On any status but `ok` and `iteration_limit` the solution is
  /// untouched.
  [[nodiscard]] Status solve(const State& state, const std::vector<Row>& rows, Solution& solution) noexcept;

  /// Blends solutions: each set of rows is solved whole, at full strength, and
  ///
  ///   tau = sum share_k tau_k
  /// Accelerations are affine in tau, and the bounded quantities form convex sets. So an equality that all
  /// sets meet is met exactly. A range, a sum or a motor's limit that all sets keep is kept. The nu, phi,
  /// `saturated` and `status` of a row are those of its own set. Its residual is that of the blended motion.
  [[nodiscard]] Status solve(const State& state, std::span<const RowSet> sets, Solution& solution) noexcept;

  /// Writes into `out` the rows of the first set that keep its row `row` from its wanted acceleration, the
  /// strongest first. Such a row has the level of `row` or one above. Its force pushes `row` the other way or
  /// holds its axis, or it is a sum at its bound. Each has at least 1 % of the strongest one's share. Returns
  /// their number: 0 for a row that is met. Does not allocate, lock, throw or print.
  int opposing(int row, std::span<int> out) const noexcept;

  /// At the last solved problem; before the next `project_velocity`. `base` is 0 unless the settings ask for
  /// it. False when `out` holds them already: it is always to be given to the same solver. Does not allocate,
  /// lock, throw or print.
  bool free_motions(FreeMotions& out) const noexcept;

  /// Writes a unit force along row `row` of Solution::rows, as the p of FreeMotions, into the first numbers
  /// of `p`, as many as the mobility. They are 0 where nothing moves the robot along the row. `p` has room
  /// for 6 + joints. Call it before the next `project_velocity`. Does not allocate, lock, throw or print.
  void force_on_motions(int row, Eigen::VectorXd& p) const noexcept;

  /// Takes out of the measured velocities what the ground does not allow (in the metric of kinetic energy).
  /// Do this first in every period: what is left is the robot's odometry, and slip noise never reaches the
  /// rows. On any status but `ok` the state is untouched. Does not allocate, lock, throw or print.
  [[nodiscard]] Status project_velocity(State& state) noexcept;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace zwang::solver
