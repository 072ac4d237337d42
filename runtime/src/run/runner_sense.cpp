// The state of the robot, before it is judged or used by a task.
#include "run/runner_parts.hpp"

namespace zwang::runtime {

namespace {

/// On the floor, whose normal is the world's z: roll and pitch of the body on its springs are no slope that
/// it could roll down.
solver::Pose level(const solver::Pose& pose) {
  const double yaw = solver::yaw_of(pose.rotation);
  return {Eigen::AngleAxisd(yaw, solver::Vector3::UnitZ()).toRotationMatrix(), pose.position};
}

}  // namespace

void Runner::Parts::estimate(const Sensed& sensed) noexcept {
  const double time = guard.time();
  estimated.time = time;
  estimated.state = sensed.state;
  if (drive) return estimate_between_samples(sensed);
  stop(rates.look(estimated.state, time));
  const auto dead_wheel = frozen_wheel.look(estimated.state, tau, time);
  is_a_wheel_dead = guard.stopped() ? is_a_wheel_dead : dead_wheel.has_value();
  stop(dead_wheel);
  take_signals(sensed);
  confirm();
  if (guard.stopped()) mend_rates();
  estimate_base(sensed, time);
}

double Runner::Parts::measured_at(const Sensed& sensed) const noexcept {
  const double now = guard.time();
  if (!sensed.measured_at) return now;
  const double stamp = *sensed.measured_at + guard.clock_shift();
  return stamp <= now + 0.5 * period ? stamp : -std::numeric_limits<double>::infinity();
}

void Runner::Parts::estimate_between_samples(const Sensed& sensed) noexcept {
  const double stamp = measured_at(sensed);
  is_new_sample = drive->is_new(stamp) && drive->can_feel(sensed);
  if (is_new_sample) {
    stop(rates.look(estimated.state, stamp));
    const auto dead_wheel = frozen_wheel.look(estimated.state, unknown_torque, stamp);
    is_a_wheel_dead = guard.stopped() ? is_a_wheel_dead : dead_wheel.has_value();
    stop(dead_wheel);
    if (guard.stopped()) mend_rates();
    estimate_base(sensed, stamp);
    stop(drive->look(estimated.state, stamp));
    look_at_efforts(sensed, stamp);
    drive->take(estimated.state, stamp);
    drive->feel(sensed, stamp);
  } else {
    stop(drive->look_for_samples(estimated.time));
  }
  take_signals(sensed);
  drive->carry_on(estimated.time, estimated.state);
  if (drive->has_virtual_robot()) drive->put_virtual(estimated.time, guard.stopped(), estimated.state);
}

void Runner::Parts::look_at_efforts(const Sensed& sensed, double stamp) noexcept {
  EffortWatch* watch = drive->effort_watch();
  if (watch == nullptr || guard.stopped()) return;
  stop(watch->look(sensed, stamp));
  if (const auto found = watch->look_at_limits(stamp)) tell(*found);
}

void Runner::Parts::estimate_base(const Sensed& sensed, double time) noexcept {
  solver::Pose& base = estimated.state.base_pose;
  const bool is_new = sensed.base_measured || !reckoning;
  if (is_new && model.base_type() == solver::BaseType::ground) base = level(base);
  if (sensed.base_measured) {
    reckoning = false;
    return;
  }
  if (!reckoning) odometry.start_at(base);
  reckoning = true;
  if (sensed.base_fix) {
    const double stamp = sensed.base_fix->stamp + guard.clock_shift();
    // A fix that is stamped ahead must not keep out the later ones.
    if (stamp > last_fix && stamp <= time + 0.5 * period) {
      last_fix = stamp;
      odometry.correct(last_fix, sensed.base_fix->pose);
    }
  }
  odometry.update(time, estimated.state);
}

/// A snapshot of another size was not laid out for these signals: no sample has come.
void Runner::Parts::take_signals(const Sensed& sensed) noexcept {
  sample.time = guard.time();
  if (sensed.signals.size() != snapshot.size()) {
    for (SignalSample& nothing : sample.signals) nothing.valid = false;
    return;
  }
  for (std::size_t i = 0; i < sample.signals.size(); ++i) {
    sample.signals[i] = sensed.signals[snapshot.places()[i]];
    sample.signals[i].stamp += guard.clock_shift();
  }
}

/// A stop for rates that are wrong is over when the base stands by those that are not.
void Runner::Parts::mend_rates() noexcept {
  Eigen::VectorXd& qd = estimated.state.qd;
  if (guard.reason() == EventCode::rate_contradicts) rates.mend(qd);
  if (guard.reason() != EventCode::wheel_reversed) return;
  const int joint = event_signal::joint_of(guard.stop_event().signal);
  qd(joint) = -qd(joint);
}

}  // namespace zwang::runtime
