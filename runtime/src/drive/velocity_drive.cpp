#include "drive/velocity_drive.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "guard/wheel_motors.hpp"
#include "schedule/braking.hpp"

namespace zwang::runtime {

VelocityDrive::VelocityDrive(const lang::Robot& robot, double period, int row_capacity)
    : drive_(robot.drive),
      period_(period),
      deceleration_(robot.stop.deceleration),
      limit_(Eigen::VectorXd::Zero(robot.model.joint_count())),
      most_(Eigen::VectorXd::Constant(robot.model.joint_count(), solver::infinity)),
      row_bounds_(robot.model, row_capacity),
      set_point_(robot.drive, robot.model, period),
      radius_(footprint_radius(robot)),
      pressing_(limit_),
      measured_(robot.model) {
  for (const WheelMotor& motor : wheel_motors(robot, 0.0)) {
    // The model is the virtual robot's, the motors are the real one's.
    const double limit = robot.model.joint(motor.joint).max_effort / drive_.mass_factor;
    limit_(motor.joint) = limit;
    wheels_.push_back({.joint = motor.joint, .radius = motor.radius, .brake = limit});
  }
  for (const LoopGain& gain : loop_gains(robot)) {
    const auto wheel = std::ranges::find(wheels_, gain.joint, &Wheel::joint);
    if (drive_.has_virtual_robot())
      wheel->most_gain = gain.limit / (gain.proportional * drive_.time_constant);
  }
  const double force = robot.stop.force / std::max<double>(1.0, static_cast<double>(wheels_.size()));
  for (Wheel& wheel : wheels_) wheel.brake = std::min(wheel.brake, force * wheel.radius);
  if (drive_.feels_contact() && !drive_.integral_time)
    bent_per_force_ = bent * drive_.time_constant * drive_.mass_factor / robot.model.total_mass();
  if (drive_.has_virtual_robot()) virtual_.emplace(robot, period);
  if (drive_.feels_contact() && drive_.feels.by == lang::Feels::By::effort)
    effort_watch_.emplace(robot, period);
}

void VelocityDrive::take(const solver::State& state, double stamp) noexcept {
  measured_ = state;
  measured_at_ = stamp;
  if (virtual_ && virtual_->has_begun()) virtual_->correct(state, stamp);
}

void VelocityDrive::put_virtual(double time, bool is_stopped, solver::State& state) noexcept {
  if (is_stopped) return virtual_->end();
  if (!virtual_->has_begun()) virtual_->begin(state, time);
  virtual_->put(state);
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

/// If the drive is sent torque limits, a wheel that is slower than its command is blocked, or rests on its
/// limit. A wheel that is faster, or turns the other way, does not follow any command.
double VelocityDrive::difference(const Wheel& wheel, double rate, const Allowance& allowance) const noexcept {
  const double high = virtual_ ? wheel.most : std::max(0.0, wheel.most);
  const double low = virtual_ ? wheel.least : std::min(0.0, wheel.least);
  const double room = (allowance.slack + bent_by_) / wheel.radius;
  if (rate > high + share * std::abs(high) + room) return rate - high;
  if (rate < low - share * std::abs(low) - room) return low - rate;
  return 0.0;
}

/// Whether it is there for longer than allowed. A virtual robot that a felt contact brakes yields to it: its
/// motors press with all that they have until it stands. It is no fault while the difference shrinks from its
/// largest value. A hit stops the real base within a few samples, and the first of them shows little of it.
bool VelocityDrive::lasts(Lag& lag, double difference, const Allowance& allowance,
                          double time) const noexcept {
  if (!(difference > 0.0)) lag = {};
  if (difference > 0.0 && !(lag.since <= time)) lag = {time, difference};
  if (!(time - lag.since > allowance.time)) return false;
  const bool yields = virtual_ && virtual_->is_pressed() && difference <= shrunk * lag.difference;
  if (yields) lag = {time, difference};
  return !yields;
}

/// The commands asked for a change of rate of  sum (told - rate) dt / lead.
bool VelocityDrive::is_contrary(Wheel& wheel, double rate, double time) const noexcept {
  const double lag = difference(wheel, rate, fast);
  const bool has_lasted = lasts(wheel.beyond, lag, fast, time);
  const bool begins = wheel.beyond.since == time;
  wheel.asked = begins ? 0.0 : wheel.asked + (wheel.told - rate) * (time - looked_at_) / set_point_.lead();
  if (begins) wheel.rate_before = rate;
  if (!has_lasted) return false;
  const bool is = (wheel.rate_before - rate) * wheel.asked > contrary * wheel.asked * wheel.asked;
  if (!is) wheel.beyond = {};
  return is;
}

std::optional<Event> VelocityDrive::look(const solver::State& measured, double time) noexcept {
  std::optional<Event> found;
  double farthest = 0.0;  // [m/s]
  if (const solver::Vector3* force = felt_force()) bent_by_ = bent_per_force_ * force->head<2>().norm();
  for (Wheel& wheel : wheels_) {
    const double rate = measured.qd(wheel.joint);
    const bool is_beyond = virtual_ ? lasts(wheel.beyond, difference(wheel, rate, fast), fast, time)
                                    : is_contrary(wheel, rate, time);
    const double lag = virtual_ ? difference(wheel, rate, slow) : 0.0;
    const bool is_behind = lasts(wheel.behind, lag, slow, time);
    // A wheel that a contact holds is slower than told. A reversed motor is not, and gets no other reference.
    const bool may_be_held = std::abs(rate) <= std::max(std::abs(wheel.most), std::abs(wheel.least));
    if (virtual_ && may_be_held) {
      wheel.beyond.difference = std::max(wheel.beyond.difference, difference(wheel, rate, fast));
      wheel.behind.difference = std::max(wheel.behind.difference, lag);
    }
    const double beyond = difference(wheel, rate, fast);
    wheel.runs_away = beyond > 0.0 && rate * (rate > wheel.most ? beyond : -beyond) > 0.0;
    const double off = wheel.radius * difference(wheel, rate, slow);
    if (!(is_beyond || is_behind) || (found && off <= farthest)) continue;
    farthest = off;
    found = Event{EventCode::not_followed, time, event_signal::of_joint(wheel.joint, event_signal::qd), rate};
  }
  looked_at_ = time;
  const solver::Vector3& velocity = measured.base_twist.linear;
  const bool is_led_away = lasts(led_away_, virtual_ ? difference(velocity) : 0.0, fast, time);
  if (!found && is_led_away)
    found = Event{EventCode::not_followed, time, event_signal::base_twist, velocity.head<2>().norm()};
  return found;
}

/// From the nearest of what it was told on the way from `before_` to `told_`.
double VelocityDrive::difference(const solver::Vector3& velocity) const noexcept {
  const Eigen::Vector2d v = velocity.head<2>();
  const Eigen::Vector2d way = told_ - before_;
  const double square = way.squaredNorm();
  const double part = square > 0.0 ? std::clamp((v - before_).dot(way) / square, 0.0, 1.0) : 0.0;
  const double most = std::max(told_.norm(), before_.norm());
  const double off = (v - before_ - part * way).norm();
  return off > fast.slack + bent_by_ + share * most ? off : 0.0;
}

/// The largest and the least of the commands that may still be on their way.
void VelocityDrive::remember(const Command& command) noexcept {
  const double fade = period_ / (drive_.time_constant + drive_.delay + 1.0 / drive_.rate + period_);
  for (Wheel& wheel : wheels_) {
    const double told = wheel.told = command.velocity(wheel.joint);
    wheel.most = std::max(told, wheel.most + fade * (told - wheel.most));
    wheel.least = std::min(told, wheel.least + fade * (told - wheel.least));
  }
  told_ = command.twist.head<2>();
  before_ += fade * (told_ - before_);
}

void VelocityDrive::drive(const solver::Solver& solver, const Scheduler& scheduler,
                          const solver::Solution& solution, const solver::State& state, double time,
                          const Eigen::VectorXd& compensation, Command& command) noexcept {
  blind_for_ = 0.0;
  countered_ = {};
  lets_go_ = false;
  slowest_ = solver::infinity;
  for (Wheel& wheel : wheels_) wheel.is_let_go = false;
  if (virtual_) {
    for (const Wheel& wheel : wheels_)
      most_(wheel.joint) = wheel.beyond.since <= time ? limit_(wheel.joint) : solver::infinity;
    virtual_->move(state, solver, solution, most_, time + period_);
    virtual_->tell(command);
    command.lower = -limit_;
    command.upper = limit_;
    if (effort_watch_) effort_watch_->tell(command.velocity, time);
    return remember(command);
  }
  pressing_ = command.torque - compensation;
  const TorqueBounds& bounds = row_bounds_.look(solver, scheduler, solution);
  put_box(bounds, pressing_, limit_, command.lower, command.upper);
  command.lower = (command.lower + compensation).cwiseMax(-limit_);
  command.upper = (command.upper + compensation).cwiseMin(limit_);
  set_point_.put(solver, scheduler.constraints(), solution, row_bounds_.motions(), state.qd,
                 command.velocity);
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
      const double faster_by = wheel.radius * (std::abs(qd(wheel.joint)) - std::abs(wheel.rate_then));
      if (wheel.is_let_go || faster_by <= most) continue;
      most = faster_by;
      fastest = &wheel;
    }
    if (fastest != nullptr) fastest->is_let_go = true;
    slowest_ = solver::infinity;
  }
  if (speed > slowest_) return;
  slowest_ = speed;
  for (Wheel& wheel : wheels_) wheel.rate_then = qd(wheel.joint);
}

