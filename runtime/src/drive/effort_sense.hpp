/// The force on the base, from the measured torques of the wheels' motors.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "estimate/normal_equations.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/plant.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::runtime {

/// The robot's own motion takes M v' + bias of the motors' torques, and its friction a part. The rest is
///     w = M v' + bias - J' (effort - friction),
/// from one sample to the next, with v through the same low pass as the effort. In the coordinates y of
/// solver::FreeMotions of a virtual robot alpha times as heavy this is
///     B' w = (yd' + bias)/alpha - T' (effort - friction).
/// w is the solution of least squares: a force that the ground bears stays 0. Does not allocate, lock, throw
/// or print after construction.
class EffortSense {
 public:
  /// `robot`: the virtual one.
  explicit EffortSense(const lang::Robot& robot);

  bool can_feel(const Sensed& sensed) const noexcept {
    return sensed.effort.size() == effort_.size() && sensed.effort.allFinite();
  }
  void begin() noexcept { is_known_ = false; }
  /// Nothing turns fast any more.
  void rest() noexcept { bias_.setZero(); }
  /// The virtual robot's motions and its solution, in this tick.
  void follow(const solver::FreeMotions& motions, const solver::Solution& solution) noexcept;
  /// w of the base at its origin, in its axes, from the last sample to this one: x, y [N] and rz [N m].
  solver::Vector3 feel(const Sensed& sensed, double stamp) noexcept;

  /// Standard deviation of w's force, one sample. [N]
  double noise() const noexcept;
  /// The part of the wheels' dry friction that is not compensated: it looks like a contact force. [N]
  double unknown_friction() const noexcept { return unknown_friction_; }

  static constexpr double sliding = 0.1;  ///< [rad/s] from which on dry friction is all there

 private:
  void take(const Sensed& sensed) noexcept;
  /// To `rates_`: the wheels' accelerations behind the sensor's low pass, `since` the last sample [s].
  void accelerate(const Eigen::VectorXd& qd, double since) noexcept;
  /// The y of `rates_`, into `y_`.
  void least_squares() noexcept;

  lang::Drive drive_;
  std::vector<lang::JointFriction> friction_;
  std::vector<int> wheels_;        ///< joints that turn a wheel with a motor
  double force_per_torque_ = 0.0;  ///< [1/m] of independent noises
  double unknown_friction_ = 0.0;  ///< [N]
  NormalEquations T_factor_, B_factor_;
  Eigen::MatrixXd T_;              ///< of the wheels
  Eigen::MatrixXd B_turned_;       ///< B'
  Eigen::VectorXd bias_;           ///< in y
  Eigen::VectorXd now_;            ///< [N m] effort without friction, of the sample that has come
  Eigen::VectorXd effort_;         ///< [N m] of the one before
  Eigen::VectorXd qd_, filtered_;  ///< [rad/s] of the same, and behind the low pass
  Eigen::VectorXd rates_, y_, p_;
  double felt_at_ = 0.0;  ///< [s]
  int count_ = 0;
  bool is_known_ = false;
};

}  // namespace zwang::runtime
