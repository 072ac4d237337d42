#include "zwang/runtime/safety_guard.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "estimate/rotation.hpp"
#include "estimate/ticks.hpp"
#include "guard/arm_hold.hpp"
#include "guard/frozen_state.hpp"
#include "guard/joint_limits.hpp"
#include "guard/wheel_brake.hpp"

namespace zwang::runtime {

namespace {

// No position, speed or wrench of a robot is larger; a number that is, is a broken one.
constexpr double largest_plausible = 1e9;
// A clock may count from 1970: this value is the year 2286. A clock that counts milliseconds is beyond it.
constexpr double latest_plausible = 1e10;  // [s]
// A robot that says to be faster than this changes its position within a few ticks, however coarse its
// encoders are.
constexpr double moving_joint = 0.1;  // [rad/s] or [m/s]
constexpr double moving_base = 0.01;  // [m/s]
constexpr int believed_frozen_ticks = 2;
// Rounding in a clock that adds up periods must not count as a lost tick.
constexpr double clock_rounding = 0.5;  // of a period

bool plausible(double x, double largest = largest_plausible) {
  // Written so that NaN fails.
  return std::abs(x) <= largest;
}

template <typename Values>
double first_implausible(const Values& values) {
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (!plausible(values.coeff(i))) return values.coeff(i);
  }
  return 0.0;
}

}  // namespace

const char* to_string(SampleStatus status) noexcept {
  switch (status) {
    case SampleStatus::good:
      return "good";
    case SampleStatus::not_finite:
      return "not finite";
    case SampleStatus::bad_clock:
      return "bad clock";
    case SampleStatus::untimely:
      return "untimely";
  }
  return "?";
}

const char* to_string(GuardStatus status) noexcept {
  switch (status) {
    case GuardStatus::passed:
      return "passed";
    case GuardStatus::limited:
      return "limited";
    case GuardStatus::slewed:
      return "slewed";
    case GuardStatus::held:
      return "held";
    case GuardStatus::stopped:
      return "stopped";
  }
  return "?";
}

int lost_ticks(double period) noexcept {
  constexpr int most = 20, least = 5;
  constexpr double longest = 0.05;  // [s]
  return std::clamp(ticks_of(longest, period), least, most);
}

SafetyGuard::SafetyGuard(const lang::Robot& robot, const GuardSettings& settings)
    : settings_(settings),
      limit_(Eigen::VectorXd::Zero(robot.model.joint_count())),
      step_(Eigen::VectorXd::Constant(limit_.size(), settings.max_slew * settings.period)),
      last_(limit_),
      next_(limit_),
      last_q_(limit_),
      last_qd_(limit_),
      takes_velocity_(robot.drive.takes_velocity),
      arm_(std::make_unique<ArmHold>(robot.model)),
      frozen_(std::make_unique<FrozenState>(limit_.size())),
      brake_(std::make_unique<WheelBrake>(robot, settings.period)) {
  if (!(settings.period > 0.0) || !(settings.max_step >= settings.period) || settings.max_lost_ticks < 1 ||
      !(settings.max_slew > 0.0)) {
    throw std::invalid_argument("safety guard: a setting is not positive, or max_step is below the period");
  }
  const solver::Model& model = robot.model;
  for (int j = 0; j < model.joint_count(); ++j) {
    if (model.joint(j).actuated) limit_(j) = model.joint(j).max_effort;
    if (robot.slew.size() == limit_.size()) step_(j) = std::min(step_(j), robot.slew(j) * settings.period);
  }
  joint_limits_ = std::make_unique<JointLimits>(model, limit_, step_, settings.period);
}

SafetyGuard::~SafetyGuard() = default;
SafetyGuard::SafetyGuard(SafetyGuard&&) noexcept = default;
SafetyGuard& SafetyGuard::operator=(SafetyGuard&&) noexcept = default;

/// When the present tick is, whatever its sample says.
double SafetyGuard::due() const noexcept {
  return has_begun_ ? time() + (lost_ticks_ + 1) * settings_.period : 0.0;
}

bool SafetyGuard::is_timely(double stamp) const noexcept {
  const double step = stamp - last_time_;
  return plausible(stamp, latest_plausible) && (!has_time_ || (step > 0.0 && step <= settings_.max_step));
}

