#include "guard/motor_beside_contact.hpp"

#include <algorithm>
#include <cmath>

#include "estimate/ticks.hpp"
#include "guard/wheel_motors.hpp"

namespace zwang::runtime {

namespace {

EventCode kind_of(double gamma) noexcept {
  if (std::abs(gamma - 1.0) < MotorBesideContact::near) return EventCode::torque_lost;
  if (std::abs(gamma - 2.0) < 2.0 * MotorBesideContact::near) return EventCode::torque_flipped;
  return EventCode::torque_stuck;
}

}  // namespace

MotorBesideContact::MotorBesideContact(const lang::Robot& robot, double period)
    : part_(1.0 - std::exp(-period / memory)),
      dwell_ticks_(ticks_of(dwell, period)),
      quiet_ticks_(ticks_of(quiet, period)) {
  const Obedience unseen(ticks_of(DisturbanceObserver::mean_over, period));
  for (const WheelMotor& of : wheel_motors(robot, smallest)) {
    motors_.push_back({.joint = of.joint,
                       .radius = of.radius,
                       .threshold = of.threshold,
                       .T = Vector::Zero(),
                       .since = {},
                       .obedience = unseen});
  }
}

void MotorBesideContact::reset() noexcept {
  forget_means();
  for (Motor& motor : motors_) motor.obedience.reset();
}

void MotorBesideContact::forget_means() noexcept {
  p_p_.setZero();
  share_of_hit_ = 0.0;
  ticks_on_line_ = 0;
  for (Motor& motor : motors_) motor.since = {};
}

/// Coordinates of free motion are any in which the robot is a unit mass; from tick to tick the solver may
/// turn them. T_j goes on as the joints do where it did not.
bool MotorBesideContact::take_directions(const solver::FreeMotions& motions) noexcept {
  double turned = 0.0, all = 0.0;
  for (Motor& motor : motors_) {
    const Vector T = motions.joint.row(motor.joint).head<freedoms>().transpose();
    turned += (T - motor.T).squaredNorm();
    all += T.squaredNorm();
    motor.T = T;
  }
  return turned > another * another * all;
}

/// How much of the comparisons that the observer's means are about came after p had left its line.
double MotorBesideContact::broken_part(const Vector& p, int window) noexcept {
  const Vector next = p_p_ * line_;
  const double length = next.norm();
  if (length > 0.0) line_ = next / length;
  const Motor& motor = motors_.front();
  const double s = motor.T.squaredNorm();
  const double along = p.dot(line_);
  if (p.squaredNorm() - along * along < motor.threshold * motor.threshold * s) {
    ++ticks_on_line_;
  } else {
    if (ticks_on_line_ >= quiet_ticks_) {
      ticks_off_line_ = 0;
      for (Motor& m : motors_) m.since[1] = {};
    }
    ticks_on_line_ = 0;
  }
  ticks_off_line_ = std::min(ticks_off_line_ + 1, window);
  return static_cast<double>(ticks_off_line_) / window;
}

/// The gamma that reduces N most; 0 if N is not nearly gone with it.
///   N1 = 2 tr(P) a.T - 2 a'P T,   N2 = (a.T)^2 + tr(P) b s - |a|^2 s - b T'P T,
///   P = <p p'>, a = <p tau>, b = <tau^2>, s = |T|^2.
double MotorBesideContact::find_gamma(const Since& since, const Motor& motor,
                                      const Vector& T) const noexcept {
  const double trace = trace_;
  const double N0 = off_line_;
  const Vector& a = since.p_tau;
  const double b = since.tau_tau;
  const double s = T.squaredNorm();
  const bool may_be_felt = most_gamma * most_gamma * b > motor.threshold * motor.threshold;
  if (!may_be_felt || !(N0 > visible * least_gamma * least_gamma * b * s * trace)) return 0.0;
  const Vector PT = p_p_ * T;
  const double a_T = a.dot(T);
  const double N1 = 2.0 * (trace * a_T - a.dot(PT));
  const double N2 = a_T * a_T + trace * b * s - a.squaredNorm() * s - b * T.dot(PT);
  if (!(N2 > visible * visible * trace * b * s)) return 0.0;
  const double gamma = -0.5 * N1 / N2;
  if (gamma < least_gamma || gamma > most_gamma) return 0.0;
  // Of a motor that is stuck gamma may be anything: what fits has to fit better.
  const double strictly = kind_of(gamma) == EventCode::torque_stuck ? strict : 1.0;
  const double f_f = gamma * gamma * b;
  const bool is_felt = f_f > strictly * motor.threshold * motor.threshold && N0 > visible * f_f * s * trace;
  const bool explains = strictly * (N0 - 0.25 * N1 * N1 / N2) < left * N0;
  return is_felt && explains ? gamma : 0.0;
}

/// The mean <p p'> fades, and the share of each p with it.
void MotorBesideContact::keep_hardest(const Vector& p, const std::array<double, 2>& parts,
                                      const Eigen::VectorXd& told) noexcept {
  share_of_hit_ *= 1.0 - part_;
  if (p.squaredNorm() < share_of_hit_) return;
  share_of_hit_ = p.squaredNorm();
  hit_ = p;
  for (Motor& motor : motors_) {
    for (std::size_t i = 0; i < parts.size(); ++i) motor.since[i].tau_of_hit = parts[i] * told(motor.joint);
  }
}

/// Whether r = p + gamma tau T is against the r of the hit: the contact beside the motor would pull. What the
/// motor may leave off the line, sqrt(left) of its own share, counts as nothing.
bool MotorBesideContact::pulls(const Since& since, const Motor& motor, const Vector& p, double gamma,
                               double tau) const noexcept {
  const Vector hit = hit_ + gamma * since.tau_of_hit * motor.T;
  const Vector r = p + gamma * tau * motor.T;
  const double nothing = std::sqrt(left) * std::abs(gamma * tau) * motor.T.norm();
  return r.dot(hit) < -nothing * hit.norm();
}

std::optional<Event> MotorBesideContact::look(const DisturbanceObserver& observer, const Eigen::VectorXd& q,
                                              const ContactDepth& contact) noexcept {
  const solver::FreeMotions& motions = observer.motions();
  if (motions.count != freedoms || motors_.empty()) return std::nullopt;
  if (take_directions(motions)) forget_means();
  const Vector p = observer.force().head<freedoms>();
  const std::array parts = {1.0, broken_part(p, observer.window())};
  keep_hardest(p, parts, observer.torque());
  p_p_ += part_ * (p * p.transpose() - p_p_);
  trace_ = p_p_.trace();
  off_line_ = 0.5 * (trace_ * trace_ - p_p_.squaredNorm());
  std::optional<Event> found;
  for (Motor& motor : motors_) {
    const Vector& T = motor.T;
    const double told = observer.torque()(motor.joint);
    motor.obedience.follow(p.dot(T) / T.squaredNorm(), told, motor.threshold);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      Since& since = motor.since[i];
      const double tau = parts[i] * told;
      since.p_tau += part_ * (tau * p - since.p_tau);
      since.tau_tau += part_ * (tau * tau - since.tau_tau);
      const bool is_possible = i > 0 || !motor.obedience.is_seen();
      const double gamma = is_possible ? find_gamma(since, motor, T) : 0.0;
      const bool explains = gamma != 0.0 && !pulls(since, motor, p, gamma, tau);
      since.ticks = explains ? since.ticks + 1 : 0;
      const double at = motor.radius * q(motor.joint);
      if (since.ticks <= 1) {
        since.least = since.most = at;
        since.contact = contact.now();
      }
      since.least = std::min(since.least, at);
      since.most = std::max(since.most, at);
      const bool lasts = since.ticks >= dwell_ticks_ && since.most - since.least > travel;
      if (!lasts || found || !contact.is_no_spring(since.contact)) continue;
      found =
          Event{kind_of(gamma), 0.0, event_signal::of_joint(motor.joint, event_signal::tau), -gamma * tau};
    }
  }
  return found;
}

}  // namespace zwang::runtime
