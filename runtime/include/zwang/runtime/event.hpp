/// Faults and near faults of a run: each with its time, the signal that showed it, and the value of that
/// signal.
#pragma once

#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/solver/model.hpp"

namespace zwang::runtime {

/// The kind of an event. The codes from `bad_sample` to `effort_lost` latch the protective stop.
enum class EventCode {
  none,
  // These codes latch the protective stop.
  bad_sample,        ///< a number in a sample that is not finite or cannot be; a vector of another size
  lost_ticks,        ///< too long without a good sample; `value`: the step of time [s]
  frozen,            ///< no encoder confirms the motion that the motors or the rates tell
  bad_torque,        ///< a torque for SafetyGuard::output is not finite, or their number is another
  solver,            ///< the solver refused the tick; `value`: its Status
  plant,             ///< the robot does not answer
  requested,         ///< a host asked for the stop
  watchdog,          ///< no tick came in time
  torque_lost,       ///< a motor gives nothing of what it is told
  torque_stuck,      ///< a motor keeps the torque that it had
  torque_flipped,    ///< a motor gives the opposite
  joint_travel,      ///< a joint of an arm is too near to the end of its travel for the speed that it has
  joint_speed,       ///< a joint of an arm is faster than its URDF allows
  runaway,           ///< faster than the task allows, and ever faster while the motors are told to brake
  rate_contradicts,  ///< the rate of a joint is not that of its position
  wheel_reversed,    ///< the wheels contradict each other, and agree if this one's rate has the other sign
  motors_reversed,   ///< the base accelerates against what its motors are told
  clock_back,        ///< the samples' clock went back; `value`: by how much [s], negative
  clock_stands,      ///< the samples' clock stands while their values change
  clock_rate,  ///< the samples' clock runs faster or slower than the control period; `value`: how many times
  wrench_impossible,  ///< a wrench from outside that nothing can press with counts as 0; told, a stop if it
                      ///< goes on
  not_followed,  ///< a wheel is faster than a drive that takes velocities was told, or turns against it, or
                 ///< stays behind where the drive has torque limits of its own; `value`: its rate
  frozen_base,   ///< the wheels roll, and the measured base stays as it was; `value`: how far they say [m]
  effort_lost,   ///< the measured torque of a wheel's motor is not that of its velocity loop; `value`: the
                 ///< torque
  // These codes are only reported.
  clock_refused,   ///< time went backwards, or jumped
  clock_drift,     ///< the samples' clock is off by more than a tenth; `value`: its rate
  sample_lost,     ///< none has arrived since the last tick
  sensor_bias,     ///< a force is measured before anything has moved
  slip,            ///< the wheels contradict each other, or the measured base
  wrench_refused,  ///< along an axis whose force is limited, f_ext is not for the solver
  entry_refused,   ///< what a task requires to be entered does not hold; `value` is the task's number
  signal_refused,  ///< samples of it come, and cannot be taken; `value`: a stamp that is ahead by so much, or
                   ///< 0
  probed,       ///< no encoder counted where the motors should have moved the base; told to move back, it did
  outside,      ///< a frame stands outside of a position range or a region that holds it; `value`: how far
  not_at_rest,  ///< the longest time of a stop is over, and no sample shows the base at rest; `value`: its
                ///< speed, as far as it is known
  overrun,  ///< the host has skipped five control cycles within a second; `value`: how late the last was [s]
  motor_obeyed,    ///< the motor that the stop is about obeyed in the stop's brake
  drive_at_limit,  ///< the measured torque of a wheel's motor is at its limit for 0.2 s; `value`: the torque
};
inline constexpr EventCode last_event_code = EventCode::drive_at_limit;
ZWANG_EXPORT const char* to_string(EventCode code) noexcept;
/// The same for people: "a motor turns the wrong way".
ZWANG_EXPORT const char* describe(EventCode code) noexcept;
inline constexpr bool latches_the_stop(EventCode code) {
  return code > EventCode::none && code < EventCode::clock_refused;
}

/// One event: its code, its time, and the signal that showed it.
struct Event {
  EventCode code = EventCode::none;
  /// [s] of the sample; where it has no good time, when it was due. After a clock that went back it goes on
  /// from where it was.
  double time = 0.0;
  int signal = -1;     ///< index into `event_signals`
  double value = 0.0;  ///< what the signal read, or what is wrong with it; SI
};

/// The names that an event's `signal` can have. First come `time`, `base.pose` and `base.twist`, then q, qd,
/// tau_ff and tau of each joint and the external wrench of each body. The signals of the task file and its
/// rows are last.
ZWANG_EXPORT std::vector<std::string> event_signals(const solver::Model& model,
                                                    const std::vector<std::string>& measured,
                                                    const std::vector<std::string>& rows);

/// Indices into `event_signals`.
namespace event_signal {
inline constexpr int time = 0;
inline constexpr int base_pose = 1;
inline constexpr int base_twist = 2;
enum OfJoint { q, qd, tau_ff, tau, of_joint_count };
inline constexpr int of_joint(int joint, OfJoint what) {
  return base_twist + 1 + of_joint_count * joint + what;
}
inline constexpr int joint_of(int signal) {
  return signal <= base_twist ? -1 : (signal - base_twist - 1) / of_joint_count;
}
inline constexpr int f_ext(int joints, int body) {
  return of_joint(joints, q) + body;
}
inline constexpr int measured(int joints, int signal) {
  return f_ext(joints, joints + 1) + signal;
}
inline constexpr int of_row(int joints, int measured_count, int row) {
  return measured(joints, measured_count) + row;
}
}  // namespace event_signal

}  // namespace zwang::runtime