/// The first entry that no robot can have; code `none` when there is none.
Event SafetyGuard::find_bad_entry(const Sensed& sensed) const noexcept {
  using namespace event_signal;
  const solver::State& s = sensed.state;
  const auto joints = static_cast<int>(limit_.size());
  const auto bad = [&](int signal, double value) {
    const double when = is_timely(sensed.time) ? sensed.time + clock_shift_ : due();
    return Event{EventCode::bad_sample, when, signal, value};
  };
  if (!stopped() && !plausible(sensed.time, latest_plausible)) return bad(event_signal::time, sensed.time);
  if (s.q.size() != joints || s.qd.size() != joints || s.tau_ff.size() != joints) {
    return bad(-1, static_cast<double>(s.q.size()));
  }
  if (s.f_ext.size() != static_cast<std::size_t>(joints) + 1)
    return bad(-1, static_cast<double>(s.f_ext.size()));
  for (int j = 0; j < joints; ++j) {
    if (!plausible(s.q(j))) return bad(of_joint(j, q), s.q(j));
    if (!plausible(s.qd(j))) return bad(of_joint(j, qd), s.qd(j));
    if (!plausible(s.tau_ff(j))) return bad(of_joint(j, tau_ff), s.tau_ff(j));
  }
  const auto has_bad = [](const auto& values) { return !plausible(first_implausible(values)); };
  const auto of_matrix = s.base_pose.rotation.reshaped();
  if (has_bad(of_matrix)) return bad(base_pose, first_implausible(of_matrix));
  if (!is_rotation(s.base_pose.rotation)) return bad(base_pose, s.base_pose.rotation.determinant());
  if (has_bad(s.base_pose.position)) return bad(base_pose, first_implausible(s.base_pose.position));
  if (has_bad(s.base_twist.angular)) return bad(base_twist, first_implausible(s.base_twist.angular));
  if (has_bad(s.base_twist.linear)) return bad(base_twist, first_implausible(s.base_twist.linear));
  for (std::size_t body = 0; body < s.f_ext.size(); ++body) {
    const solver::ForceVector& f = s.f_ext[body];
    const int signal = f_ext(joints, static_cast<int>(body));
    if (has_bad(f.angular)) return bad(signal, first_implausible(f.angular));
    if (has_bad(f.linear)) return bad(signal, first_implausible(f.linear));
  }
  return {};
}

SampleStatus SafetyGuard::admit(const Sensed& sensed) noexcept {
  ++counters_.samples;
  if (const Event bad = find_bad_entry(sensed); bad.code != EventCode::none) {
    ++counters_.refused_values;
    refusal_ = bad;
    latch(bad);
    return SampleStatus::not_finite;
  }
  const bool was_stopped = stopped();
  const double step = has_time_ ? sensed.time - last_time_ : 0.0;
  if (step > (settings_.max_lost_ticks + clock_rounding) * settings_.period) {
    latch({EventCode::lost_ticks, sensed.time + clock_shift_, event_signal::time, step});
  }
  if (!is_timely(sensed.time)) return was_stopped ? take_untimely(sensed) : refuse_stamp(sensed);
  stamp_says_nothing_ = false;
  take_stamp(sensed.time);
  take_new_values(sensed, step);
  has_time_ = true;
  return SampleStatus::good;
}

/// Where no sample arrives, the last one is shown again.
bool SafetyGuard::is_shown_again(const Sensed& sensed) const noexcept {
  return sensed.time == last_time_ && sensed.state.q == last_q_ && sensed.state.qd == last_qd_ &&
         sensed.state.base_pose.position == last_position_;
}

