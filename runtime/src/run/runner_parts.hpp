/// The parts of a runner, and the phases of its step: they stand in the files runner_*.cpp.
#pragma once

#include <limits>

#include "drive/led_program.hpp"
#include "drive/velocity_drive.hpp"
#include "estimate/disturbance.hpp"
#include "estimate/friction.hpp"
#include "estimate/press.hpp"
#include "estimate/ticks.hpp"
#include "guard/blind_budget.hpp"
#include "guard/clock_rate.hpp"
#include "guard/frozen_wheel.hpp"
#include "guard/hook_latch.hpp"
#include "guard/joint_rates.hpp"
#include "guard/motor_watch.hpp"
#include "guard/slip_watch.hpp"
#include "guard/wheel_signs.hpp"
#include "guard/wrench_bound.hpp"
#include "guard/wrench_refusal.hpp"
#include "run/limit_table.hpp"
#include "run/log_layout.hpp"
#include "run/run_facts.hpp"
#include "run/shortfall.hpp"
#include "run/signal_watch.hpp"
#include "run/snapshot_signals.hpp"
#include "run/statement_table.hpp"
#include "run/why.hpp"
#include "schedule/at_rest.hpp"
#include "zwang/runtime/odometry.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/with_unit.hpp"
#include "zwang/solver/joint_loads.hpp"

namespace zwang::runtime {

struct Runner::Parts {
  Parts(const lang::Program& program, const RunnerSettings& settings);

  // Of runner_sense.cpp.
  /// The state from a good sample: the sample itself, or with the base reckoned from the wheels.
  void estimate(const Sensed& sensed) noexcept;
  /// The state of a robot whose drive sends samples at a lower rate than the ticks.
  void estimate_between_samples(const Sensed& sensed) noexcept;
  void estimate_base(const Sensed& sensed, double time) noexcept;
  void look_at_efforts(const Sensed& sensed, double stamp) noexcept;
  void take_signals(const Sensed& sensed) noexcept;
  void mend_rates() noexcept;
  /// [s] by the guard's clock.
  double measured_at(const Sensed& sensed) const noexcept;

  // Of runner_judge.cpp.
  void judge_clock(const Sensed& sensed) noexcept;
  /// Whether encoders confirm the motors' commands.
  void confirm() noexcept;
  void confirm(BlindBudget& part, BlindBudget& other) noexcept;
  /// Compares the last command with the motion of motors and wheels. `measured`: the sample before its
  /// projection.
  void compare(const solver::State& measured) noexcept;
  void judge_sensors() noexcept;
  void judge_snapshot(const Sensed& sensed) noexcept;
  void judge_wrenches() noexcept;
  /// The protective stop, where a watch found something.
  void stop(const std::optional<Event>& found) noexcept;
  void tell(const Event& event) noexcept;
  void tell_refusal(SampleStatus status) noexcept;
  void tell_of_host() noexcept;
  void tell_excursion() noexcept;
  void tell_doubt(double time) noexcept;

  // Of runner_control.cpp.
  /// Everything between a sample and its torques. False when there are none to send.
  bool control() noexcept;
  bool control_or_stop() noexcept;
  /// `state` as the ground allows it, in the sample. False when the solver cannot.
  bool project(const solver::State& state) noexcept;
  bool solve() noexcept;
  /// After a swap of programs: what was sent last fades out of the torques.
  void hand_over() noexcept;
  /// The torques to send, or the brake's; and what is expected of them.
  void send(bool good, bool solved) noexcept;
  /// Writes `tau` and, for a drive that takes velocities, the rest of its command.
  void put_command(bool good, bool solved) noexcept;
  /// Reports a protective stop once and follows it to its end; forgets a stop that was reset.
  void keep_stop(bool good_sample) noexcept;
  void brake_protectively(bool good_sample) noexcept;

  // Of runner_swap.cpp.
  bool has_the_joints_of(const Parts& other) const noexcept;
  void take_events_of(Parts& before) noexcept;
  void take_outputs_of(const Parts& before) noexcept;
  void take_motion_of(const Command& before) noexcept;

