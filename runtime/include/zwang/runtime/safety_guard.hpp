/// The last stage before the robot. It trusts neither the sensors nor the clock nor the solver.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/event.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::runtime {

/// The verdict of `admit` on a sample.
enum class SampleStatus {
  good,
  not_finite,  ///< a number in it is not finite, or beyond anything a robot can have
  bad_clock,   ///< time stood still, went backwards or jumped
  untimely,    ///< the same, but the stop is latched and the values are good: it brakes by them
};
ZWANG_EXPORT const char* to_string(SampleStatus status) noexcept;

/// The way that the torques went through the guard.
enum class GuardStatus {
  passed,   ///< the torques went through as they came
  limited,  ///< a torque was cut to its limit
  slewed,   ///< a torque's rate was cut
  held,     ///< the sample was refused: the last torques stay
  stopped,  ///< the protective stop is latched: the wheels brake
};
ZWANG_EXPORT const char* to_string(GuardStatus status) noexcept;

/// The bounds of the guard.
struct GuardSettings {
  double period = 1e-3;     ///< [s] control period
  double max_step = 0.1;    ///< [s] a longer step of time is refused
  int max_lost_ticks = 20;  ///< as many without a good sample, or with a frozen one, stop the robot
  /// [N m/s] or [N/s] of every joint, beside the robot's own `slew`
  double max_slew = std::numeric_limits<double>::infinity();
};

/// Counts since construction.
struct GuardCounters {
  std::uint64_t samples = 0;         ///< that came to `admit`
  std::uint64_t refused_values = 0;  ///< `not_finite`
  std::uint64_t refused_clock = 0;   ///< `bad_clock` or `untimely`
  std::uint64_t frozen = 0;          ///< samples
  std::uint64_t bad_torques = 0;     ///< calls of `output` without one finite torque a joint
  std::uint64_t limited = 0;         ///< calls of `output` that cut a torque to its limit
  std::uint64_t slewed = 0;          ///< calls that cut a torque's rate
};

/// As many ticks without a good sample stop a robot of this control period [s]: 20, but at least 5, and for
/// 50 ms where those are fewer.
ZWANG_EXPORT int lost_ticks(double period) noexcept;

class ArmHold;
class FrozenState;
class JointLimits;
class WheelBrake;

/// Does not allocate, lock, throw or print after construction.
class ZWANG_EXPORT SafetyGuard {
 public:
  /// Throws std::invalid_argument on settings that are not positive.
  explicit SafetyGuard(const lang::Robot& robot, const GuardSettings& settings = {});
  ~SafetyGuard();
  SafetyGuard(SafetyGuard&&) noexcept;
  SafetyGuard& operator=(SafetyGuard&&) noexcept;

  /// Every sample comes through here first. A number that is not finite latches the stop at once.
  /// `max_lost_ticks` in a row latch it, too, if they have no good sample or a frozen one. A frozen sample
  /// reports motion but stands where the last one did. It is frozen, too, if positions that rolled evenly do
  /// not change any more. Values and stamp are judged apart. While the stop is latched any good values are
  /// `good` or `untimely`. If a stamp went back or jumped, the clock goes on from it. A sample with the stamp
  /// and the values of its predecessor has not arrived.
  SampleStatus admit(const Sensed& sensed) noexcept;

  /// The torques to send: `wanted`, checked to be finite, then cut to the joints' limits, then to the slew.
  /// When the stop is latched they are the brake's, from memory on a frozen sample, and an arm is held in its
  /// place. A joint of an arm latches the stop if it is faster than its limit or too fast for the rest of its
  /// travel. `tau` keeps its size. Call it when `admit` said good or untimely. A stop that brakes by the
  /// model sends `wanted` of the wheels, cut to the limits.
  GuardStatus output(const Sensed& sensed, const Eigen::VectorXd& wanted, Eigen::VectorXd& tau) noexcept;
  /// The torques to send when `admit` refused the sample: the last ones. When the stop is latched, they brake
  /// the rates of the last good sample, and bear an arm.
  GuardStatus output_blind(Eigen::VectorXd& tau) noexcept;

