#include "guard/actuator_watch.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

namespace {

/// Cosine above which two wheels push in the same direction.
constexpr double alike = 0.95;

int ticks_of(double time, double period) {
  return std::max(1, static_cast<int>(std::lround(time / period)));
}

}  // namespace

ActuatorWatch::ActuatorWatch(const lang::Robot& robot, double period)
    : part_(1.0 - std::exp(-period / memory)),
      dwell_ticks_(ticks_of(dwell, period)),
      entry_ticks_(ticks_of(entry, period)),
      quiet_ticks_(ticks_of(quiet, period)) {
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const int j = wheel.body - 1;
    const solver::Joint& joint = robot.model.joint(j);
    if (!joint.actuated || !std::isfinite(joint.max_effort)) continue;
    Motor motor;
    motor.joint = j;
    // Where a joint stands, its dry friction may be anything up to its bound, either way.
    const auto i = static_cast<std::size_t>(j);
    const double coulomb = i < robot.friction.size() ? robot.friction[i].coulomb : 0.0;
    motor.threshold = std::max(smallest * joint.max_effort, 2.0 * coulomb);
    motors_.push_back(motor);
  }
}

void ActuatorWatch::reset() noexcept {
  p_p_ = 0.0;
  for (Motor& motor : motors_) motor = Motor{.joint = motor.joint, .threshold = motor.threshold};
}

/// Whether some other wheel pushes in another direction.
bool ActuatorWatch::is_distinct(const Motor& motor, const solver::FreeMotions& motions) const noexcept {
  const auto T = motions.joint.row(motor.joint).head(motions.count);
  return std::any_of(motors_.begin(), motors_.end(), [&](const Motor& other) {
    const auto T_other = motions.joint.row(other.joint).head(motions.count);
    const double along = T.dot(T_other);
    return along * along < alike * alike * T.squaredNorm() * T_other.squaredNorm();
  });
}

std::optional<Event> ActuatorWatch::look(const DisturbanceObserver& observer) noexcept {
  const solver::FreeMotions& motions = observer.motions();
  const int m = motions.count;
  const auto p = observer.force().head(m);
  const auto follow = [this](double& mean, double value) { mean += part_ * (value - mean); };
  follow(p_p_, p.squaredNorm());
  std::optional<Event> found;
  for (Motor& motor : motors_) {
    const auto T = motions.joint.row(motor.joint).head(m);
    const double s = T.squaredNorm();
    if (!(s > 0.0) || !is_distinct(motor, motions)) continue;
    const double u = p.dot(T.transpose());
    const double tau = observer.torque()(motor.joint);
    const double f = u / s;
    follow(motor.u_tau, -u * tau);
    follow(motor.tau_tau_s, tau * tau * s);
    follow(motor.f, f);
    follow(motor.f_f, f * f);
    follow(motor.f_tau, f * tau);
    follow(motor.tau, tau);
    follow(motor.tau_tau, tau * tau);
    follow(motor.explained, u * f);
    follow_onset(motor, motor.threshold * std::sqrt(s), p.norm());
    const EventCode suspicion = suspect(motor);
    motor.ticks = suspicion != EventCode::none && suspicion == motor.suspicion ? motor.ticks + 1 : 0;
    motor.suspicion = suspicion;
    if (motor.ticks == 0 && motor.loud_ticks > entry_ticks_) motor.is_armed = false;
    if (motor.is_armed && motor.ticks >= dwell_ticks_ && !found) {
      found = Event{suspicion, 0.0, event_signal::of_joint(motor.joint, event_signal::tau), motor.f};
    }
  }
  return found;
}

/// A motor is armed by a quiet while, and a force that begins then starts its clock.
void ActuatorWatch::follow_onset(Motor& motor, double threshold, double force) const noexcept {
  if (force > threshold) {
    motor.quiet_ticks = 0;
    ++motor.loud_ticks;
  } else if (++motor.quiet_ticks >= quiet_ticks_) {
    motor.is_armed = true;
    motor.loud_ticks = 0;
  }
}

/// With <> the mean: f = -gamma tau fits best with gamma = <-u tau> / <tau^2 s>, and leaves of <p^2> the part
/// 1 - <-u tau>^2 / (<tau^2 s> <p^2>). A stuck motor's f has the slope -1 over tau.
EventCode ActuatorWatch::suspect(const Motor& m) const noexcept {
  if (!(m.f_f > m.threshold * m.threshold) || !(m.explained > (1.0 - most_unexplained) * p_p_))
    return EventCode::none;
  const bool fits = m.u_tau * m.u_tau > (1.0 - most_unexplained) * m.tau_tau_s * p_p_;
  const double gamma = m.tau_tau_s > 0.0 ? m.u_tau / m.tau_tau_s : 0.0;
  if (fits && std::abs(gamma - 1.0) < off) return EventCode::torque_lost;
  if (fits && std::abs(gamma - 2.0) < off) return EventCode::torque_flipped;
  const double variance = m.tau_tau - m.tau * m.tau;
  const double slope = (m.f_tau - m.f * m.tau) / std::max(variance, 1e-300);
  const bool varies = variance > 0.04 * m.threshold * m.threshold;
  if (varies && std::abs(slope + 1.0) < off) return EventCode::torque_stuck;
  return EventCode::none;
}

}  // namespace zwang::runtime
