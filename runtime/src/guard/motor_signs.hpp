/// Finds a base whose motors all turn against their commands.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "estimate/disturbance.hpp"
#include "guard/wheel_motors.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/event.hpp"

namespace zwang::runtime {

/// A sign that is wrong for every motor, or for every encoder. The base accelerates against its command,
/// c = sum of T_j tau_j in the coordinates of free motion, with
///   p = -gamma c,   gamma = 2.
/// The controller that sees the wrong motion drives it on. The sign is wrong from the first torque or never.
/// So the check runs until the motors were seen to obey, gamma near 0. A contact takes gamma = 1 of the force
/// that presses against it. A person who pushes the base does so before it answers, so gamma comes down from
/// far above. A velocity driver begins to answer a force p = a t with c = a t^2 / 2T, which leaves 1/16 of
/// |p|^2. So p is compared with c from the onset of both. If they do not fit, the next comparison waits until
/// both are gone. Does not allocate, lock, throw or print after construction.
class MotorSigns {
 public:
  MotorSigns(const lang::Robot& robot, double period);

  /// There is nothing to compare with for a while.
  void pause() noexcept { begin(is_touched_ || c_c_ > 0.0); }
  /// After each comparison of the observer. The event's value: how much of the commanded acceleration there
  /// is.
  std::optional<Event> look(const DisturbanceObserver& observer) noexcept;

  static constexpr double dwell = 0.04;                         ///< [s] of torques that count
  static constexpr double smallest = 0.03;                      ///< torque that counts, of a motor's limit
  static constexpr double quiet = 0.1;                          ///< of that: the least that is not nothing
  static constexpr double unexplained = 0.02;                   ///< of |p|^2: the most that may be left
  static constexpr double least_gamma = 1.6, most_gamma = 2.5;  ///< a mass may be wrong by a third
  static constexpr double obeying = 0.4;  ///< of c: the most that may be missed, along it or across

 private:
  void begin(bool is_touched) noexcept;

  std::vector<WheelMotor> motors_;
  Eigen::VectorXd c_;
  int dwell_ticks_;
  bool obey_ = false;
  bool is_touched_ = false;                   ///< p is not c's: nothing is told until both are gone
  int ticks_ = 0;                             ///< that torques count
  double c_c_ = 0.0, p_c_ = 0.0, p_p_ = 0.0;  ///< sums since p or c began
};

}  // namespace zwang::runtime
