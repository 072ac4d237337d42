/// The forces of the world on the robot beyond its commands: a generalised-momentum observer.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "estimate/normal_equations.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/solver/solver.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// In the coordinates y of solver::FreeMotions the robot is a unit mass, so its generalised momentum is yd.
/// A force from outside is the remainder
///   p = d(yd)/dt - ydd_model - T' (tau_sent - tau_model - friction).
/// The observer uses the joints alone. e = T p + noise is the difference between the joints' acceleration and
/// the model's, and p is the solution of least squares. On the base and on the joints of an arm the force w
/// satisfies
///   C' w = p,   C = [B; T_arm].
/// It is low-passed with the observer's time constant: r' = (w - r) / T_r. A force at the gripper counts on
/// the base, too. Where fewer motions are free than w has entries, a force that the ground bears stays 0.
/// Does not allocate, lock, throw or print after construction.
class DisturbanceObserver {
 public:
  /// `period` [s] from one comparison to the next.
  DisturbanceObserver(const lang::Robot& robot, double period);

  /// Forgets what was commanded: the next sample is compared with nothing.
  void pause() noexcept { expects_ = false; }
  /// The model's prediction for the torques that were sent in the state, and for the joints' friction against
  /// them.
  void expect(const solver::Solver& solver, const solver::Solution& solution, const solver::State& state,
              const Eigen::VectorXd& friction, const Eigen::VectorXd& sent, double time) noexcept;
  /// Compares the measured state with the prediction. False when there is no prediction.
  bool compare(const solver::State& state, double time) noexcept;

  /// T = 1/2 |yd|^2 of the joints' rates, qd = T yd, at the state of the last `expect`. [J]
  double kinetic_energy(const Eigen::VectorXd& qd) noexcept;
  /// P = p . yd, what `force()` gives at these rates. [W]
  double power(const Eigen::VectorXd& qd) noexcept;

  /// The model's prediction for the last torques: accelerations of the joints that turn a wheel or have a
  /// motor.
  const Eigen::VectorXd& expected() const noexcept { return expected_; }
  /// On the base at its origin, in its axes: x, y [N] and rz [N m]; low-passed.
  const solver::Vector3& base_force() const noexcept { return filtered_; }
  /// p of the last comparisons, their mean over `window()` of them; `motions().count` entries.
  const Eigen::VectorXd& force() const noexcept { return p_; }
  const solver::FreeMotions& motions() const noexcept { return motions_; }
  /// The mean of the motors' commands over the same window [N m] or [N].
  const Eigen::VectorXd& torque() const noexcept { return torque_; }
  int window() const noexcept { return window_; }

  static constexpr double time_constant = 0.02;  ///< [s] T_r
  static constexpr double mean_over = 0.01;      ///< [s] `window()`: what is over is soon forgotten for good
  static constexpr double longest_step = 0.005;  ///< [s] between samples that are compared, or a period

 private:
  /// yd of the joints' rates.
  Eigen::Ref<const Eigen::VectorXd> free_rates(const Eigen::VectorXd& qd) noexcept;
  /// The y of qd = T y over the joints that are watched.
  void least_squares(const Eigen::VectorXd& watched, Eigen::VectorXd& y) noexcept;
  void take_motions(const solver::Solver& solver) noexcept;
  solver::Vector3 on_base() noexcept;
  void remember(const solver::State& state, double dt) noexcept;

  std::vector<int> watched_;  ///< joints that turn a wheel or have a motor
  std::vector<int> arm_;      ///< joints with a motor that carry no wheel
  solver::FreeMotions motions_;
  Eigen::VectorXd qd_, expected_, sent_, torque_, excess_, watched_rates_, p_;
  Eigen::MatrixXd T_;                    ///< of the joints that are watched
  Eigen::MatrixXd C_turned_;             ///< C'
  NormalEquations T_factor_, C_factor_;  ///< of T'T and C C'
  Eigen::MatrixXd excesses_, torques_;   ///< rings: a column a comparison
  int window_;
  double longest_step_;
  int column_ = 0;  ///< of the last comparison
  int known_ = 0;   ///< comparisons since the last pause, `window()` at most
  Eigen::VectorXd right_, w_, yd_;
  solver::Vector3 filtered_ = solver::Vector3::Zero();
  double time_ = 0.0;
  bool expects_ = false;
};

}  // namespace zwang::runtime
