/// Finds wheels whose motor does not follow its command.
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

/// If motor j gives tau_j + f instead of tau_j, the robot feels a force p = T_j f. It has one direction of
/// the free motions, and its own command tells its size:
///   lost     f = -tau_j
///   flipped  f = -2 tau_j
///   stuck    f = const - tau_j
/// The fault shows from the instant at which f is not 0. Contact can have the same direction, too: the corner
/// of a differential base, as far out as its wheel. Three criteria tell a fault from contact.
///  - Size. Contact grows from nothing through that size to another one. A motor's force has the size at
///    `entry` after its onset out of quiet, and keeps it `closely` for `dwell`. If the robot touched
///    something less than `after_a_hit` before, the force also has to drive it by `least_way`. A base that
///    turns about a corner at the wall leans on it evenly, with the command of the wheel beside it, and that
///    force does no work. An error of the mass seems to do some, so `own_way` of the rim's way counts as
///    well. The force of a padded wall takes work, first by its damper, then by its spring, and is even in
///    between.
///  - Place. Where the wheel rolls on by `travel`, a contact between the robot and a standing object gives
///    way or grows. A motor's force keeps its direction and size `closely` meanwhile, farther than a spring
///    of the same depth does (ContactDepth). The robot goes `along` it meanwhile. A base that turns about a
///    corner at the wall rolls the wheel beside it, too. It hardly goes along the force of the corner. Its
///    onset does not matter. So a motor that failed without a command is found between two hits. A cart in
///    tow moves along, too, and in a bend its pull turns slowly through all directions. So a force that came
///    into this direction slower than in `turning` is not a motor's. A motor that obeyed since its command
///    started (Obedience) is not claimed: a force as large as its command has another source.
///  - Order. Contact precedes the command that answers it. A fault makes at most 2 max|tau_j| of the motor's
///    commands until then. If p jumps out of quiet to more, there is a contact. However soft it is, p counts
///    as its force. This ends when p has pressed `left_behind` times as hard as the claim, or is quiet again.
///
/// Two cases cannot be told apart and are not watched. In the first, a wheel stands, and a wall bears its
/// missing torque. In the second, all driven wheels push in the same direction, as on a car. A motor without
/// torque is not noticed while its command is 0, and does no harm then. Does not allocate, lock, throw or
/// print after construction.
class ActuatorWatch {
 public:
  ActuatorWatch(const lang::Robot& robot, double period);

  void reset() noexcept;
  /// After each comparison of the observer; `q` are the joints' positions.
  std::optional<Event> look(const DisturbanceObserver& observer, const Eigen::VectorXd& q,
                            const ContactDepth& contact) noexcept;

  static constexpr double entry = 0.03;       ///< [s] from the onset of a force to the suspicion
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
  /// Of the robot's whole way. A contact that stands seems to have a tenth, if its direction is off by
  /// `closely`. An error of the mass may double that.
  static constexpr double along = 0.2;
  static constexpr double varied = 0.2;  ///< of f: a command that differs by that much proves a stuck motor

 private:
  /// The suspicion that a motor has one kind of fault.
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
    int ticks_since_hit = 0;               ///< p was more than any fault makes, or pressed on after that
    bool is_met = false;                   ///< what began is a contact
    bool is_armed = false;
    Obedience obedience;
  };
  /// The remainder of a force after a motor's share.
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
