#include "run/signal_watch.hpp"

#include <algorithm>

#include "schedule/signal_table.hpp"

namespace zwang::runtime {

SignalWatch::SignalWatch(const lang::Program& program) : joints_(program.robot.model.joint_count()) {
  for (const lang::Signal& signal : program.signals) signals_.push_back({.type = signal.type});
}

std::optional<Event> SignalWatch::look_at_fix(const Sensed& sensed) noexcept {
  if (!sensed.base_fix || sensed.base_measured || fix_.is_told) return std::nullopt;
  const MeasuredPose& measured = *sensed.base_fix;
  if (measured.stamp == fix_.stamp) return std::nullopt;
  fix_.stamp = measured.stamp;
  const double lead = measured.stamp - sensed.time;
  const bool is_timely = lead <= ahead && lead >= -fix_behind;
  if (is_timely && is_sound({.pose = measured.pose}, fix_.type)) return std::nullopt;
  fix_.is_told = true;
  return Event{EventCode::signal_refused, sensed.time, event_signal::base_pose, is_timely ? 0.0 : lead};
}

std::optional<Event> SignalWatch::look(const Sensed& sensed, std::size_t expected,
                                       const Sensed& sample_of_program) noexcept {
  const std::size_t size = sensed.signals.size();
  if (size != 0 && size != expected && !size_is_told_) {
    size_is_told_ = true;
    return Event{EventCode::signal_refused, sample_of_program.time, -1, static_cast<double>(size)};
  }
  if (const auto refused = look_at_fix(sensed)) return refused;
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    const SignalSample& sample = sample_of_program.signals[i];
    Watched& watched = signals_[i];
    // A sample that stays until the next one comes gets old, and that is not a fault.
    if (!sample.valid || watched.is_told || sample.stamp == watched.stamp) continue;
    watched.stamp = sample.stamp;
    const double lead = sample.stamp - sample_of_program.time;
    const bool is_timely = lead <= ahead && lead >= -behind;
    if (is_timely && is_sound(sample, watched.type)) continue;
    watched.is_told = true;
    const int signal = event_signal::measured(joints_, static_cast<int>(i));
    return Event{EventCode::signal_refused, sample_of_program.time, signal, is_timely ? 0.0 : lead};
  }
  return std::nullopt;
}

}  // namespace zwang::runtime
