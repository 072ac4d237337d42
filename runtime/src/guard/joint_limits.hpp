/// Stops an arm before one of its joints leaves its travel, or when one is too fast.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "guard/arm_hold.hpp"
#include "zwang/runtime/event.hpp"

namespace zwang::runtime {

/// Travel and speed are the `<limit>` of the URDF: lower, upper and velocity. The stop has to come while the
/// hold can still keep the joint inside. With s = +-1 as the direction of the end, the hold needs the
/// distance
///   d = v t + v / (e w) + v^2 / (2 a),   v = s qd + max(0, s (tau - g) / I) t,   a = (tau_max + s g) / I
/// t is the time in which the present torque reverses, and g and I are the load and the inertia on the joint.
/// v / (e w) is the overshoot of a hold of the frequency w, and v^2 / (2 a) is the way of a torque at its
/// limit. A joint may stand at an end from the start, as a closed gripper or a lowered lift does. It then
/// rests on the end, which bears its weight and any push. There the stop comes only where the joint would go
/// beyond by ten times the resolution, v = s qd, until it has left the end by as much. Does not allocate,
/// lock, throw or print after construction.
class JointLimits {
 public:
  /// `max_torque` [N m] of each joint, and `slew` [N m] how much of it may change in a tick of `period` [s].
  JointLimits(const solver::Model& model, const Eigen::VectorXd& max_torque, const Eigen::VectorXd& slew,
              double period);

  /// An event when a joint of `arm`, which took this state, is too fast, or too near to an end. `tau` was
  /// sent last.
  std::optional<Event> look(const solver::State& state, const Eigen::VectorXd& tau, const ArmHold& arm,
                            double time) noexcept;

  static constexpr double speed_margin = 1.1;   ///< of `velocity`: it is a limit for motion that is planned
  static constexpr double resolution = 2e-3;    ///< [rad] that noise or a soft end stop may show at rest
  static constexpr double resolution_m = 2e-4;  ///< [m] the same where a joint slides
  static constexpr double rest = 10.0;          ///< resolutions from an end in which a joint rests on it

 private:
  struct Limit {
    double lower, upper, speed, max_torque;
    double turn;        ///< t [s]
    double resolution;  ///< [rad] or [m]
    bool rests_on_lower = false, rests_on_upper = false;
  };
  std::vector<Limit> limits_;  ///< of each joint of the model
  bool is_first_ = true;
};

}  // namespace zwang::runtime
