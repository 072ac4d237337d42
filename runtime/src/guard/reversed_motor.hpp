/// Finds a motor that does the opposite of its command, by the work that it does.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "guard/contact_depth.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/event.hpp"

namespace zwang::runtime {

/// Work that no motor is told to do acts on the robot at the rate P = p . yd. A contact with a standing
/// object does none while it presses steadily, however hard and wherever, as its point does not move. A motor
/// j that gives -tau_j does work, beside any such contacts, at the rate
///   P_j = -2 tau_j qd_j,
/// at rates that change all the time. So a constant P / P_j = 1 while the wheel rolls on means motor j. Other
/// sources of energy are told apart as follows:
///  - A contact that gives back stored energy weakens: its force F loses K s on the way s. So a contact
///    stiffer than `steadily` F / `travel`, 2 kN/m at 40 N, does not keep its share. The motor also has to do
///    more work than a spring of the depth of this contact (ContactDepth).
///  - A person who pushes the robot evenly gives P = -W, and the robot does not get faster. W = sum of tau_k
///    qd_k is the commanded work of all motors. A reversed motor's P + W speeds the robot up.
///  - A model with a wrong mass has the error E. Its p = -E ydd gives P = e (P + W). If the mass is at least
///    half of the model's, e <= 1/2, so W is larger than P.
///
/// Where two motors have the same share, neither is reported: on a car they cannot be told apart. Does not
/// allocate, lock, throw or print after construction.
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
