/// The last stage before the robot. It trusts nobody: not the sensors, not the clock, not the solver.
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

enum class SampleStatus {
  good,
  not_finite,  ///< a number in it is not finite, or beyond anything a robot can have
  bad_clock,   ///< time stood still, went backwards or jumped
  untimely,    ///< the same, but the stop is latched and the values are good: it brakes by them
};
ZWANG_EXPORT const char* to_string(SampleStatus status) noexcept;

enum class GuardStatus {
  passed,   ///< the torques went through as they came
  limited,  ///< a torque was cut to its limit
  slewed,   ///< a torque's rate was cut
  held,     ///< the sample was refused: the last torques stay
  stopped,  ///< the protective stop is latched: the wheels brake
};
ZWANG_EXPORT const char* to_string(GuardStatus status) noexcept;

struct GuardSettings {
  double period = 1e-3;     ///< [s] control period
  double max_step = 0.1;    ///< [s] a longer step of time is refused
  int max_lost_ticks = 20;  ///< as many without a good sample, or with a frozen one, stop the robot
  /// [N m/s] or [N/s] of every joint, beside the robot's own `slew`
  double max_slew = std::numeric_limits<double>::infinity();
};

struct GuardCounters {
  std::uint64_t samples = 0;
  std::uint64_t refused_values = 0;
  std::uint64_t refused_clock = 0;
  std::uint64_t frozen = 0;
  std::uint64_t bad_torques = 0;
  std::uint64_t limited = 0;
  std::uint64_t slewed = 0;
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

  /// Every sample comes through here first. Numbers that are not finite latch the stop at once, and so do
  /// `max_lost_ticks` without a good sample, with samples that say to move and stand where the last one did,
  /// or with positions that rolled evenly and from one sample to the next do not change any more.
  /// Values and stamp are judged apart. While the stop is latched any good values are `good` or `untimely`,
  /// and a stamp that went back or jumped is where the clock goes on from. A sample with the stamp and the
  /// values of the last one has not arrived.
  SampleStatus admit(const Sensed& sensed) noexcept;

  /// The torques to send: `wanted`, checked to be finite, then cut to the joints' limits, then to the slew;
  /// the brake's when the stop is latched, from memory on a frozen sample; an arm is held where it was. A
  /// joint of an arm that is faster than it may be, or could hardly be kept in its travel, latches the stop.
  /// `tau` keeps its size. Call it when `admit` said good or untimely. A stop that brakes by the model sends
  /// `wanted` of the wheels, cut to the limits.
  GuardStatus output(const Sensed& sensed, const Eigen::VectorXd& wanted, Eigen::VectorXd& tau) noexcept;
  /// The torques to send when `admit` refused the sample: the last ones, or when the stop is latched those
  /// that brake what the last good sample said, and bear an arm.
  GuardStatus output_blind(Eigen::VectorXd& tau) noexcept;

  /// Latches the protective stop, for one of the codes that do. The first reason is kept. What told it, and
  /// what that read, is for the event.
  void stop(EventCode reason, int signal = -1, double value = 0.0) noexcept;
  /// From now on a stop neither believes nor remembers the wheels' rates: whoever knows the base by other
  /// means says what its wheels are to do. False: it does again.
  void brake_by_model(bool yes) noexcept { brakes_by_model_ = yes; }
  bool stopped() const noexcept { return stop_event_.code != EventCode::none; }
  EventCode reason() const noexcept { return stop_event_.code; }  ///< `none` while nothing latched the stop
  /// Releases the stop; the clock starts anew.
  void reset() noexcept;
  /// [s] of the last good or untimely sample. It never goes back: after a stamp that does, it goes on by a
  /// period, and `clock_shift` [s] is what it is ahead of the stamps by.
  double time() const noexcept { return last_time_ + clock_shift_; }
  double clock_shift() const noexcept { return clock_shift_; }

  const GuardCounters& counters() const noexcept { return counters_; }
  /// What latched the stop; its code is `none` while nothing did.
  const Event& stop_event() const noexcept { return stop_event_; }
  /// What was wrong with the sample that `admit` refused last.
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
  void brake(const Sensed& sensed) noexcept;
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
