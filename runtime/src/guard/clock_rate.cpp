#include "guard/clock_rate.hpp"

#include <algorithm>
#include <cmath>

#include "estimate/ticks.hpp"

namespace zwang::runtime {

ClockRate::ClockRate(double period)
    : period_(period),
      odd_enough_(std::max(least_advances, ticks_of(dwell, period))),
      calls_in_window_(ticks_of(window, period)) {}

void ClockRate::begin() noexcept {
  has_last_ = drift_is_told_ = false;
  side_ = odd_advances_ = 0;
}

double ClockRate::rate() const noexcept {
  return odd_calls_ > 0 ? odd_time_ / (odd_calls_ * period_) : 1.0;
}

std::optional<Event> ClockRate::look(double time) noexcept {
  const double advance = time - last_;
  if (!has_last_ || advance < 0.0 || advance > jump) {
    has_last_ = true;
    last_ = began_ = time;
    calls_ = window_calls_ = 0;
    side_ = odd_advances_ = 0;
    return std::nullopt;
  }
  ++calls_;
  ++window_calls_;
  if (advance > 0.0) {
    const double r = advance / (calls_ * period_);
    const int side = r > fast ? 1 : r < slow ? -1 : 0;
    if (side != side_) {
      odd_advances_ = odd_calls_ = 0;
      odd_time_ = 0.0;
    }
    side_ = side;
    if (side != 0) {
      ++odd_advances_;
      odd_calls_ += calls_;
      odd_time_ += advance;
    }
    last_ = time;
    calls_ = 0;
    if (odd_advances_ >= odd_enough_) return Event{EventCode::clock_rate, time, event_signal::time, rate()};
  }
  return window_calls_ >= calls_in_window_ ? end_window(time) : std::nullopt;
}

std::optional<Event> ClockRate::end_window(double time) noexcept {
  const double r = (time - began_) / (window_calls_ * period_);
  began_ = time;
  window_calls_ = 0;
  const bool drifts = std::abs(r - 1.0) > drift;
  const bool begins = drifts && !drift_is_told_;
  drift_is_told_ = drifts;
  if (!begins) return std::nullopt;
  return Event{EventCode::clock_drift, time, event_signal::time, r};
}

}  // namespace zwang::runtime
