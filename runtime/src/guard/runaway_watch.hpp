/// Finds a base that gets away from its motors.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "zwang/runtime/event.hpp"
#include "zwang/solver/constraint.hpp"

namespace zwang::runtime {

/// A world that only takes energy leaves the robot's kinetic energy, whatever its mass,
///   T(t) <= T(t0) + E(t0) + W,   W = integral of tau . qd from t0 to t,
/// tau what its motors are told and E what contacts have stored by t0. A bounce gives back less than the
/// robot had before it; so E(t0) + T(t0) is at most the largest T of the last second. Where W < 0 and T is
/// larger than that, somebody else does the work: a motor that pushes where it is told to brake, or a push
/// from outside that the robot may not resist. The second is no fault as long as the base keeps the speeds
/// that its task drives and allows; the first soon does not keep them. A limit that is tightened under way,
/// a contact that turns the base, a motion that rows bring about together: in each of them T falls, or W > 0.
/// Does not allocate, lock, throw or print after construction.
class RunawayWatch {
 public:
  RunawayWatch(int joints, double period);

  /// Forgets what was.
  void reset() noexcept;
  /// Every tick: what was sent for the last period, and the rates that came of it. True when it is time to
  /// `look`.
  bool follow(const Eigen::VectorXd& sent, const Eigen::VectorXd& qd) noexcept;
  /// Low-passed: the rates whose kinetic energy `look` wants.
  const Eigen::VectorXd& rates() const noexcept { return rates_; }
  /// The event names the motor that brakes hardest by what it is told: a wheel that drives itself has the
  /// largest share of the motion. Its value is that wheel's rate.
  std::optional<Event> look(const solver::ConstraintSet& set, double kinetic_energy) noexcept;

  static constexpr double margin = 0.03;        ///< [m/s] beyond a speed that is driven or allowed
  static constexpr double turn_margin = 0.1;    ///< [rad/s] the same of rotations
  static constexpr double share = 0.1;          ///< of the speed itself, where that is more
  static constexpr double look_every = 0.01;    ///< [s]
  static constexpr double memory = 1.0;         ///< [s] of the largest T: longer than contacts keep energy
  static constexpr double quick = 0.01;         ///< [s] of the rates' low pass
  static constexpr double growth = 1.01;        ///< of T from look to look
  static constexpr int dwell = 5;               ///< looks: longer than the hit of another robot
  static constexpr int remembered_looks = 100;  ///< memory / look_every

 private:
  static bool is_exceeded(const solver::ConstraintSet& set) noexcept;

  double period_, part_;
  int ticks_between_looks_, ticks_ = 0;
  Eigen::VectorXd rates_;
  Eigen::VectorXd work_;  ///< [J] by what each motor was told, since the speed was exceeded
  std::array<double, remembered_looks> energies_{};  ///< [J] a ring
  std::size_t looks_ = 0;
  double largest_before_ = 0.0;  ///< [J]
  double last_energy_ = 0.0;     ///< [J]
  bool is_exceeded_ = false;
  int rising_ = 0;  ///< looks
};

}  // namespace zwang::runtime
