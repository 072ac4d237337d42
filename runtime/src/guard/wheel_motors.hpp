/// The motors that turn wheels, as those who watch them list them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "zwang/lang/robot.hpp"
#include "zwang/solver/solver.hpp"

namespace zwang::runtime {

struct WheelMotor {
  int joint = 0;
  double radius = 0.0;     ///< [m] of its wheel
  double threshold = 0.0;  ///< [N m] the least torque that shows the motor's state
};

/// The wheels' motors whose torque has a limit. `smallest` is the share of the limit that counts. Where a
/// joint stands, its dry friction may be anything up to its bound, either way.
inline std::vector<WheelMotor> wheel_motors(const lang::Robot& robot, double smallest) {
  std::vector<WheelMotor> motors;
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const int j = wheel.body - 1;
    const solver::Joint& joint = robot.model.joint(j);
    if (!joint.actuated || !std::isfinite(joint.max_effort)) continue;
    const auto i = static_cast<std::size_t>(j);
    const double coulomb = i < robot.friction.size() ? robot.friction[i].coulomb : 0.0;
    motors.push_back({j, wheel.radius, std::max(smallest * joint.max_effort, 2.0 * coulomb)});
  }
  return motors;
}

/// The smallest force on the free motions that corresponds to a motor's threshold; 0 without motors.
inline double least_force(const std::vector<WheelMotor>& motors,
                          const solver::FreeMotions& motions) noexcept {
  double least = solver::infinity;
  for (const WheelMotor& motor : motors)
    least = std::min(least, motor.threshold * motions.joint.row(motor.joint).head(motions.count).norm());
  return motors.empty() ? 0.0 : least;
}

}  // namespace zwang::runtime
