#include "drive/velocity_drive.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "guard/wheel_motors.hpp"

namespace zwang::runtime {

VelocityDrive::VelocityDrive(const lang::Robot& robot, double period, int row_capacity)
    : drive_(robot.drive),
      period_(period),
      deceleration_(robot.stop.deceleration),
      limit_(Eigen::VectorXd::Zero(robot.model.joint_count())),
      row_bounds_(robot.model, row_capacity),
      set_point_(robot.drive, robot.model),
      pressing_(limit_),
      measured_(robot.model) {
  for (const WheelMotor& motor : wheel_motors(robot, 0.0)) {
    const double limit = robot.model.joint(motor.joint).max_effort;
    limit_(motor.joint) = limit;
    wheels_.push_back({.joint = motor.joint, .radius = motor.radius, .brake = limit});
  }
  const double force = robot.stop.force / std::max<double>(1.0, static_cast<double>(wheels_.size()));
  for (Wheel& wheel : wheels_) wheel.brake = std::min(wheel.brake, force * wheel.radius);
}

void VelocityDrive::take(const solver::State& state, double stamp) noexcept {
  measured_ = state;
  measured_at_ = stamp;
}

/// The base goes on along a circle: its heading is the mean one on the way.
void VelocityDrive::carry_on(double time, solver::State& state) const noexcept {
  const double age = std::max(0.0, time - measured_at_);
  state = measured_;
  state.q += age * measured_.qd;
  const double turn = age * measured_.base_twist.angular.z();
  const auto about_z = [](double angle) { return Eigen::AngleAxisd(angle, solver::Vector3::UnitZ()); };
  const solver::Matrix3& R = measured_.base_pose.rotation;
  state.base_pose.position += R * (about_z(0.5 * turn) * (age * measured_.base_twist.linear));
  state.base_pose.rotation = R * about_z(turn);
}

std::optional<Event> VelocityDrive::look_for_samples(double time) const noexcept {
  const double age = time - measured_at_;
  if (!(age > 0.5 * drive_.delay + lost_cycles / drive_.rate + lost_time)) return std::nullopt;
  return Event{EventCode::lost_ticks, time, event_signal::time, age};
}

/// A wheel that is slower than its command is blocked, or rests on its torque limit. One that is faster, or
/// turns the other way, does what nobody tells it.
std::optional<Event> VelocityDrive::look(const solver::State& measured, double time) noexcept {
  std::optional<Event> found;
  for (Wheel& wheel : wheels_) {
    const double rate = measured.qd(wheel.joint);
    const double room = slack / wheel.radius;
    const bool is_beyond = rate > (1.0 + share) * std::max(0.0, wheel.most) + room ||
                           rate < (1.0 + share) * std::min(0.0, wheel.least) - room;
    wheel.beyond_since = is_beyond ? std::min(wheel.beyond_since, time) : solver::infinity;
    if (!found && time - wheel.beyond_since > followed_in)
      found =
          Event{EventCode::not_followed, time, event_signal::of_joint(wheel.joint, event_signal::qd), rate};
  }
  return found;
}

/// The largest and the least of the commands that may still be on their way.
void VelocityDrive::remember(const Command& command) noexcept {
  const double fade = period_ / (drive_.time_constant + drive_.delay + 1.0 / drive_.rate + period_);
  for (Wheel& wheel : wheels_) {
    const double told = command.velocity(wheel.joint);
    wheel.most = std::max(told, wheel.most + fade * (told - wheel.most));
    wheel.least = std::min(told, wheel.least + fade * (told - wheel.least));
  }
}

void VelocityDrive::drive(const solver::Solver& solver, const Scheduler& scheduler,
                          const solver::Solution& solution, const Eigen::VectorXd& qd,
                          const Eigen::VectorXd& compensation, Command& command) noexcept {
  blind_for_ = 0.0;
  slowest_ = solver::infinity;
  for (Wheel& wheel : wheels_) wheel.is_let_go = false;
  pressing_ = command.torque - compensation;
  const TorqueBounds& bounds = row_bounds_.look(solver, scheduler, solution);
  put_box(bounds, pressing_, limit_, command.lower, command.upper);
  command.lower = (command.lower + compensation).cwiseMax(-limit_);
  command.upper = (command.upper + compensation).cwiseMin(limit_);
  set_point_.put(solver, scheduler.constraints(), solution, row_bounds_.motions(), qd, command.velocity);
  remember(command);
}

void VelocityDrive::let_go_of_what_drives(const Eigen::VectorXd& qd, int suspect) noexcept {
  double square = 0.0;
  for (Wheel& wheel : wheels_) {
    square += std::pow(wheel.radius * qd(wheel.joint), 2);
    wheel.is_let_go = wheel.is_let_go || wheel.joint == suspect;
  }
  const double speed = std::sqrt(square / std::max<double>(1.0, static_cast<double>(wheels_.size())));
  if (speed > slowest_ + faster) {
    Wheel* fastest = nullptr;
    double most = 0.0;
    for (Wheel& wheel : wheels_) {
      const double gained = wheel.radius * (std::abs(qd(wheel.joint)) - std::abs(wheel.rate_then));
      if (wheel.is_let_go || gained <= most) continue;
      most = gained;
      fastest = &wheel;
    }
    if (fastest != nullptr) fastest->is_let_go = true;
    slowest_ = solver::infinity;
  }
  if (speed > slowest_) return;
  slowest_ = speed;
  for (Wheel& wheel : wheels_) wheel.rate_then = qd(wheel.joint);
}

void VelocityDrive::brake(const Eigen::VectorXd* qd, int suspect, Command& command) noexcept {
  if (qd != nullptr) let_go_of_what_drives(*qd, suspect);
  bool turns = false;
  command.torque.setZero();
  command.lower.setZero();
  command.upper.setZero();
  for (const Wheel& wheel : wheels_) {
    double& told = command.velocity(wheel.joint);
    const double step = deceleration_ / wheel.radius * period_;
    told -= std::clamp(told, -step, step);
    turns = turns || told != 0.0;
  }
  blind_for_ = qd != nullptr || turns ? 0.0 : blind_for_ + period_;
  for (const Wheel& wheel : wheels_) {
    if (wheel.is_let_go) continue;
    const double rate = qd != nullptr ? (*qd)(wheel.joint) : 0.0;
    const double most = qd != nullptr              ? wheel.brake * std::min(1.0, std::abs(rate) / full_brake)
                        : blind_for_ < brake_after ? wheel.brake
                                                   : 0.0;
    command.lower(wheel.joint) = qd != nullptr && rate < 0.0 ? 0.0 : -most;
    command.upper(wheel.joint) = qd != nullptr && rate > 0.0 ? 0.0 : most;
  }
  remember(command);
}

void VelocityDrive::go_on_from(const VelocityDrive& before) noexcept {
  measured_ = before.measured_;
  measured_at_ = before.measured_at_;
  wheels_ = before.wheels_;
  blind_for_ = before.blind_for_;
}

}  // namespace zwang::runtime