/// A few of them are ridden through.
SampleStatus SafetyGuard::refuse_stamp(const Sensed& sensed) noexcept {
  ++counters_.refused_clock;
  const double step = sensed.time - last_time_;
  const bool is_lost = is_shown_again(sensed);
  stamp_says_nothing_ = step == 0.0 && !is_lost;
  const double now = due();
  refusal_ = {is_lost ? EventCode::sample_lost : EventCode::clock_refused, now, event_signal::time,
              sensed.time};
  if (++lost_ticks_ >= settings_.max_lost_ticks) {
    const EventCode reason = step < 0.0            ? EventCode::clock_back
                             : stamp_says_nothing_ ? EventCode::clock_stands
                                                   : EventCode::lost_ticks;
    latch({reason, now, event_signal::time, step});
  }
  // After a jump ahead the clock goes on from there; one that went back may catch up before the stop latches.
  if (step > settings_.max_step) last_time_ = sensed.time;
  return SampleStatus::bad_clock;
}

/// The latched stop brakes by any good values. Once they change under one stamp, the stamp does not tell any
/// more whether a sample has arrived.
SampleStatus SafetyGuard::take_untimely(const Sensed& sensed) noexcept {
  ++counters_.refused_clock;
  if (is_shown_again(sensed) && !stamp_says_nothing_) {
    refusal_ = {EventCode::sample_lost, due(), event_signal::time, sensed.time};
    ++lost_ticks_;
    return SampleStatus::bad_clock;
  }
  refusal_ = {EventCode::clock_refused, due(), event_signal::time, sensed.time};
  stamp_says_nothing_ = sensed.time == last_time_;
  take_stamp(plausible(sensed.time, latest_plausible) ? sensed.time : last_time_);
  take_values(sensed.state, settings_.period);
  return SampleStatus::untimely;
}

void SafetyGuard::take_stamp(double stamp) noexcept {
  if (has_begun_ && stamp + clock_shift_ <= time()) clock_shift_ = due() - stamp;
  last_time_ = stamp;
  has_begun_ = true;
  lost_ticks_ = 0;
}

/// A drive that takes velocities shows a sample until the next one comes.
void SafetyGuard::take_new_values(const Sensed& sensed, double step) noexcept {
  if (!takes_velocity_ || !sensed.measured_at) return take_values(sensed.state, step);
  const double stamp = *sensed.measured_at;
  if (has_time_ && stamp == last_measured_at_) return;
  take_values(sensed.state, has_time_ ? std::max(0.0, stamp - last_measured_at_) : 0.0);
  last_measured_at_ = stamp;
}

/// `step` [s] since the last ones; 0: there are none to compare with.
void SafetyGuard::take_values(const solver::State& state, double step) noexcept {
  const bool moves = state.qd.lpNorm<Eigen::Infinity>() > moving_joint ||
                     state.base_twist.linear.lpNorm<Eigen::Infinity>() > moving_base;
  const bool stands = step > 0.0 && state.q == last_q_ && state.base_pose.position == last_position_;
  frozen_ticks_ = moves && stands ? frozen_ticks_ + 1 : 0;
  if (frozen_ticks_ > 0) ++counters_.frozen;
  if (frozen_ticks_ >= settings_.max_lost_ticks) {
    stop(EventCode::frozen, event_signal::base_pose, state.base_twist.linear.norm());
  }
  frozen_->look(state.q, step);
  if (frozen_->ticks() >= settings_.max_lost_ticks && !last_.isZero(0.0)) {
    stop(EventCode::frozen, event_signal::of_joint(frozen_->joint(), event_signal::q), frozen_->pace());
  }
  last_q_ = state.q;
  last_qd_ = state.qd;
  last_position_ = state.base_pose.position;
}

bool SafetyGuard::is_frozen() const noexcept {
  return frozen_ticks_ > believed_frozen_ticks || frozen_->ticks() > 0;
}

void SafetyGuard::brake(const Sensed& sensed, const Eigen::VectorXd& wanted) noexcept {
  const bool is_sound = wanted.size() == next_.size() && wanted.allFinite();
  next_.setZero();
  if (!brakes_by_model_) {
    if (is_frozen()) {
      brake_->brake_blind(next_);
    } else {
      brake_->brake(sensed.state.qd, next_);
    }
  } else if (is_sound) {
    next_ = wanted;
  }
  if (holds_by_model_ && is_sound) {
    arm_->copy(wanted, next_);
  } else if (is_frozen()) {
    arm_->hold_blind(next_);
  } else {
    arm_->hold(sensed.state, next_);
  }
}

