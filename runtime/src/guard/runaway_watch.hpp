/// Finds a base that gets away from its motors.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "guard/contact_depth.hpp"
#include "zwang/runtime/event.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::runtime {

/// A world that only takes energy bounds the robot's kinetic energy, whatever its mass:
///   T(t) <= T(t0) + E(t0) + W,   W = integral of tau . qd from t0 to t,
/// with tau the motors' commands and E the energy that contacts have stored by t0. Suppose that an axis is
/// faster than its task drives or allows, W < 0 and T still grows. Then another source does the work: a motor
/// that pushes instead of braking, or a push from outside. Contacts that give back stored energy do it, too,
/// and are told apart:
///  - A bounce gives back less than the robot had before it: T(t0) + E(t0) is at most the largest T of the
///    last second.
///  - A contact gives back by weakening, k times less force for k times less way. A force that keeps its
///    direction and size while it drives the robot is not a contact's.
///  - A soft contact needs a long way to weaken. So the force also has to do more work than a spring of this
///    contact's depth (ContactDepth).
///
/// A motor that does the opposite of its command gives twice the work that it is told to take, and no contact
/// adds to it. If no motor's share comes near the work done, T(t) - T(t0) - W, the robot gives way to a push
/// from outside. A force range asks for that, so it is not a fault. (Of two motors each may do all of the
/// work.) The shares are taken over all the time since a speed was exceeded, and over the time in which T
/// grows alone. No motor gives the work that motors took between two pushes. A base far beyond its allowed
/// speed that still gets faster is a fault in any case. The source may be several motors with the wrong
/// wiring or a strong person: the base must not be moved so. A driver with a force range F and the time
/// constant T gives way by F T/m to a push of F. While a person pushes, that is not a runaway. Only
/// constraints between base and world count. A person who leads an arm by hand does work on the robot, and
/// the arm's joints have limits of their own. Three other causes are excluded, as T falls or W > 0 in each.
/// They are a limit that is tightened during the motion, a contact that turns the base, and a motion that
/// rows cause together. The hit of another robot is over before `dwell`. Does not allocate, lock, throw or
/// print after construction.
class RunawayWatch {
 public:
  using Force = Eigen::Ref<const Eigen::VectorXd>;
  /// `mass` [kg] of the robot.
  RunawayWatch(int joints, double mass, double period);

  /// Forgets what was.
  void reset() noexcept;
  /// Every tick: what was sent for the last period, and the rates that came of it. True when it is time to
  /// `look`.
  bool follow(const Eigen::VectorXd& sent, const Eigen::VectorXd& qd) noexcept;
  double period_of_looks() const noexcept { return ticks_between_looks_ * period_; }
  /// Low-passed: the rates whose kinetic energy `look` wants.
  const Eigen::VectorXd& rates() const noexcept { return rates_; }
  /// `force` is what the observer makes of the world's, in coordinates of free motion, and `contact` has
  /// followed it. If a person pushes the robot, or a row of the base yields, a base is a runaway only far
  /// beyond its limits. The event names the motor that brakes hardest by what it is told: a wheel that drives
  /// itself has the largest share of the motion. Its value is that wheel's rate.
  std::optional<Event> look(const solver::ConstraintSet& set, double kinetic_energy, Force force,
                            const ContactDepth& contact, bool is_pushed, bool blends = false) noexcept;

  static constexpr double margin = 0.01;        ///< [m/s] beyond a speed that is driven or allowed
  static constexpr double turn_margin = 0.05;   ///< [rad/s] `margin` of a rotation
  static constexpr double share = 0.1;          ///< of the bound, as the margin where that is more
  static constexpr double driven = 0.5;         ///< of these margins, where a steady force drives
  static constexpr double far = 0.2;            ///< [m/s] the margin beyond which the source does not matter
  static constexpr double turn_far = 1.0;       ///< [rad/s] `far` of a rotation
  static constexpr double share_far = 1.0;      ///< of the bound, as `far` where that is more
  static constexpr double steadily = 0.15;      ///< of a force: the largest change of a steady one
  static constexpr double explained = 0.8;      ///< of the work done: the least that one motor has to give
  static constexpr double look_every = 0.01;    ///< [s]
  static constexpr double memory = 1.0;         ///< [s] of the largest T: longer than contacts keep energy
  static constexpr double quick = 0.01;         ///< [s] of the rates' low pass
  static constexpr double growth = 1.01;        ///< of T from look to look
  static constexpr int dwell = 5;               ///< looks: longer than the hit of another robot
  static constexpr int remembered_looks = 100;  ///< memory / look_every

 private:
  /// A source of work on the robot while its motors are told to brake.
  struct Driver {
    Eigen::VectorXd work;  ///< [J] by what each motor was told, since it may be at work
    double energy = 0.0;   ///< [J] T then
    ContactDepth::Mark contact;
    int rising = 0;  ///< looks that T has grown
    void forget(double kinetic_energy, const ContactDepth::Mark& now) noexcept {
      work.setZero();
      energy = kinetic_energy;
      contact = now;
      rising = 0;
    }
    bool may_be_a_motor(double kinetic_energy) const noexcept {
      return -2.0 * work.minCoeff() > explained * (kinetic_energy - energy - work.sum());
    }
    void follow(bool drives) noexcept { rising = drives && work.sum() < 0.0 ? rising + 1 : 0; }
  };
  bool keeps(Force force) noexcept;

  double mass_, period_, part_;
  int ticks_between_looks_, ticks_ = 0;
  Eigen::VectorXd rates_;
  Driver beyond_;  ///< since a speed was exceeded
  Driver rise_;    ///< since T grows then
  Driver steady_;  ///< since the force is what it is and T grows
  Driver far_;     ///< since a speed was far exceeded
  Eigen::VectorXd steady_force_;
  Eigen::Index force_size_ = 0;
  std::array<double, remembered_looks> energies_{};  ///< [J] a ring
  std::size_t looks_ = 0;
  double largest_before_ = 0.0;  ///< [J]
  double last_energy_ = 0.0;     ///< [J]
  bool is_exceeded_ = false;
  bool has_rates_ = false;
};

}  // namespace zwang::runtime
