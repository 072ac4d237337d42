/// The robot that rows and conditions see where a drive takes velocities and is not sent a torque limit.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "drive/contact_release.hpp"
#include "drive/contact_response.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/command.hpp"
#include "zwang/runtime/odometry.hpp"
#include "zwang/solver/solver.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// The command to velocity loops that makes their wheels turn with V. The loop of VelocityLoop answers a
/// command c with
///     v = (s + 1/T_i) / (T_c s^2 + s + 1/T_i) c.
/// So the command is
///     c = V + T_c (V' - L),   T_i L' = V' - L.
/// It has the lead T_c V' of a first-order loop, until the integral has compensated the lag. Without an
/// integral L stays 0.
///
/// The drive takes c once a cycle and holds it. So V and V' are means over the last cycle. Otherwise, where
/// V' jumps between two takes, the wheel would catch up on the difference, and accelerate by up to 1.4 V'.
///
/// A robot that feels is told V itself, which is half a cycle younger than the mean: a delayed command makes
/// a contact oscillate. When the robot is pressed, its wheels stand, the integral has no lag to compensate,
/// and L fades.
class LoopInput {
 public:
  /// `period` [s] of the updates, `count` velocities.
  LoopInput(const lang::Drive& drive, double period, Eigen::Index count);
  void begin(const Eigen::Ref<const Eigen::VectorXd>& velocity) noexcept;
  void update(const Eigen::Ref<const Eigen::VectorXd>& velocity, bool is_pressed = false) noexcept;
  const Eigen::VectorXd& value() const noexcept { return value_; }  ///< c
  /// How old the mean of V is, with the newest V of age 0. [s]
  double age() const noexcept { return 0.5 * period_ * static_cast<double>(past_.cols() - 1); }

 private:
  double period_;
  double time_constant_;                 ///< [s]
  std::optional<double> integral_time_;  ///< [s]
  Eigen::MatrixXd past_;                 ///< V of the last cycle, a ring of columns
  Eigen::Index oldest_ = 0;
  Eigen::VectorXd acceleration_;  ///< V'
  Eigen::VectorXd made_up_;       ///< L
  Eigen::VectorXd value_;
};

/// It follows the solver's acceleration at once. The measured velocity lags behind by the drive's loop. Rows
/// that see it would ask for more, and the loop's integral would add to that. The real base follows the
/// virtual one by the lag
///     delay/2 + 1/(2 rate) + 1/(2 rate):
/// half of the delay is the command's way to the wheel. A command is a mean over a cycle, and is held for
/// one.
///
/// Its pose is dead reckoning by its own wheels. Each sample corrects it, within 1 s. The correction is the
/// difference between the measured pose and the virtual pose that the base followed then. Joint angles are
/// corrected likewise. The velocities are not corrected. The felt force accelerates the virtual robot beside
/// the solver, see ContactResponse. Does not allocate, lock, throw or print after construction.
class VirtualRobot {
 public:
  VirtualRobot(const lang::Robot& robot, double period);

  bool has_begun() const noexcept { return has_begun_; }
  /// As `state` is at `time` [s], which is known by then.
  void begin(const solver::State& state, double time) noexcept;
  void end() noexcept { has_begun_ = false; }
  /// Whether a sample has what this robot needs; and what presses on it, measured at `stamp` [s].
  bool can_feel(const Sensed& sensed) const noexcept { return !contact_ || contact_->can_feel(sensed); }
  void feel(const Sensed& sensed, double stamp) noexcept {
    if (contact_) contact_->feel(sensed, stamp);
  }
  /// Of a robot that feels.
  const solver::Vector3* felt_force() const noexcept { return contact_ ? &contact_->force() : nullptr; }
  /// It feels a contact now, and is damped.
  bool is_pressed() const noexcept { return contact_ && contact_->is_pressed(); }
  /// In the protective stop, see ContactRelease. It has not ended, of a robot that feels; it moves the base.
  bool may_let_go() const noexcept { return release_ && !release_->is_over(); }
  bool lets_go() const noexcept { return may_let_go() && release_->runs(); }
  void let_go(Command& command) noexcept;
  void hold_on() noexcept {
    if (release_) release_->pause();
  }
  /// By a sample that was measured at `stamp` [s].
  void correct(const solver::State& measured, double stamp) noexcept;
  /// Joints and base of `state` become those of the virtual robot.
  void put(solver::State& state) const noexcept;

  /// By the solution of `solver` at `state` to `time` [s], a tick later. While a contact is felt, no motor
  /// gives more than `most` [N m].
  void move(const solver::State& state, const solver::Solver& solver, const solver::Solution& solution,
            const Eigen::VectorXd& most, double time) noexcept;
  /// The command to the real wheels and base that makes them follow the virtual ones.
  void tell(Command& command) const noexcept;

  double lag() const noexcept { return lag_; }     ///< [s]
  static constexpr double corrected_within = 1.0;  ///< [s]
  static constexpr double memory = 0.5;            ///< [s]

 private:
  struct Past {
    double time = -1.0;  ///< [s]
    Eigen::VectorXd q;
  };
  void correct_joints(const Eigen::VectorXd& measured, double then, double part) noexcept;

  double period_;
  double lag_;
  std::vector<bool> turns_;  ///< each joint
  solver::State state_;
  Odometry pose_;
  LoopInput wheels_, base_;
  std::optional<ContactResponse> contact_;
  std::optional<ContactRelease> release_;
  Eigen::VectorXd qdd_;
  std::vector<Past> past_;  ///< a ring
  std::size_t updates_ = 0;
  double corrected_at_ = 0.0;  ///< [s]
  bool has_begun_ = false;
};

}  // namespace zwang::runtime
