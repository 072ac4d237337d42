#include "guard/blind_budget.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zwang::runtime {

BlindBudget::BlindBudget(const lang::Robot& robot, BlindMotion::Part part)
    : part_(part), motion_(robot, part), contact_(motion_) {
  const auto n = static_cast<Eigen::Index>(motion_.joints().size());
  q_ = rates_ = mean_ = change_ = now_ = v_ = found_ = lean_ = Eigen::VectorXd::Zero(n);
  y_ = p_ = told_ = Eigen::VectorXd::Zero(motion_.most_freedoms());
  double radius = 0.0;
  for (const BlindMotion::DrivenJoint& driven : motion_.joints()) radius = std::max(radius, driven.radius);
  if (robot.encoder_step > 0.0) rim_step_ = radius * robot.encoder_step;
}

void BlindBudget::remember(const Eigen::VectorXd& q) noexcept {
  for (Eigen::Index i = 0; i < q_.size(); ++i) q_(i) = q(motion_.joints()[static_cast<std::size_t>(i)].joint);
}

void BlindBudget::begin(const Eigen::VectorXd& q) noexcept {
  remember(q);
  rates_.setZero();
  mean_.setZero();
  change_.setZero();
  v_.setZero();
  lean_.setZero();
  gap_ = s_ = asked_for_ = 0.0;
  phase_ = Phase::counts;
  contact_.forget();
  contact_.untie();
  has_last_ = true;
  has_rates_ = false;
}

void BlindBudget::tie(double x, double y, bool is_to_move) noexcept {
  is_to_move_ = is_to_move;
  if (phase_ == Phase::counts) contact_.tie(x, y);
}

double BlindBudget::budget() const noexcept {
  const bool is_arm = part_ == BlindMotion::Part::arm;
  const double least = is_arm ? least_arm_budget : least_budget;
  return std::isfinite(rim_step_) ? std::max(least, (is_arm ? arm_steps : steps) * rim_step_) : least;
}

/// Whether this is a sign of life. Then `now_` has the rates since the last one, and `q_` the new positions.
bool BlindBudget::take_steps(const Eigen::VectorXd& q) noexcept {
  bool is_alive = false;
  for (Eigen::Index i = 0; i < q_.size(); ++i) {
    const BlindMotion::DrivenJoint& driven = motion_.joints()[static_cast<std::size_t>(i)];
    double step = q(driven.joint) - q_(i);
    if (driven.turns_on && std::abs(step) > std::numbers::pi)
      step = std::remainder(step, 2.0 * std::numbers::pi);
    now_(i) = step / gap_;
    if (driven.radius <= 0.0 || std::abs(step) < least_change) continue;
    is_alive = true;
    rim_step_ = std::min(rim_step_, driven.radius * std::abs(step));
  }
  if (is_alive) remember(q);
  return is_alive;
}

/// p and `told_` of the rates up to two signs of life, and of what the motors were told between them.
void BlindBudget::feel() noexcept {
  change_ /= gap_;
  motion_.to_motions(change_, told_);
  rates_ = (now_ - rates_) / gap_ - change_;
  motion_.to_motions(rates_, p_);
}

void BlindBudget::learn() noexcept {
  const double step = std::isfinite(rim_step_) ? rim_step_ : 0.0;
  if (has_rates_) {
    feel();
    contact_.learn(motion_, p_, told_, gap_, step);
  } else {
    contact_.set_out(gap_, step);
  }
  if (way_from_the_found() > near * budget()) contact_.leave();
  has_rates_ = true;
  const double low_pass = part_ == BlindMotion::Part::arm ? arm_low_pass : rate_low_pass;
  mean_ += (1.0 - std::exp(-gap_ / low_pass)) * (now_ - mean_);
  set_out_from(mean_);
}

void BlindBudget::set_out_from(const Eigen::VectorXd& rates) noexcept {
  for (Eigen::Index i = 0; i < v_.size(); ++i) {
    const double radius = motion_.joints()[static_cast<std::size_t>(i)].radius;
    const double less = radius > 0.0 ? slowest / radius : 0.0;
    v_(i) = std::copysign(std::max(0.0, std::abs(rates(i)) - less), rates(i));
  }
  rates_ = now_;
  change_.setZero();
  lean_.setZero();
  gap_ = s_ = asked_for_ = 0.0;
}

/// How far a rim is from where a look was answered.
double BlindBudget::way_from_the_found() const noexcept {
  double most = 0.0;
  for (Eigen::Index i = 0; i < q_.size(); ++i)
    most = std::max(most, motion_.joints()[static_cast<std::size_t>(i)].radius * std::abs(q_(i) - found_(i)));
  return most;
}

double BlindBudget::rim_speed(const Eigen::VectorXd& rates) noexcept {
  double most = 0.0;
  for (Eigen::Index i = 0; i < rates.size(); ++i) {
    const BlindMotion::DrivenJoint& driven = motion_.joints()[static_cast<std::size_t>(i)];
    const double speed = driven.radius * std::abs(rates(i));
    if (speed > most) fastest_ = driven.joint;
    most = std::max(most, speed);
  }
  return most;
}

Event BlindBudget::event(EventCode code) const noexcept {
  return {code, time_, event_signal::of_joint(fastest_, event_signal::q), s_};
}

std::optional<Event> BlindBudget::look(const Eigen::VectorXd& q, double time) noexcept {
  if (motion_.is_empty()) return std::nullopt;
  const double dt = time - time_;
  const bool goes_on = has_last_ && dt > 0.0 && dt <= longest;
  time_ = time;
  if (!goes_on) begin(q);
  if (!goes_on || motion_.freedoms() == 0) return std::nullopt;
  gap_ += dt;
  motion_.to_rates(motion_.acceleration(), now_);
  change_ += dt * now_;
  const bool is_alive = take_steps(q);
  if (phase_ != Phase::counts) return wait_for_an_answer(is_alive, dt);
  if (is_alive) {
    learn();
    return std::nullopt;
  }
  return spend(dt);
}