/// The base goes on along its circle, and no corner of it brakes harder than `stop.deceleration`.
void VelocityDrive::ramp_to_rest(Command& command) const noexcept {
  const double speed = command.twist.head<2>().norm() + radius_ * std::abs(command.twist.z());
  const double step = deceleration_ * period_;
  const double left = speed > step ? 1.0 - step / speed : 0.0;
  command.twist *= left;
  command.velocity *= left;
}

/// The loop of a reversed motor accelerates its wheel away from V, by (v - V)/T_c up to its limit. It brakes
/// if V is beyond what the wheel can have reached until the command acts. A sound motor follows V, and gets
/// faster. Then it is told 0 as the others are.
void VelocityDrive::counter(const Eigen::VectorXd& qd, int suspect, Command& command) noexcept {
  const auto wheel = std::ranges::find(wheels_, suspect, &Wheel::joint);
  if (wheel == wheels_.end() || drive_.takes_twist) return;
  // A wheel that is held when the stop begins, and is turned by hand later, is none.
  if (suspect != countered_.joint) countered_ = {.joint = suspect, .is_sound = !wheel->runs_away};
  if (countered_.is_sound) return;
  const double late = drive_.delay + 2.0 / drive_.rate;
  const double rate = qd(suspect);
  countered_.since += period_;
  if (countered_.since <= late + drive_.time_constant) countered_.speed = std::abs(rate);
  countered_.is_sound = std::abs(rate) > countered_.speed + gained / wheel->radius + late * wheel->most_gain;
  const double beyond = 2.0 * rate + std::copysign(late * wheel->most_gain, rate);
  command.velocity(suspect) = countered_.is_sound ? 0.0 : beyond;
}

