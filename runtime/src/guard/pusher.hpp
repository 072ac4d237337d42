/// Finds that somebody pushes the robot.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "estimate/disturbance.hpp"
#include "guard/wheel_motors.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::runtime {

/// The force of a motor that fails begins with its command; that of a person who leans on the base begins
/// before it. A motor that gives any torque up to the largest, m_j, that it was told since p began differs
/// from its command by |f_j| <= m_j + |tau_j|, so that all of them together, whatever is wrong with them, do
/// no more work on the robot than
///   sum of (m_j + |tau_j|) |qd_j|,
/// and contacts with what stands give back what they took. Since p began out of nothing, when they had taken
/// nothing yet, that is
///   B = integral of P - sum of (m_j + |tau_j|) |qd_j| <= 0.
/// Where B is more, somebody else does work, and goes on until p is nothing again: what has the size of a
/// motor's share then, as a push at its wheel has that it answers, is no motor's. Does not allocate, lock,
/// throw or print after construction.
class Pusher {
 public:
  /// `period` [s] between looks.
  Pusher(const lang::Robot& robot, double period);

  void reset() noexcept;
  /// P [W] of the observer's force, at the joints' rates.
  void look(const DisturbanceObserver& observer, double power, const Eigen::VectorXd& rates) noexcept;
  bool is_at_work() const noexcept { return is_at_work_; }

  static constexpr double least = 2e-3;      ///< [J] B: 20 N on a tenth of a millimetre
  static constexpr double smallest = 0.015;  ///< torque that counts as a force, of a motor's limit

 private:
  std::vector<WheelMotor> motors_;
  Eigen::VectorXd most_told_;  ///< [N m] m_j, since p began
  double period_;
  double excess_ = 0.0;     ///< [J] B
  bool has_begun_ = false;  ///< p, out of nothing
  bool is_at_work_ = false;
};

}  // namespace zwang::runtime
