#include "velocity_loop.hpp"

#include <algorithm>

namespace zwang::runtime {

VelocityLoop::VelocityLoop(const lang::Robot& robot)
    : takes_twist_(robot.drive.takes_twist),
      limit_is_fixed_(robot.drive.limit_is_fixed),
      torque_(Eigen::VectorXd::Zero(robot.model.joint_count())) {
  for (const LoopGain& gain : loop_gains(robot)) wheels_.push_back({gain, 0.0});
}

const Eigen::VectorXd& VelocityLoop::step(const Command& command, const Eigen::VectorXd& qd,
                                          double period) noexcept {
  for (Wheel& wheel : wheels_) {
    const int j = wheel.gain.joint;
    const double low = limit_is_fixed_ ? -wheel.gain.limit
                                       : std::clamp(command.lower(j), -wheel.gain.limit, wheel.gain.limit);
    const double high =
        limit_is_fixed_ ? wheel.gain.limit : std::clamp(command.upper(j), low, wheel.gain.limit);
    const double error = wanted_velocity(wheel, command) - qd(j);
    const double wanted = wheel.gain.proportional * error + wheel.sum;
    torque_(j) = std::clamp(wanted, low, high);
    const bool winds_up = (wanted > high && error > 0.0) || (wanted < low && error < 0.0);
    if (!winds_up) wheel.sum += wheel.gain.integral * error * period;
  }
  return torque_;
}

}  // namespace zwang::runtime