bool VelocityDrive::moves(const Command& command) const noexcept {
  return virtual_ && (lets_go_ || is_told_to_move(command));
}

bool VelocityDrive::is_told_to_move(const Command& command) const noexcept {
  const auto is_told = [&](const Wheel& wheel) {
    return wheel.joint != countered_.joint && command.velocity(wheel.joint) != 0.0;
  };
  return std::ranges::any_of(wheels_, is_told) || !command.twist.isZero(0.0);
}

void VelocityDrive::brake(const Eigen::VectorXd* qd, int suspect, Command& command, bool is_felt) noexcept {
  command.torque.setZero();
  if (effort_watch_) effort_watch_->begin();
  if (virtual_) {
    lets_go_ = is_felt && virtual_->may_let_go();
    if (lets_go_ && (virtual_->lets_go() || !is_told_to_move(command))) {
      virtual_->let_go(command);
    } else {
      ramp_to_rest(command);
      virtual_->hold_on();
    }
    if (qd != nullptr) counter(*qd, suspect, command);
    return remember(command);
  }
  if (qd != nullptr) let_go_of_what_drives(*qd, suspect);
  bool turns = false;
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

void VelocityDrive::rest(Command& command) noexcept {
  if (!virtual_) return;
  if (effort_watch_) effort_watch_->begin();
  command.velocity.setZero();
  command.twist.setZero();
}

void VelocityDrive::go_on_from(VelocityDrive& before) noexcept {
  std::swap(virtual_, before.virtual_);
  std::swap(effort_watch_, before.effort_watch_);
  measured_ = before.measured_;
  measured_at_ = before.measured_at_;
  wheels_ = before.wheels_;
  blind_for_ = before.blind_for_;
}

}  // namespace zwang::runtime