  // Of runner_report.cpp.
  void follow_limits() noexcept;
  void record(const Sensed& sensed, bool good, bool solved, std::span<const double> extra) noexcept;
  /// Of the last tick that was solved.
  Shortfall find_shortfall() const noexcept;

  bool blends() const noexcept { return scheduler.set_count() > 1; }
  /// The force on the base at its origin, in its axes: felt, or estimated.
  const solver::Vector3& force_on_base() const noexcept {
    const solver::Vector3* felt = drive ? drive->felt_force() : nullptr;
    return felt != nullptr ? *felt : disturbance.base_force();
  }

  const solver::Model model;
  std::vector<std::string> parameter_names;
  std::vector<std::string> output_names;
  double period;
  RunFacts facts;  ///< but for the parameters
  Scheduler scheduler;
  solver::Solver solver;
  solver::Solution solution;
  bool is_solution_of_rows = false;  ///< `solution` answers the constraints that the scheduler holds
  Sensed estimated;                  ///< the last good sample, but for its signals
  Sensed sample;                     ///< the same, its velocities as the ground allows them, and its signals
  Odometry odometry;
  std::optional<double> start;  ///< [s] of the first good sample
  bool reckoning = false;       ///< the base is not measured: `odometry` reckons it
  double last_fix = -std::numeric_limits<double>::infinity();  ///< [s]
  FrictionEstimate friction;
  Press press;
  solver::JointLoads arm;
  DisturbanceObserver disturbance;
  ClockRate clock_rate;
  JointRates rates;
  FrozenWheel frozen_wheel;
  BlindBudget blind_budget;
  BlindBudget blind_arm;
  HookLatch hook_latch;
  MotorWatch motors;
  SlipWatch slip;
  WheelSigns signs;
  WrenchRefusal wrenches;
  WrenchBound wrench_bound;
  const std::vector<lang::Signal> signals;
  SnapshotSignals snapshot;  ///< where they are in it
  SignalWatch signal_watch;
  std::vector<bool> is_judged;  ///< of each signal: it was looked at when the run began
  std::vector<Event> events;
  std::uint64_t event_count = 0;
  bool stop_is_told = false;
  EventCode told_refusal = EventCode::none;  ///< of the last sample; `none` when it was taken
  Event told_by_host;                        ///< since the last tick; code `none` when there is none
  Event event;                               ///< of this tick; code `none` when there is none
  SafetyGuard guard;
  StatementTable statements;
  const std::vector<std::string> signal_words;  ///< of events
  LimitTable limits;
  LogLayout layout;
  std::vector<double> given_parameters;  ///< as they stood when the tick began
  Recorder* recorder = nullptr;
  double logged = -std::numeric_limits<double>::infinity();  ///< [s] of the last record
  Eigen::VectorXd handed_over;        ///< difference of the torques at a swap of programs
  double handed_over_for = handover;  ///< [s] since then
  Eigen::VectorXd wanted;             ///< the solution's torques and the friction's
  Eigen::VectorXd tau;                ///< sent
  Eigen::VectorXd unknown_torque;     ///< of the motors behind velocity loops: 0
  Eigen::VectorXd compensation;       ///< of it, against friction
  std::optional<VelocityDrive> drive;
  bool is_new_sample = true;
  Command command;
  solver::Status solver_status = solver::Status::ok;
  GuardStatus guard_status = GuardStatus::passed;
  std::vector<Transition> transitions;
  std::uint64_t transition_count = 0;
  TurningPoint turning_point;
  std::uint64_t stopped_ticks = 0;
  bool is_a_wheel_dead = false;    ///< the stop is for its encoder
  bool is_obedience_told = false;  ///< of the motor that the stop is about
  RestWatch rest;                  ///< after a protective stop
  bool is_past_stop = false;       ///< a protective stop is over, by its time if not by rest
  bool is_rest_doubted = false;    ///< no sample has shown the base at rest after it
  bool is_end_doubted = false;     ///< no sample has shown the base at rest after the task
};

}  // namespace zwang::runtime
