/// Detects a person who pushes the robot.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "estimate/disturbance.hpp"
#include "guard/wheel_motors.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::runtime {

/// The force of a motor that fails starts with its command; that of a person who leans on the base starts
/// before it. Say that a failed motor gives at most the largest torque, m_j, of its commands since the onset
/// of p. It then differs from its command by |f_j| <= m_j + |tau_j|. So all motors together, whatever their
/// faults are, do no more work on the robot than
///   sum of (m_j + |tau_j|) |qd_j|,
/// and contacts with standing objects give back the work that they took. At the onset of p they had taken
/// none yet. Since then that is
///   B = integral of P - sum of (m_j + |tau_j|) |qd_j| <= 0.
/// If B is more, a person or another robot does work, and does so until p is 0 again. Until then a force of
/// the size of a motor's share is not a motor's: a push at a wheel that answers it has that size, too. Does
/// not allocate, lock, throw or print after construction.
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
