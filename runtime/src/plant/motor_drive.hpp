/// From a robot's command to its motors' torques.
#pragma once

#include <optional>

#include "estimate/ticks.hpp"
#include "velocity_loop.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/runtime/command.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::runtime {

/// From a robot's command to its motors' torques.
class MotorDrive {
 public:
  explicit MotorDrive(const lang::Robot& robot) {
    const Command nothing(robot.model.joint_count());
    if (!robot.drive.takes_velocity) return;
    line_.emplace(1.0 / robot.drive.rate, 0.5 * robot.drive.delay, nothing);
    loop_.emplace(robot);
  }
  bool takes_velocity() const noexcept { return loop_.has_value(); }
  /// `now` is the robot's true state, `period` [s] the step of the simulation.
  void drive(const Command& command, const Sensed& now, double period, Eigen::VectorXd& torque) noexcept {
    if (loop_) {
      torque = loop_->step(line_->pass(command, now.time), now.state.qd, period);
    } else {
      torque = command.torque;
    }
  }

 private:
  std::optional<SampledLine<Command>> line_;
  std::optional<VelocityLoop> loop_;
};

}  // namespace zwang::runtime
