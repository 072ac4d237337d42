#include "guard/slip_watch.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

SlipWatch::SlipWatch(const solver::Model& model) {
  for (const solver::Wheel& wheel : model.wheels()) wheels_.push_back({wheel.body - 1, wheel.radius, 0.0});
}

std::optional<Event> SlipWatch::look(const solver::State& measured, const solver::State& allowed,
                                     double time) noexcept {
  const double dt = std::max(0.0, time - last_time_);
  const double part = 1.0 - std::exp(-dt / time_constant);
  last_time_ = time;
  const Wheel* worst = nullptr;
  speed_ = 0.0;
  for (Wheel& wheel : wheels_) {
    const double now = wheel.radius * (measured.qd(wheel.joint) - allowed.qd(wheel.joint));
    wheel.slip += part * (now - wheel.slip);
    const double rim = wheel.radius * std::abs(measured.qd(wheel.joint));
    const double beyond = std::abs(wheel.slip) - share * rim;
    if (worst != nullptr && beyond <= speed_) continue;
    worst = &wheel;
    speed_ = beyond;
  }
  if (worst == nullptr) return std::nullopt;
  const bool begins = !slips_ && speed_ > threshold;
  slips_ = speed_ > (slips_ ? 0.5 : 1.0) * threshold;
  if (slips_) way_ += std::abs(worst->slip) * std::min(dt, time_constant);  // a clock may jump
  if (!begins) return std::nullopt;
  return Event{EventCode::slip, time, event_signal::of_joint(worst->joint, event_signal::qd), worst->slip};
}

}  // namespace zwang::runtime
