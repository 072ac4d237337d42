/// Tells when all encoders are dead from a standstill on.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "zwang/lang/robot.hpp"
#include "zwang/runtime/event.hpp"

namespace zwang::runtime {

/// A base that stood while its motors were told nothing, and then is told to move, moves: by the model wheel
/// j has turned by
///   q_j = integral of integral of qdd_j,
/// and some encoder has counted a step long before q_j is 0.1 rad. Where none has changed by a bit, nothing
/// is known of the base, and it is driven blindly: the encoders are dead, or the motors, or something holds
/// it, be it a wall that it stood at without a gap or friction that the robot file does not know. Who stands
/// at a wall because the base pressed itself there was told to press all the time, and is left alone. Does
/// not allocate, lock, throw or print after construction.
class FrozenAtRest {
 public:
  explicit FrozenAtRest(const lang::Robot& robot);

  /// Every good sample: positions as they were measured, what was sent since the last one [N m], and the
  /// accelerations that the model expected of it [rad/s^2]. The event's value: the way that the wheel should
  /// have turned. [rad]
  std::optional<Event> look(const Eigen::VectorXd& q, const Eigen::VectorXd& sent,
                            const Eigen::VectorXd& expected, double time) noexcept;

  static constexpr double enough = 0.1;   ///< [rad] by the model
  static constexpr double quiet = 1e-3;   ///< torque that moves nothing, of its motor's limit
  static constexpr double longest = 0.1;  ///< [s] from one sample to the next, lost ones between

 private:
  struct Wheel {
    int joint = 0;
    double quiet = 0.0;  ///< [N m]
    double rate = 0.0;   ///< [rad/s] by the model, since it was told to move
    double way = 0.0;    ///< [rad]
  };
  void begin(bool is_quiet) noexcept;

  std::vector<Wheel> wheels_;
  Eigen::VectorXd q_;  ///< of the last sample
  double time_ = 0.0;
  bool has_last_ = false;
  bool was_quiet_ = false;  ///< while it stood where it stands
};

}  // namespace zwang::runtime
