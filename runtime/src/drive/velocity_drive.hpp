/// A drive that takes velocities and torque limits, as the runner sees it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "drive/effort_watch.hpp"
#include "drive/set_point.hpp"
#include "drive/torque_box.hpp"
#include "drive/virtual_robot.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/command.hpp"
#include "zwang/runtime/event.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// Samples come at the drive's rate, and late: between them the newest one is extrapolated. The drive is sent
/// the wheels' velocities and the box of torques around the solver's result. Where the drive has torque
/// limits of its own, the rows see a virtual robot, and its velocities are sent. Does not allocate, lock,
/// throw or print after construction.
class VelocityDrive {
 public:
  VelocityDrive(const lang::Robot& robot, double period, int row_capacity);

  /// Whether a sample that was measured at `stamp` [s] is newer than the last one.
  bool is_new(double stamp) const noexcept { return !(stamp <= measured_at_); }
  /// Whether the sample has the measurement by which a robot feels contacts.
  bool can_feel(const Sensed& sensed) const noexcept { return !virtual_ || virtual_->can_feel(sensed); }
  void feel(const Sensed& sensed, double stamp) noexcept {
    if (virtual_) virtual_->feel(sensed, stamp);
  }
  /// Of a robot that feels: what presses on the base at its origin, in its axes; else nothing.
  const solver::Vector3* felt_force() const noexcept { return virtual_ ? virtual_->felt_force() : nullptr; }
  /// The newest sample; and carried on to `time` [s]: its pose and positions by its velocities.
  void take(const solver::State& state, double stamp) noexcept;
  void carry_on(double time, solver::State& state) const noexcept;
  double measured_at() const noexcept { return measured_at_; }
  const solver::State& measured() const noexcept { return measured_; }

  bool has_virtual_robot() const noexcept { return virtual_.has_value(); }
  /// Joints and base of `state`, which is measured and carried on, become those of the virtual robot; from
  /// now on or, in a stop, not any more.
  void put_virtual(double time, bool is_stopped, solver::State& state) noexcept;
  /// None came for too long: by the age of the newest one [s].
  std::optional<Event> look_for_samples(double time) const noexcept;
  /// With a new sample: whether a wheel turns the way that it was told. A wheel on its torque limit may be
  /// carried along by other motors and a contact. Its own motor is at fault if it gains speed against its
  /// command. A drive with torque limits of its own is checked further: whether the wheel is as fast, and
  /// whether the base moves with its wheels. At a wall the wheels may spin, or the base slides along it. The
  /// event has the wheel's rate, or the base's speed.
  std::optional<Event> look(const solver::State& measured, double time) noexcept;

  /// Of a robot that measures its motors' torques; else nothing. With a new sample.
  EffortWatch* effort_watch() noexcept { return effort_watch_ ? &*effort_watch_ : nullptr; }

  /// The command while the task runs. `solver` has solved the rows of `scheduler` for `state`, at `time` [s].
  /// `compensation` is added to the torques against friction.
  void drive(const solver::Solver& solver, const Scheduler& scheduler, const solver::Solution& solution,
             const solver::State& state, double time, const Eigen::VectorXd& compensation,
             Command& command) noexcept;
  /// The command in the protective stop: velocities go to 0 with `stop.deceleration`. With `qd`, of a good
  /// sample, torques may only take energy. Without it the drive brakes by its own encoders for as long as it
  /// needs. The wheel at joint `suspect` (-1: none) is released, and so is each wheel that gets faster while
  /// it is braked. Its motor does the contrary of its command, and the others take the energy.
  /// With `is_felt` the force that a robot feels is trusted. Then it lets go of what it presses on, see
  /// ContactRelease.
  void brake(const Eigen::VectorXd* qd, int suspect, Command& command, bool is_felt = false) noexcept;
  /// The run is over, and perhaps nothing more is sent: a drive that pushes as hard as it can is told 0.
  void rest(Command& command) noexcept;
  /// Whether such a drive is told to move, or may be.
  bool moves(const Command& command) const noexcept;
  void go_on_from(VelocityDrive& before) noexcept;

