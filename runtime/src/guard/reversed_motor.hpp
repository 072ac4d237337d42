/// Finds a motor that does the opposite of what it is told, by the work that it does.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "guard/contact_depth.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/event.hpp"

namespace zwang::runtime {

/// What nobody commands does work on the robot at the rate P = p . yd. A contact with what stands does none
/// while it presses steadily, however hard and wherever: its point does not move. A motor j that gives -tau_j
/// does, beside any such contacts,
///   P_j = -2 tau_j qd_j,
/// at rates that change all the time. So P / P_j = 1 that stays the same while the wheel rolls on is motor j.
/// What else gives energy, and how it is told apart:
///  - A contact that gives back what it stored slackens: of a force F it loses K s on the way s, so that none
///    stiffer than `steadily` F / `travel`, 2 kN/m at 40 N, keeps its share; and the motor has to do more
///    than a spring as deep as this one was pressed in (ContactDepth).
///  - Somebody who pushes the robot evenly gives P = -W, W = sum of tau_k qd_k what all motors were told to
///    do, and it does not get faster; a reversed motor's P + W is what speeds it up.
///  - The error E of a model with a wrong mass, p = -E ydd, gives P = e (P + W) with e <= 1/2 where the mass
///    is no less than half of the model's: W is larger than P then.
/// Where two motors have the same share, none is told: on a car they cannot be told apart. Does not allocate,
/// lock, throw or print after construction.
class ReversedMotor {
 public:
  /// `period` [s] between looks.
  ReversedMotor(const lang::Robot& robot, double period);

  void reset() noexcept;
  /// P [W], what the motors were told [N m], and the joints' rates, all of the same moments; `contact` has
  /// followed P.
  std::optional<Event> look(double power, const Eigen::VectorXd& told, const Eigen::VectorXd& rates,
                            const ContactDepth& contact) noexcept;

  static constexpr double least = 0.9, most = 1.125;  ///< of P_j: a mass may be wrong by a fifth
  static constexpr double steadily = 0.05;            ///< of the share that it began with
  static constexpr double dwell = 0.06;               ///< [s]
  static constexpr double travel = 1e-3;              ///< [m] of the wheel's rim
  static constexpr double braked = 0.8;               ///< of P: the most that the motors are told to take,
  static constexpr double given = 0.25;               ///< and to give
  static constexpr double smallest = 0.03;            ///< torque that counts, of the motor's limit

 private:
  struct Motor {
    int joint = 0;
    double radius = 0.0;     ///< [m]
    double threshold = 0.0;  ///< [N m]
    double share = 0.0;      ///< P / P_j, when it began
    double way = 0.0;        ///< [m] since then
    int looks = 0;           ///< since then
    ContactDepth::Mark contact;
  };
  void follow(Motor& motor, double power, double told, double rate,
              const ContactDepth& contact) const noexcept;

  std::vector<Motor> motors_;
  double period_;
};

}  // namespace zwang::runtime
