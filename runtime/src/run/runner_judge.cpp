// Compares the robot with the program's description: clock, encoders, motors, sensors. A difference is
// reported, or stops the robot.
#include <cmath>

#include "run/runner_parts.hpp"

namespace zwang::runtime {

namespace {

constexpr double start_window = 0.05;     // [s] in which a force sensor that touches nothing is judged
constexpr double longest_silence = 0.02;  // [s] of all encoders, for which motors are judged
constexpr double quiet_sensor = 5.0;      // [N] that it may read then

}  // namespace

void Runner::Parts::judge_clock(const Sensed& sensed) noexcept {
  if (guard.stopped()) return clock_rate.begin();
  const auto found = clock_rate.look(sensed.time);
  if (found && latches_the_stop(found->code)) {
    guard.stop(found->code, found->signal, found->value);
  } else if (found) {
    tell(*found);
  }
}

void Runner::Parts::confirm() noexcept {
  for (BlindBudget* budget : {&blind_budget, &blind_arm}) {
    if (budget->is_blind() && !guard.stopped()) budget->begin();  // the stop was reset
  }
  hook_latch.look(sample, scheduler.parameters(), scheduler.asks_for_motion(), blind_budget);
  confirm(blind_budget, blind_arm);
  confirm(blind_arm, blind_budget);
  guard.brake_by_model(blind_budget.takes_over(), blind_arm.takes_over());
}

void Runner::Parts::confirm(BlindBudget& part, BlindBudget& other) noexcept {
  const std::optional<Event> found = part.look(estimated.state.q, estimated.time);
  if (!found) return;
  if (found->code == EventCode::probed) tell(*found);
  if (found->code == EventCode::frozen) other.doubt();
  stop(found);
}

void Runner::Parts::compare(const solver::State& measured) noexcept {
  if (const auto begins = slip.look(measured, sample.state, sample.time)) tell(*begins);
  if (!slip.doubtful()) {
    signs.roll(solver, measured, sample.state, reckoning, sample.time);
  } else {
    stop(signs.look(solver, measured, sample.state, reckoning, sample.time));
  }
  if (!disturbance.compare(sample.state, sample.time)) {
    motors.reset();
    return;
  }
  scheduler.estimate_force(disturbance.base_force());
  scheduler.estimate_wrenches(disturbance.motions(), disturbance.force(), period);
  // A wheel that slides gives the ground less than its motor gives the wheel. Without encoder counts there is
  // no evidence about a motor.
  if (slip.doubtful() || blind_budget.takes_over() || blind_arm.takes_over()) {
    motors.reset();
    return;
  }
  const auto found = motors.look(disturbance, sample.state, tau, scheduler.constraints(), blends());
  // All motors look lost to encoders that count nothing. The blind budget says which of the two it is.
  const bool is_of_a_motor = found && found->code != EventCode::runaway;
  if (!is_of_a_motor || blind_budget.silent_for() < longest_silence) stop(found);
}

/// A force that is measured before anything moved is the sensor's own.
void Runner::Parts::judge_sensors() noexcept {
  const double time = estimated.time;
  if (!start) start = time;
  if (time - *start > start_window) return;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    const SignalSample& measured = sample.signals[i];
    if (is_judged[i] || !measured.valid) continue;
    is_judged[i] = true;
    double reads = 0.0;
    if (signals[i].type == lang::SignalType::wrench) reads = measured.wrench.linear.norm();
    if (signals[i].measures_force) reads = measured.number;
    if (!(std::abs(reads) > quiet_sensor)) continue;
    tell({EventCode::sensor_bias, time, event_signal::measured(model.joint_count(), static_cast<int>(i)),
          reads});
  }
}

void Runner::Parts::judge_snapshot(const Sensed& sensed) noexcept {
  if (const auto refused = signal_watch.look(sensed, snapshot.size(), sample)) tell(*refused);
}

/// Behind `estimate`, which knows the speed that a hit may have.
void Runner::Parts::judge_wrenches() noexcept {
  const auto found = wrench_bound.look(estimated.state, sample.signals, estimated.time);
  if (!found) return;
  tell(*found);
  if (wrench_bound.is_due()) guard.stop(found->code, found->signal, found->value);
}

/// Under a clock of another rate all that is computed with dt is wrong, and accuses motors and encoders.
void Runner::Parts::stop(const std::optional<Event>& found) noexcept {
  if (!found) return;
  if (clock_rate.is_off()) return guard.stop(EventCode::clock_rate, event_signal::time, clock_rate.rate());
  guard.stop(found->code, found->signal, found->value);
}

void Runner::Parts::tell(const Event& told) noexcept {
  ++event_count;
  if (events.size() < events.capacity()) events.push_back(told);
  const bool is_stop = latches_the_stop(told.code);
  if (event.code == EventCode::none || is_stop) event = told;
}

/// Samples that are refused one after the other for one reason are one event.
void Runner::Parts::tell_refusal(SampleStatus status) noexcept {
  const EventCode refusal = status == SampleStatus::bad_clock ? guard.refusal().code : EventCode::none;
  if (refusal != EventCode::none && refusal != told_refusal) tell(guard.refusal());
  told_refusal = refusal;
}

void Runner::Parts::tell_of_host() noexcept {
  if (told_by_host.code == EventCode::none) return;
  tell({told_by_host.code, guard.time(), told_by_host.signal, told_by_host.value});
  told_by_host = {};
}

void Runner::Parts::tell_excursion() noexcept {
  const std::optional<Excursion>& excursion = scheduler.excursion();
  if (!excursion) return;
  const int row = statements.id(excursion->origin);
  tell({EventCode::outside, sample.time,
        event_signal::of_row(model.joint_count(), static_cast<int>(signals.size()), row),
        excursion->distance});
}

/// The longest time of a stop is over.
void Runner::Parts::tell_doubt(double time) noexcept {
  tell({EventCode::not_at_rest, time, event_signal::base_twist, estimated.state.base_twist.linear.norm()});
}

}  // namespace zwang::runtime
