/// Finds wheels whose motor does not do what it is told.
#pragma once

#include <optional>
#include <vector>

#include "estimate/disturbance.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/event.hpp"

namespace zwang::runtime {

/// A motor j that gives tau_j + f instead of tau_j is a force p = T_j f on the robot, along one direction of
/// its free motions, and of a size that its own command tells:
///   lost     f = -tau_j
///   flipped  f = -2 tau_j
///   stuck    f = const - tau_j
/// from the instant on at which it differs from nothing. Contact can have that direction, too: the corner of
/// a differential base, as far out as its wheel. But it grows from nothing through that size to another one,
/// so a force that did not have the size `entry` after it began is nobody's motor, until it is gone. For the
/// same reason a motor that breaks while the robot touches something is not found before that. What cannot be
/// told apart: where all driven wheels push in the same direction, as those of a car do; they are not
/// watched. A motor without torque that is told to give none is not noticed, and does no harm. Does not
/// allocate, lock, throw or print after construction.
class ActuatorWatch {
 public:
  ActuatorWatch(const lang::Robot& robot, double period);

  void reset() noexcept;
  /// After each comparison of the observer.
  std::optional<Event> look(const DisturbanceObserver& observer) noexcept;

  static constexpr double memory = 0.005;  ///< [s] of the means
  static constexpr double entry = 0.03;    ///< [s] from the begin of a force to the suspicion
  static constexpr double dwell = 0.04;    ///< [s] that a suspicion must last
  static constexpr double quiet = 0.01;    ///< [s] without a force, until the next one counts
  static constexpr double most_unexplained = 0.1;
  static constexpr double off = 0.25;        ///< of the size that the command tells
  static constexpr double smallest = 0.015;  ///< torque that is missed, of the motor's limit

 private:
  /// Means over the memory, of u = p . T_j and s = |T_j|^2.
  struct Motor {
    int joint = 0;
    double threshold = 0.0;  ///< [N m] of f
    double u_tau = 0.0, tau_tau_s = 0.0;
    double f = 0.0, f_f = 0.0, f_tau = 0.0, tau = 0.0, tau_tau = 0.0, explained = 0.0;
    EventCode suspicion = EventCode::none;
    int ticks = 0;
    int loud_ticks = 0;   ///< since a force began
    int quiet_ticks = 0;  ///< without one
    bool is_armed = false;
  };
  void follow_onset(Motor& motor, double threshold, double force) const noexcept;
  EventCode suspect(const Motor& motor) const noexcept;
  bool is_distinct(const Motor& motor, const solver::FreeMotions& motions) const noexcept;

  std::vector<Motor> motors_;
  double part_ = 0.0;
  int dwell_ticks_ = 0, entry_ticks_ = 0, quiet_ticks_ = 0;
  double p_p_ = 0.0;
};

}  // namespace zwang::runtime
