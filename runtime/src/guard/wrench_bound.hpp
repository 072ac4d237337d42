/// Refuses wrenches from outside that nothing can press with.
#pragma once

#include <optional>
#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/event.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::runtime {

/// The largest contact force on a robot of the mass m has three parts. They are its weight, the force of its
/// motors at the ground, and a hit at the speed v on a spring of the stiffness K:
///   F = m g + sum tau_max / r + 1.5 v sqrt(K m)
/// A damped hit stays below 1.5 v sqrt(K m) up to a damping ratio of 0.75. A hit presses hardest when the
/// robot already stands, so v is the largest speed of a while. With its lever R a force makes a moment of F R
/// at most. A larger wrench is a sensor's fault. Does not allocate, lock, throw or print after construction.
class WrenchBound {
 public:
  /// `longest`: as many ticks in a row with an impossible wrench are a stop.
  WrenchBound(const lang::Program& program, double period, int longest);

  /// Every good sample: an impossible wrench of `state.f_ext` or of a wrench signal becomes 0. The event,
  /// `wrench_impossible`, when that begins, and again when the stop is due; `value` is the wrench's size.
  std::optional<Event> look(solver::State& state, std::vector<SignalSample>& signals, double time) noexcept;
  /// The speed that a hit may have, of the program before this one.
  void go_on_from(const WrenchBound& before) noexcept { speed_ = before.speed_; }
  /// It has gone on for as long as stops the robot.
  bool is_due() const noexcept { return ticks_ >= longest_; }

  double force() const noexcept;   ///< [N] the bound now
  double moment() const noexcept;  ///< [N m]

  static constexpr double stiffness = 1e6;  ///< K [N/m]: steel on steel; shipped walls have a tenth of it
  static constexpr double hit = 1.5;        ///< of v sqrt(K m)
  static constexpr double memory = 0.5;     ///< [s] of v: a hit on 2 kN/m compresses for 0.24 s with 46 kg
  static constexpr double pause = 1.0;      ///< [s] without one before the next is reported

 private:
  struct MovingJoint {
    int joint = 0;
    double lever = 1.0;  ///< [m] that a turn moves a point by at most; 1 where the joint slides
  };
  void follow(const solver::State& state) noexcept;
  double excess(const solver::ForceVector& wrench, bool has_lever) const noexcept;

  int longest_;
  double keep_;                        ///< of v from tick to tick
  double steady_ = 0.0;                ///< [N] weight and motors
  double root_mass_ = 0.0;             ///< sqrt(m) [kg^1/2]
  double lever_ = 0.0;                 ///< R [m]
  std::vector<MovingJoint> joints_;    ///< of arms
  std::vector<bool> is_wrench_;        ///< of each signal
  std::vector<bool> signal_on_robot_;  ///< of each signal: it is about a point of the robot
  double speed_ = 0.0;                 ///< v [m/s]
  int ticks_ = 0;
  std::optional<double> last_;  ///< [s] when a wrench was refused
};

}  // namespace zwang::runtime
