/// Finds wheels whose motor does not do what it is told.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "estimate/disturbance.hpp"
#include "guard/contact_depth.hpp"
#include "guard/obedience.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/event.hpp"

namespace zwang::runtime {

/// A motor j that gives tau_j + f instead of tau_j is a force p = T_j f on the robot, along one direction of
/// its free motions, and of a size that its own command tells:
///   lost     f = -tau_j
///   flipped  f = -2 tau_j
///   stuck    f = const - tau_j
/// from the instant on at which it differs from nothing. Contact can have that direction, too: the corner of
/// a differential base, as far out as its wheel. Three things tell them apart.
///  - Contact grows from nothing through that size to another one: a force that had the size `entry` after it
///    began out of quiet, and keeps it `closely` for `dwell`, is a motor's. Where something was hit less than
///    `after_a_hit` before, it has to drive the robot by `least_way` as well: a base that turns about a
///    corner at the wall leans on it with what the wheel beside it is told, evenly, and that force does no
///    work. An error of the mass seems to do some, so `own_way` of the rim's way is asked for. The force of a
///    padded wall takes work, first by its damper, then by its spring, and is even in between.
///  - Contact has a place: where the wheel rolls on by `travel`, a contact between the robot and what stands
///    gives way or grows. A force that keeps to direction and size `closely` the while, farther than a spring
///    does that is as deep (ContactDepth), is a motor's, whenever it began: a motor that failed while it was
///    told nothing is so found between two hits. A cart in tow moves along, too, and its pull turns slowly
///    through all directions in a bend: a force that came into this one slower than in `turning` is no
///    motor's. Not one that was seen to obey since it is told something (Obedience): what is as large as its
///    command is something else then.
///  - Contact comes before the command that answers it: where p jumps out of quiet to more than any fault
///    makes of what the motor was told until then, 2 max|tau_j|, something is touched. However soft it is,
///    p stays its own until it has pressed `left_behind` times as hard as what is claimed, or is quiet again.
/// What cannot be told apart: a wheel that stands, against a wall that bears what it does not give; and where
/// all driven wheels push in the same direction, as those of a car do. They are not watched. A motor without
/// torque that is told to give none is not noticed, and does no harm. Does not allocate, lock, throw or print
/// after construction.
class ActuatorWatch {
 public:
  ActuatorWatch(const lang::Robot& robot, double period);

  void reset() noexcept;
  /// After each comparison of the observer; `q` are the joints' positions.
  std::optional<Event> look(const DisturbanceObserver& observer, const Eigen::VectorXd& q,
                            const ContactDepth& contact) noexcept;

  static constexpr double entry = 0.03;       ///< [s] from the begin of a force to the suspicion
  static constexpr double dwell = 0.04;       ///< [s] that a suspicion must last
  static constexpr double most_told = 2.5;    ///< of the command: more than any fault makes of it
  static constexpr double left_behind = 2.0;  ///< times what is claimed: a hit that is over was harder
  static constexpr double quiet = 0.01;       ///< [s] without a force, until the next one counts
  static constexpr double most_unexplained = 0.1;
  static constexpr double off = 0.25;          ///< of the size that the command tells
  static constexpr double smallest = 0.015;    ///< torque that is missed, of the motor's limit
  static constexpr double closely = 0.1;       ///< of the force, both in direction and size
  static constexpr double late = 4.0;          ///< thresholds that such a force is worth
  static constexpr double close_dwell = 0.03;  ///< [s] that a force keeps close
  static constexpr double turning = 0.1;  ///< [s] until then: what takes longer turns, as a cart in a bend
  static constexpr double after_a_hit = 1.0;   ///< [s] in which a base still bounces, and squares up
  static constexpr double least_way = 0.2e-3;  ///< [m] at the wheel's rim
  static constexpr double own_way =
      0.5;  ///< of its rim's way: a motor drives all of it, a contact beside it none
  static constexpr double travel = 0.5e-3;  ///< [m] of the wheel's rim
  static constexpr double varied = 0.2;  ///< of f: a command that differs by that much proves a stuck motor

 private:
  /// That a motor has one kind of fault.
  struct Claim {
    int ticks = 0;                     ///< that it has held
    int along_ticks = 0;               ///< that the force has had its direction, whatever its size
    int close_ticks = 0;               ///< that it has held closely
    ContactDepth::Mark contact;        ///< when it began to hold
    double q = 0.0;                    ///< [rad] then
    bool is_apart = false;             ///< then, from any hit
    double close_q = 0.0;              ///< [rad] where it began to hold closely
    ContactDepth::Mark close_contact;  ///< then
    double left = 0.0;                 ///< of |p|^2 that it does not explain
    double share = 0.0;                ///< of the size that it tells, when it began to hold
  };
  enum Kind { lost, flipped, stuck, kind_count };
  struct Motor {
    int joint = 0;
    double radius = 0.0;     ///< [m]
    double threshold = 0.0;  ///< [N m] of f
    double f = 0.0;          ///< [N m] that it differs by, if it is this motor
    std::array<Claim, kind_count> claims;
    double low_tau = 0.0, high_tau = 0.0;  ///< [N m] since it may be stuck
    double low_sum = 0.0, high_sum = 0.0;  ///< [N m] of tau + f
    int loud_ticks = 0;                    ///< since a force began
    int quiet_ticks = 0;                   ///< without one
    double told = 0.0;                     ///< [N m] the largest command since before it began
    double hardest = 0.0;                  ///< [N m] the largest |p| / |T_j| since then
    int ticks_since_hit = 0;               ///< p was more than any fault makes of the command
    bool is_met = false;                   ///< what began is a contact
    bool is_armed = false;
    Obedience obedience;
  };
  /// What is left of a force when a motor explains it.
  struct Fit {
    double f = 0.0, tau = 0.0;     ///< [N m]
    double s = 0.0;                ///< |T_j|^2
    double rest = 0.0, all = 0.0;  ///< |p - T_j f|^2 and |p|^2
  };
  void follow_onset(Motor& motor, const Fit& fit) const noexcept;
  void follow(Motor& motor, Kind kind, const Fit& fit, double f, double slack, double q,
              const ContactDepth& contact) const noexcept;
  void follow_stuck(Motor& motor, const Fit& fit, double q, const ContactDepth& contact) const noexcept;
  bool is_sure(const Motor& motor, Kind kind, const Fit& fit, double q,
               const ContactDepth& contact) const noexcept;
  static double way_of(const Motor& motor, const Fit& fit, const ContactDepth::Mark& since,
                       const ContactDepth& contact) noexcept;
  bool is_distinct(const Motor& motor, const solver::FreeMotions& motions) const noexcept;

  std::vector<Motor> motors_;
  int dwell_ticks_ = 0, entry_ticks_ = 0, quiet_ticks_ = 0, close_ticks_ = 0, turning_ticks_ = 0,
      after_a_hit_ticks_ = 0;
};

}  // namespace zwang::runtime