  /// Latches the protective stop, for one of the codes that do. The first reason is kept. The event also
  /// holds the signal that showed it and that signal's value.
  void stop(EventCode reason, int signal = -1, double value = 0.0) noexcept;
  /// From now on a stop neither trusts nor remembers the rates of the wheels, or of an arm. A caller that
  /// knows them by other means commands their motors. False: the stop trusts them again.
  void brake_by_model(bool wheels, bool arm) noexcept {
    brakes_by_model_ = wheels;
    holds_by_model_ = arm;
  }
  bool stopped() const noexcept { return stop_event_.code != EventCode::none; }
  EventCode reason() const noexcept { return stop_event_.code; }  ///< `none` while nothing latched the stop
  /// Releases the stop; the clock starts anew.
  void reset() noexcept;
  /// [s] of the last good or untimely sample. It never goes back: after a stamp that does, it goes on by a
  /// period, and `clock_shift` [s] is what it is ahead of the stamps by.
  double time() const noexcept { return last_time_ + clock_shift_; }
  double clock_shift() const noexcept { return clock_shift_; }

  const GuardCounters& counters() const noexcept { return counters_; }
  /// The event that latched the stop; its code is `none` while the stop is not latched.
  const Event& stop_event() const noexcept { return stop_event_; }
  /// The brake of this stop has found that the motor which the stop is about obeys.
  bool motor_obeyed() const noexcept;
  /// The fault of the sample that `admit` refused last.
  const Event& refusal() const noexcept { return refusal_; }

 private:
  double due() const noexcept;
  bool is_timely(double stamp) const noexcept;
  bool is_shown_again(const Sensed& sensed) const noexcept;
  Event find_bad_entry(const Sensed& sensed) const noexcept;
  SampleStatus refuse_stamp(const Sensed& sensed) noexcept;
  SampleStatus take_untimely(const Sensed& sensed) noexcept;
  void take_stamp(double stamp) noexcept;
  void latch(const Event& event) noexcept;
  void brake(const Sensed& sensed, const Eigen::VectorXd& wanted) noexcept;
  void brake_blind() noexcept;
  void clamp_next() noexcept;
  void take_values(const solver::State& state, double step) noexcept;
  void take_new_values(const Sensed& sensed, double step) noexcept;
  bool is_frozen() const noexcept;
  GuardStatus send(Eigen::VectorXd& tau, GuardStatus status) noexcept;

  GuardSettings settings_;
  Eigen::VectorXd limit_;  ///< [N m] of each joint, 0 where there is no motor
  Eigen::VectorXd step_;   ///< [N m] that each may change by in a tick
  Eigen::VectorXd last_;   ///< sent last
  Eigen::VectorXd next_;
  Eigen::VectorXd last_q_, last_qd_;  ///< of the last sample that was taken, as is the position
  solver::Vector3 last_position_ = solver::Vector3::Zero();
  bool takes_velocity_ = false;
  double last_measured_at_ = 0.0;  ///< [s] of such a drive's last sample
  std::unique_ptr<ArmHold> arm_;
  std::unique_ptr<FrozenState> frozen_;
  std::unique_ptr<JointLimits> joint_limits_;
  std::unique_ptr<WheelBrake> brake_;
  int frozen_ticks_ = 0;
  bool brakes_by_model_ = false;
  bool holds_by_model_ = false;
  double last_time_ = 0.0;    ///< [s] its stamp
  double clock_shift_ = 0.0;  ///< [s]
  bool has_time_ = false;
  bool has_begun_ = false;           ///< a sample was taken since construction
  bool stamp_says_nothing_ = false;  ///< it stood while the values changed
  int lost_ticks_ = 0;
  Event stop_event_;
  Event refusal_;
  GuardCounters counters_;
};

}  // namespace zwang::runtime