  /// The tolerance of a wheel's speed, and its duration. Each pair is a way of 6 mm.
  struct Allowance {
    double slack;  ///< [m/s] at the rim, and `share` of the command
    double time;   ///< [s]
  };
  static constexpr Allowance fast{0.02, 0.3};
  /// Of a drive with torque limits of its own: a base that creeps against an obstacle is told too little to
  /// differ by more. A loop without an integral leaves tau R/k_p of dry friction: 2 mm/s of 0.1 N m a wheel.
  static constexpr Allowance slow{0.005, 1.2};
  static constexpr double share = 0.3;
  /// While a contact is felt, the virtual robot brakes, and the real base stands already. The time begins
  /// again if the largest difference d shrank to this part. The way is at most d 0.3 s / (1 - this).
  static constexpr double shrunk = 0.75;
  /// Beside, of a robot that feels and whose loops have no integral: so much of |w| T_c/m, which a loop that
  /// presses with w stays behind.
  static constexpr double bent = 1.5;
  /// Of what a command asked for: a motor that gave that much of the contrary does not follow. A reversed
  /// motor alone on its wheel gives all of it, one of four on a stiff base 2 s - 1 with its share s of the
  /// wheel's mobility. A wheel that is carried along at an even speed gives none.
  static constexpr double contrary = 0.1;
  static constexpr double lost_cycles = 3.0;  ///< without a sample, beside
  static constexpr double lost_time = 0.05;   ///< [s]
  static constexpr double full_brake = 0.5;   ///< [rad/s]: below it the brake's torque shrinks with the rate
  static constexpr double faster = 0.02;      ///< [m/s] what the rims of braked wheels may gain, rms
  static constexpr double gained = 0.05;      ///< [m/s] by a countered wheel's rim: its motor is not reversed
  static constexpr double brake_after = 0.5;  ///< [s] that a drive brakes blindly after its command is 0

 private:
  /// Of what differs from its command by more than an allowance.
  struct Lag {
    double since = solver::infinity;  ///< [s]
    double difference = 0.0;          ///< then, or the largest of a held wheel: [rad/s], [m/s]
  };
  struct Wheel {
    int joint = 0;
    double radius = 0.0;             ///< [m]
    double most_gain = 0.0;          ///< [rad/s^2] that its motor's limit gives its share of the base
    double brake = 0.0;              ///< [N m] its part of `stop.force`
    double most = 0.0, least = 0.0;  ///< [rad/s] of the latest commands
    Lag beyond, behind;              ///< of the fast allowance, and of the slow one
    double rate_then = 0.0;          ///< [rad/s] when all were slowest
    double told = 0.0;               ///< [rad/s] the latest command
    double rate_before = 0.0;        ///< [rad/s] when `beyond` began
    double asked = 0.0;              ///< [rad/s] what the commands asked for since then
    bool is_let_go = false;
    bool runs_away = false;  ///< it is faster than its commands, or turns against them
  };
  void remember(const Command& command) noexcept;
  void let_go_of_what_drives(const Eigen::VectorXd& qd, int suspect) noexcept;
  /// Of the base's velocity in the plane, in its axes, from its command [m/s]; 0 within the allowance.
  double difference(const solver::Vector3& velocity) const noexcept;
  /// Of a wheel's rate from its command. [rad/s]
  double difference(const Wheel& wheel, double rate, const Allowance& allowance) const noexcept;
  bool lasts(Lag& lag, double difference, const Allowance& allowance, double time) const noexcept;
  /// Whether a wheel of a drive with torque limits lags because its motor does the contrary of its command.
  bool is_contrary(Wheel& wheel, double rate, double time) const noexcept;
  void ramp_to_rest(Command& command) const noexcept;
  bool is_told_to_move(const Command& command) const noexcept;
  /// A velocity that holds the wheel at joint `suspect`, if it runs away and its motor is reversed.
  void counter(const Eigen::VectorXd& qd, int suspect, Command& command) noexcept;

  /// The wheel whose motor may be reversed, in the stop.
  struct Countered {
    int joint = -1;
    double since = 0.0;     ///< [s] it is told so
    double speed = 0.0;     ///< [rad/s] when the command began to act
    bool is_sound = false;  ///< it obeyed
  };

  lang::Drive drive_;
  double period_;
  double deceleration_;     ///< [m/s^2]
  double looked_at_ = 0.0;  ///< [s] at the last sample
  std::vector<Wheel> wheels_;
  Eigen::VectorXd limit_;  ///< [N m] of each joint
  /// The virtual robot is `mass_factor` as heavy, and its motors are as strong, to accelerate it. The motor
  /// of a wheel that does not follow accelerates nothing: it presses with its own limit.
  Eigen::VectorXd most_;  ///< [N m]
  RowBounds row_bounds_;
  SetPoint set_point_;
  std::optional<VirtualRobot> virtual_;
  std::optional<EffortWatch> effort_watch_;
  double bent_per_force_ = 0.0;  ///< [m/s N] `bent` T_c/m
  double bent_by_ = 0.0;         ///< [m/s] by what is felt now
  double radius_;                ///< [m] of the footprint about the base's origin
  Eigen::VectorXd pressing_;
  solver::State measured_;
  double slowest_ = solver::infinity;                 ///< [m/s] rms of the rims while they are braked
  Eigen::Vector2d told_ = Eigen::Vector2d::Zero();    ///< [m/s] the base's velocity, last
  Eigen::Vector2d before_ = Eigen::Vector2d::Zero();  ///< [m/s] the same, as far as it may be on its way
  Lag led_away_;                                      ///< of the base
  double measured_at_ = -solver::infinity;            ///< [s]
  Countered countered_;
  bool lets_go_ = false;    ///< of what it presses on, or will
  double blind_for_ = 0.0;  ///< [s] with the command at 0
};

}  // namespace zwang::runtime
