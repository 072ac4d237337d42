#include "guard/actuator_watch.hpp"

#include <algorithm>
#include <cmath>

#include "estimate/ticks.hpp"
#include "guard/wheel_motors.hpp"

namespace zwang::runtime {

namespace {

/// Cosine above which two wheels push in the same direction.
constexpr double alike = 0.95;

constexpr std::array codes = {EventCode::torque_lost, EventCode::torque_flipped, EventCode::torque_stuck};

}  // namespace

ActuatorWatch::ActuatorWatch(const lang::Robot& robot, double period)
    : dwell_ticks_(ticks_of(dwell, period)),
      entry_ticks_(ticks_of(entry, period)),
      quiet_ticks_(ticks_of(quiet, period)),
      close_ticks_(ticks_of(close_dwell, period)),
      turning_ticks_(ticks_of(turning, period)),
      after_a_hit_ticks_(ticks_of(after_a_hit, period)) {
  for (const WheelMotor& of : wheel_motors(robot, smallest)) {
    motors_.push_back({.joint = of.joint,
                       .radius = of.radius,
                       .threshold = of.threshold,
                       .ticks_since_hit = after_a_hit_ticks_,
                       .obedience = Obedience(ticks_of(DisturbanceObserver::mean_over, period))});
  }
}

void ActuatorWatch::reset() noexcept {
  for (Motor& motor : motors_) {
    motor.obedience.reset();
    motor = {.joint = motor.joint,
             .radius = motor.radius,
             .threshold = motor.threshold,
             .ticks_since_hit = after_a_hit_ticks_,
             .obedience = motor.obedience};
  }
}

/// Whether some other wheel pushes in another direction.
bool ActuatorWatch::is_distinct(const Motor& motor, const solver::FreeMotions& motions) const noexcept {
  const auto T = motions.joint.row(motor.joint).head(motions.count);
  return std::any_of(motors_.begin(), motors_.end(), [&](const Motor& other) {
    const auto T_other = motions.joint.row(other.joint).head(motions.count);
    const double common = T.dot(T_other);
    return common * common < alike * alike * T.squaredNorm() * T_other.squaredNorm();
  });
}

std::optional<Event> ActuatorWatch::look(const DisturbanceObserver& observer, const Eigen::VectorXd& q,
                                         const ContactDepth& contact) noexcept {
  const solver::FreeMotions& motions = observer.motions();
  const int m = motions.count;
  const auto p = observer.force().head(m);
  const double all = p.squaredNorm();
  std::optional<Kind> sure;
  for (Motor& motor : motors_) {
    const auto T = motions.joint.row(motor.joint).head(m);
    const double s = T.squaredNorm();
    if (!(s > 0.0)) continue;
    const double u = p.dot(T.transpose());
    const Fit fit{
        .f = u / s, .tau = observer.torque()(motor.joint), .s = s, .rest = all - u * u / s, .all = all};
    motor.f = fit.f;
    motor.obedience.follow(fit.f, fit.tau, motor.threshold);
    follow_onset(motor, fit);
    const double at = q(motor.joint);
    follow(motor, lost, fit, -fit.tau, off * std::abs(fit.tau), at, contact);
    follow(motor, flipped, fit, -2.0 * fit.tau, off * std::abs(fit.tau), at, contact);
    follow_stuck(motor, fit, at, contact);
    const bool is_suspected = std::any_of(motor.claims.begin(), motor.claims.end(), [&](const Claim& claim) {
      return claim.ticks > motor.loud_ticks - entry_ticks_;
    });
    if (!is_suspected) motor.is_armed = false;
    for (std::size_t kind = 0; kind < kind_count && !sure; ++kind) {
      if (is_sure(motor, static_cast<Kind>(kind), fit, at, contact) && is_distinct(motor, motions))
        sure = static_cast<Kind>(kind);
    }
  }
  if (!sure) return std::nullopt;
  // Wheels that push alike are suspected together: it is the one that explains most.
  const Motor* best = nullptr;
  for (const Motor& motor : motors_) {
    const Claim& claim = motor.claims[*sure];
    if (claim.ticks > 0 && (best == nullptr || claim.left < best->claims[*sure].left)) best = &motor;
  }
  if (best == nullptr) return std::nullopt;
  return Event{codes[*sure], 0.0, event_signal::of_joint(best->joint, event_signal::tau), best->f};
}

/// [m] that the force drove the robot, as a rim of the wheel would: P = f qd_j of a motor; 0 where a spring
/// as deep explains it. A way against the force says nothing: a padded wall that is hit damps at once, and
/// goes on as a spring, so evenly as a command grows.
double ActuatorWatch::way_of(const Motor& motor, const Fit& fit, const ContactDepth::Mark& since,
                             const ContactDepth& contact) noexcept {
  if (!contact.is_no_spring(since)) return 0.0;
  return std::max(0.0, contact.now().way - since.way) * std::sqrt(fit.s) * motor.radius;
}

/// Out of quiet, or closely, while the wheel rolls. A stuck motor needs a command that varies, and twice the
/// time to tell its steady torque from one that only changes slowly.
bool ActuatorWatch::is_sure(const Motor& motor, Kind kind, const Fit& fit, double q,
                            const ContactDepth& contact) const noexcept {
  const Claim& claim = motor.claims[kind];
  if (claim.ticks < dwell_ticks_ && claim.close_ticks < close_ticks_) return false;
  const double told = motor.high_tau - motor.low_tau;
  if (motor.is_met && motor.hardest < left_behind * std::abs(fit.f)) return false;
  if (kind == stuck && !(told > varied * std::abs(fit.f))) return false;
  const bool is_even = motor.is_armed && claim.ticks >= dwell_ticks_;
  const double least = std::max(least_way, own_way * motor.radius * std::abs(q - claim.q));
  const bool drives =
      way_of(motor, fit, claim.contact, contact) > least && contact.goes_along(claim.contact, along);
  if (is_even && (claim.is_apart || drives)) return true;
  const bool has_rolled = std::abs(q - claim.close_q) * motor.radius > travel;
  const bool has_turned = claim.along_ticks - claim.close_ticks > turning_ticks_;
  if (motor.obedience.is_seen() || has_turned || !has_rolled || !contact.is_no_spring(claim.close_contact) ||
      !contact.goes_along(claim.close_contact, along))
    return false;
  if (kind != stuck) return claim.close_ticks >= close_ticks_;
  const bool is_steady = motor.high_sum - motor.low_sum < closely * told;
  return std::min(claim.ticks, claim.close_ticks) >= 2 * close_ticks_ && is_steady;
}

/// A motor is armed by a quiet while, and a force that begins then starts its clock. No fault of this motor
/// begins with more than its command, one way and the other: |f| <= 2 max|tau|.
void ActuatorWatch::follow_onset(Motor& motor, const Fit& fit) const noexcept {
  const double force = std::sqrt(fit.all / fit.s);
  const double told = std::abs(fit.tau);
  motor.ticks_since_hit = std::min(motor.ticks_since_hit + 1, after_a_hit_ticks_);
  if (force > motor.threshold) {
    motor.quiet_ticks = 0;
    ++motor.loud_ticks;
    motor.told = std::max(motor.told, told);
    motor.hardest = std::max(motor.hardest, force);
    const bool is_hit = force > most_told * motor.told + motor.threshold;
    if (is_hit || motor.is_met) motor.ticks_since_hit = 0;
    const bool begins = motor.is_armed && motor.loud_ticks <= entry_ticks_;
    if (begins && is_hit) {
      motor.is_met = true;
      motor.is_armed = false;
    }
  } else if (++motor.quiet_ticks >= quiet_ticks_) {
    motor.is_armed = true;
    motor.is_met = false;
    motor.loud_ticks = 0;
    motor.told = told;
    motor.hardest = 0.0;
  }
}

/// A force T_j f, expected of a motor, leaves of p: |p - T_j f|^2 = |p - T_j f_p|^2 + |T_j|^2 (f - f_p)^2.
void ActuatorWatch::follow(Motor& motor, Kind kind, const Fit& fit, double f, double slack, double q,
                           const ContactDepth& contact) const noexcept {
  Claim& claim = motor.claims[kind];
  const bool is_felt = std::abs(fit.f) > motor.threshold;
  const bool fits = is_felt && fit.rest < most_unexplained * fit.all && std::abs(f - fit.f) < slack;
  const double share = kind == stuck ? 1.0 : fit.f / f;
  const bool keeps = claim.ticks > 0 && std::abs(share - claim.share) < closely * claim.share;
  if (!keeps) {
    claim = {.along_ticks = claim.along_ticks,
             .close_ticks = claim.close_ticks,
             .close_q = claim.close_q,
             .close_contact = claim.close_contact,
             .share = share};
  }
  claim.ticks = fits ? claim.ticks + 1 : 0;
  claim.along_ticks = is_felt && fit.rest < most_unexplained * fit.all ? claim.along_ticks + 1 : 0;
  if (claim.ticks <= 1) {
    claim.contact = contact.now();
    claim.q = q;
    claim.is_apart = motor.ticks_since_hit >= after_a_hit_ticks_;
  }
  const double left = fit.rest + fit.s * (f - fit.f) * (f - fit.f);
  claim.left = left;
  const bool is_close = std::abs(fit.f) > late * motor.threshold && left < closely * closely * fit.all;
  claim.close_ticks = is_close ? claim.close_ticks + 1 : 0;
  if (claim.close_ticks <= 1) {
    claim.close_q = q;
    claim.close_contact = contact.now();
  }
}

/// Its torque, tau + f, stays the same while the command changes.
void ActuatorWatch::follow_stuck(Motor& motor, const Fit& fit, double q,
                                 const ContactDepth& contact) const noexcept {
  const Claim& claim = motor.claims[stuck];
  const double sum = fit.tau + fit.f;
  if (claim.ticks == 0) {
    motor.low_tau = motor.high_tau = fit.tau;
    motor.low_sum = motor.high_sum = sum;
  }
  motor.low_tau = std::min(motor.low_tau, fit.tau);
  motor.high_tau = std::max(motor.high_tau, fit.tau);
  motor.low_sum = std::min(motor.low_sum, sum);
  motor.high_sum = std::max(motor.high_sum, sum);
  const double middle = 0.5 * (motor.low_sum + motor.high_sum);
  const double varied_sum = motor.high_sum - motor.low_sum;
  const double told = motor.high_tau - motor.low_tau;
  const bool is_constant = varied_sum < std::max(off * told, 0.5 * closely * std::abs(fit.f));
  const double slack = is_constant ? solver::infinity : -1.0;
  follow(motor, stuck, fit, middle - fit.tau, slack, q, contact);
}

}  // namespace zwang::runtime