bool BlindBudget::leans() noexcept {
  return !is_excused() && rim_speed(lean_) > slowest;
}

std::optional<Event> BlindBudget::spend(double dt) noexcept {
  const int n = motion_.freedoms();
  motion_.to_motions(v_, y_);
  told_.head(n) = y_.head(n) + dt * motion_.acceleration().head(n);
  contact_.step(motion_, dt, y_);
  motion_.keep_in_travel(y_);
  told_.head(n) -= y_.head(n);
  motion_.to_rates(told_, now_);
  lean_ += now_;
  motion_.to_rates(y_, v_);
  const double speed = rim_speed(v_);
  // An arm that is held stands although the model's coasts on.
  const double harmless = part_ == BlindMotion::Part::arm ? slowest : 0.0;
  s_ += std::max(0.0, speed - harmless) * dt;
  if (s_ > budget()) {
    motion_.to_rates(motion_.acceleration(), now_);
    begin_look(speed, rim_speed(now_));
  } else {
    ask_the_contact(dt);
  }
  return std::nullopt;
}

void BlindBudget::doubt() noexcept {
  if (phase_ != Phase::counts || gap_ < ridden_through || motion_.freedoms() == 0) return;
  begin_look(std::max(rim_speed(v_), comes_off), 0.0);
}

/// `v_` is to be given back. `acceleration` [m/s^2] at a rim of what pressed.
void BlindBudget::begin_look(double speed, double acceleration) noexcept {
  const double way = std::isfinite(rim_step_) ? std::max(least_look, steps * rim_step_) : least_look;
  time_constant_ = std::max(quickest_look, way / speed);
  gives_ = true;
  looked_for_ = waited_for_ = 0.0;
  answers_ = 0;
  is_fast_ = speed > look_below;
  motion_.to_motions(v_, y_);
  spent_ = y_.head(motion_.freedoms()).norm();
  phase_ = Phase::looks;
  patience_ = answers_within + time_of_counts(acceleration);
}

/// If the contact went away with the last sign of life, the base goes as fast as `lean_` by now. Beyond
/// `most_lean` the press slackens, and a contact that is there moves the wheels. If none counts, the base
/// is to come off it. A free base gains, at the acceleration a of the press,
///   most_lean + a integral of 1 - (t / T)^2 dt = most_lean + 2/3 a T.
void BlindBudget::ask_the_contact(double dt) noexcept {
  const double lean = rim_speed(lean_);
  if (is_excused()) asked_for_ = 0.0;  // it may give less than a count
  if (is_excused() || (!asks() && lean <= most_lean)) return;
  asked_for_ += dt;
  if (asked_for_ <= slackens_for) return;
  v_ = lean_ * (comes_off / lean);
  begin_look(comes_off, lean / gap_);
}

void BlindBudget::slacken(Eigen::VectorXd& tau) const noexcept {
  // The slower it begins, the less a stiff contact rings: a count of d needs K d r of the force.
  const double share = std::max(0.0, 1.0 - std::pow(asked_for_ / slackens_for, 2.0));
  for (const BlindMotion::DrivenJoint& driven : motion_.joints()) {
    if (driven.radius > 0.0) tau(driven.joint) *= share;
  }
}

/// The time [s] in which a released contact moves a rim by as many counts as make an answer. `acceleration`
/// [m/s^2] is the one of the force that pressed the contact.
double BlindBudget::time_of_counts(double acceleration) const noexcept {
  if (!std::isfinite(rim_step_) || !(acceleration > 0.0)) return 0.0;
  return std::min(longest_count, std::sqrt(2.0 * (signs_of_life + 1) * rim_step_ / acceleration));
}

/// While the motors give back what the model says: it is of a base that nothing holds.
std::optional<Event> BlindBudget::wait_for_an_answer(bool is_alive, double dt) noexcept {
  if (is_alive && answers_ == 0) {
    feel();
    if (gap_ * p_.head(motion_.freedoms()).norm() > held * spent_) contact_.find(motion_, p_);
  }
  if (is_alive && ++answers_ >= signs_of_life) {
    const Event told = event(EventCode::probed);
    found_ = q_;
    phase_ = Phase::counts;
    mean_ = now_;
    if (!is_fast_) mean_.setZero();
    set_out_from(mean_);
    return told;
  }
  if (is_alive) {
    rates_ = now_;
    change_.setZero();
    gap_ = 0.0;
  }
  motion_.to_motions(v_, y_);
  y_.head(motion_.freedoms()) += dt * motion_.acceleration().head(motion_.freedoms());
  motion_.to_rates(y_, v_);
  looked_for_ += dt;
  if (phase_ == Phase::looks && looked_for_ > longest_look) gives_ = false;
  waited_for_ = gives_ ? 0.0 : waited_for_ + dt;
  const bool is_over = is_fast_ ? looked_for_ >= ridden_through : waited_for_ >= patience_;
  if (is_blind() || !is_over) return std::nullopt;
  phase_ = Phase::blind;
  answers_ = 0;
  contact_.leave();
  return event(EventCode::frozen);
}

void BlindBudget::give_back(Eigen::VectorXd& tau) noexcept {
  if (!gives_) v_.setZero();
  motion_.to_motions(v_, y_);
  gives_ = motion_.to_stop(y_, time_constant_, tau);
}

}  // namespace zwang::runtime