void SafetyGuard::brake_blind() noexcept {
  next_.setZero();
  if (!brakes_by_model_) brake_->brake_blind(next_);
  arm_->hold_blind(next_);
}

void SafetyGuard::clamp_next() noexcept {
  next_ = next_.cwiseMax(-limit_).cwiseMin(limit_);
}

GuardStatus SafetyGuard::output(const Sensed& sensed, const Eigen::VectorXd& wanted,
                                Eigen::VectorXd& tau) noexcept {
  if (!stopped()) {
    // Finite comes before the clamp: clamping a NaN gives a bound, and so full torque.
    Eigen::Index bad = 0;
    while (bad < wanted.size() && std::isfinite(wanted(bad))) ++bad;
    if (wanted.size() != limit_.size()) {
      ++counters_.bad_torques;
      stop(EventCode::bad_torque, -1, static_cast<double>(wanted.size()));
    } else if (bad < wanted.size()) {
      ++counters_.bad_torques;
      stop(EventCode::bad_torque, event_signal::of_joint(static_cast<int>(bad), event_signal::tau),
           wanted(bad));
    }
  }
  if (!stopped()) {
    arm_->take(sensed.state);
    if (const auto beyond = joint_limits_->look(sensed.state, last_, *arm_, sensed.time)) latch(*beyond);
  }
  if (!is_frozen()) brake_->remember(sensed.state);
  if (stopped()) {
    brake(sensed, wanted);
    clamp_next();
    return send(tau, GuardStatus::stopped);
  }
  GuardStatus status = GuardStatus::passed;
  for (Eigen::Index j = 0; j < next_.size(); ++j) {
    next_(j) = std::clamp(wanted(j), -limit_(j), limit_(j));
    if (next_(j) != wanted(j)) status = GuardStatus::limited;
  }
  if (status == GuardStatus::limited) ++counters_.limited;
  return send(tau, status);
}

GuardStatus SafetyGuard::output_blind(Eigen::VectorXd& tau) noexcept {
  if (stopped()) {
    brake_blind();
    clamp_next();
    return send(tau, GuardStatus::stopped);
  }
  next_ = last_;
  return send(tau, GuardStatus::held);
}

GuardStatus SafetyGuard::send(Eigen::VectorXd& tau, GuardStatus status) noexcept {
  bool slewed = false;
  for (Eigen::Index j = 0; j < next_.size(); ++j) {
    const double cut = std::clamp(next_(j), last_(j) - step_(j), last_(j) + step_(j));
    slewed = slewed || cut != next_(j);
    next_(j) = cut;
  }
  if (slewed) {
    ++counters_.slewed;
    if (status == GuardStatus::passed) status = GuardStatus::slewed;
  }
  last_ = next_;
  if (tau.size() == next_.size()) tau = next_;
  return status;
}

void SafetyGuard::stop(EventCode reason, int signal, double value) noexcept {
  latch({reason, has_begun_ ? time() : 0.0, signal, value});
}

void SafetyGuard::latch(const Event& event) noexcept {
  if (stopped() || !latches_the_stop(event.code)) return;
  stop_event_ = event;
  // A motor that is stuck presses on when it is left out; where the others get faster then, it is still that
  // one.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const int joint = event_signal::joint_of(event.signal);
  switch (event.code) {
    case EventCode::torque_stuck:
      brake_->begin(joint, infinity);
      break;
    case EventCode::torque_lost:
    case EventCode::torque_flipped:
      brake_->begin(joint, WheelBrake::fast);
      break;
    case EventCode::runaway:
    case EventCode::wheel_reversed:
      brake_->begin(joint, 0.0);
      break;
    case EventCode::motors_reversed:
      brake_->begin_turned_around();
      break;
    default:
      brake_->begin(-1, 0.0);
  }
}

bool SafetyGuard::motor_obeyed() const noexcept {
  return stopped() && brake_->has_obeyed();
}

void SafetyGuard::reset() noexcept {
  stop_event_ = {};
  brakes_by_model_ = holds_by_model_ = false;
  has_time_ = false;
  lost_ticks_ = 0;
  frozen_ticks_ = 0;
  frozen_->begin();
}

}  // namespace zwang::runtime
