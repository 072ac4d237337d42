// One program in the place of another, while the robot moves.
#include <algorithm>

#include "run/runner_parts.hpp"

namespace zwang::runtime {

bool Runner::Parts::has_the_joints_of(const Parts& other) const noexcept {
  if (!model.has_joints_of(other.model)) return false;
  if (drive.has_value() != other.drive.has_value()) return false;
  return !drive || drive->has_virtual_robot() == other.drive->has_virtual_robot();
}

/// Their signals are those of the program that runs now.
void Runner::Parts::take_events_of(Parts& before) noexcept {
  events.swap(before.events);
  std::swap(event_count, before.event_count);
  for (Event& told : events) {
    const auto was = static_cast<std::size_t>(told.signal);
    if (told.signal < 0 || was >= before.signal_words.size()) continue;
    const auto now = std::find(signal_words.begin(), signal_words.end(), before.signal_words[was]);
    told.signal = now == signal_words.end() ? -1 : static_cast<int>(now - signal_words.begin());
  }
}

/// Takes over the last command to the motors; outputs are each program's own.
void Runner::Parts::take_motion_of(const Command& before) noexcept {
  command.torque = before.torque;
  command.velocity = before.velocity;
  command.lower = before.lower;
  command.upper = before.upper;
  command.twist = before.twist;
}

/// Outputs of the same name stay as they are: a gripper does not open because a file was saved.
void Runner::Parts::take_outputs_of(const Parts& before) noexcept {
  for (std::size_t i = 0; i < output_names.size(); ++i) {
    const auto was = std::ranges::find(before.output_names, output_names[i]);
    if (was == before.output_names.end()) continue;
    const auto k = static_cast<std::size_t>(was - before.output_names.begin());
    scheduler.set_output(static_cast<int>(i), before.scheduler.outputs()[k]);
  }
}

SwapResult Runner::swap_program(Runner& next) noexcept {
  if (parts_->guard.stopped()) return {SwapRefusal::stopped};
  if (next.parts_->scheduler.task() >= 0) return {SwapRefusal::has_run};
  if (!next.parts_->has_the_joints_of(*parts_)) return {SwapRefusal::joints};
  if (next.parts_->period != parts_->period) return {SwapRefusal::period};
  const SwapResult matched = next.parts_->snapshot.match(parts_->snapshot);
  if (!matched) return matched;
  std::swap(parts_, next.parts_);
  Parts& now = *parts_;
  Parts& before = *next.parts_;
  std::swap(now.guard, before.guard);
  std::swap(now.odometry, before.odometry);
  std::swap(now.told_by_host, before.told_by_host);
  std::swap(now.clock_rate, before.clock_rate);
  std::swap(now.rates, before.rates);
  std::swap(now.frozen_wheel, before.frozen_wheel);
  std::swap(now.blind_budget, before.blind_budget);
  std::swap(now.blind_arm, before.blind_arm);
  now.hook_latch.take_over(before.hook_latch);
  std::swap(now.slip, before.slip);
  std::swap(now.friction, before.friction);
  now.reckoning = before.reckoning;
  now.last_fix = before.last_fix;
  now.start = before.start;
  now.take_events_of(before);
  now.wrench_bound.go_on_from(before.wrench_bound);
  now.snapshot.go_on_from(before.snapshot);
  now.layout.signals_at(now.snapshot.places());
  now.take_outputs_of(before);
  now.disturbance.pause();
  now.motors.reset();
  now.tau = before.tau;
  now.take_motion_of(before.command);
  if (now.drive) now.drive->go_on_from(*before.drive);
  now.handed_over_for = 0.0;
  now.recorder = nullptr;
  return {};
}

}  // namespace zwang::runtime
