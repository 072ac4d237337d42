/// A drive that takes velocities and torque limits, as the runner sees it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "drive/set_point.hpp"
#include "drive/torque_box.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/command.hpp"
#include "zwang/runtime/event.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::runtime {

/// Samples come at the drive's rate, and late: between them the newest one is carried on. What is sent are
/// the wheels' velocities and the box of torques around what the solver asks for. Does not allocate, lock,
/// throw or print after construction.
class VelocityDrive {
 public:
  VelocityDrive(const lang::Robot& robot, double period, int row_capacity);

  /// Whether a sample that was measured at `stamp` [s] is newer than the last one.
  bool is_new(double stamp) const noexcept { return !(stamp <= measured_at_); }
  /// The newest sample; and carried on to `time` [s]: its pose and positions by its velocities.
  void take(const solver::State& state, double stamp) noexcept;
  void carry_on(double time, solver::State& state) const noexcept;
  double measured_at() const noexcept { return measured_at_; }
  /// None came for too long: by the age of the newest one [s].
  std::optional<Event> look_for_samples(double time) const noexcept;
  /// With a new sample: whether a wheel goes the way that it was told. The event has its rate.
  std::optional<Event> look(const solver::State& measured, double time) noexcept;

  /// What is sent while the task runs. `solver` has solved the rows of `scheduler`; `compensation` is
  /// what is added to the torques against friction.
  void drive(const solver::Solver& solver, const Scheduler& scheduler, const solver::Solution& solution,
             const Eigen::VectorXd& qd, const Eigen::VectorXd& compensation, Command& command) noexcept;
  /// What is sent in the protective stop: velocities go to 0 with `stop.deceleration`. `qd`: of a good
  /// sample, then torques may only take energy; none: the drive brakes by its own encoders for as long as it
  /// needs. The wheel at joint `suspect`, or none (-1), is let go of, and each that gets faster while it is
  /// braked: its motor does the contrary of what it is told, and the others take the energy.
  void brake(const Eigen::VectorXd* qd, int suspect, Command& command) noexcept;
  void go_on_from(const VelocityDrive& before) noexcept;

  static constexpr double slack = 0.02;       ///< [m/s] at the rim, and
  static constexpr double share = 0.3;        ///< of the command: what a wheel may be faster by,
  static constexpr double followed_in = 0.3;  ///< [s] for less than this
  static constexpr double lost_cycles = 3.0;  ///< without a sample, beside
  static constexpr double lost_time = 0.05;   ///< [s]
  static constexpr double full_brake = 0.5;   ///< [rad/s]: below it the brake's torque shrinks with the rate
  static constexpr double faster = 0.02;      ///< [m/s] what the rims of braked wheels may gain, rms
  static constexpr double brake_after = 0.5;  ///< [s] that a drive brakes blindly after its command is 0

 private:
  struct Wheel {
    int joint = 0;
    double radius = 0.0;                     ///< [m]
    double brake = 0.0;                      ///< [N m] its part of `stop.force`
    double most = 0.0, least = 0.0;          ///< [rad/s] of the latest commands
    double beyond_since = solver::infinity;  ///< [s]
    double rate_then = 0.0;                  ///< [rad/s] when all were slowest
    bool is_let_go = false;
  };
  void remember(const Command& command) noexcept;
  void let_go_of_what_drives(const Eigen::VectorXd& qd, int suspect) noexcept;

  lang::Drive drive_;
  double period_;
  double deceleration_;  ///< [m/s^2]
  std::vector<Wheel> wheels_;
  Eigen::VectorXd limit_;  ///< [N m] of each joint
  RowBounds row_bounds_;
  SetPoint set_point_;
  Eigen::VectorXd pressing_;
  solver::State measured_;
  double measured_at_ = -solver::infinity;  ///< [s]
  double slowest_ = solver::infinity;       ///< [m/s] rms of the rims while they are braked
  double blind_for_ = 0.0;                  ///< [s] with the command at 0
};

}  // namespace zwang::runtime
