#include "guard/wheel_signs.hpp"

#include <algorithm>

namespace zwang::runtime {

WheelSigns::WheelSigns(const solver::Model& model) : odometry_(model), turned_(model), allowed_(model) {
  for (const solver::Wheel& wheel : model.wheels())
    wheels_.push_back({.joint = wheel.body - 1, .radius = wheel.radius});
}

void WheelSigns::roll(solver::Solver& solver, const solver::State& measured, const solver::State& allowed,
                      bool is_reckoned, double time) noexcept {
  slips_ = false;
  for (Wheel& wheel : wheels_) wheel.explains = 0;
  if (wheels_.empty() || time - looked_ < look_every) return;
  looked_ = time;
  Wheel& wheel = wheels_[next_];
  next_ = (next_ + 1) % wheels_.size();
  if (wheel.agrees >= agreements) return;
  const auto turned = square_slip_turned(solver, wheel, measured, is_reckoned);
  if (!turned) return;
  // Of noise about a wheel that stands either sign makes the same.
  const double now = square_slip(measured, allowed);
  if (*turned > seen * seen && now < left * *turned) {
    ++wheel.agrees;
  } else if (now > seen * seen && *turned < left * now) {
    wheel.agrees = 0;
  }
}

void WheelSigns::begin_window(double time) noexcept {
  began_ = time;
  square_slip_ = 0.0;
  for (Wheel& wheel : wheels_) wheel.square_slip = 0.0;
}

double WheelSigns::square_slip(const solver::State& measured, const solver::State& allowed) const noexcept {
  double sum = 0.0;
  for (const Wheel& wheel : wheels_) {
    const double slip = wheel.radius * (measured.qd(wheel.joint) - allowed.qd(wheel.joint));
    sum += slip * slip;
  }
  return sum;
}

/// The slip with the wheel's rate reversed.
std::optional<double> WheelSigns::square_slip_turned(solver::Solver& solver, const Wheel& wheel,
                                                     const solver::State& measured,
                                                     bool is_reckoned) noexcept {
  turned_ = measured;
  turned_.qd(wheel.joint) = -measured.qd(wheel.joint);
  if (is_reckoned) turned_.base_twist = odometry_.twist(turned_).twist;
  allowed_ = turned_;
  if (solver.project_velocity(allowed_) != solver::Status::ok) return std::nullopt;
  return square_slip(turned_, allowed_);
}

std::optional<Event> WheelSigns::look(solver::Solver& solver, const solver::State& measured,
                                      const solver::State& allowed, bool is_reckoned, double time) noexcept {
  if (!slips_) begin_window(time);
  const bool is_due = !slips_ || time - looked_ >= look_every;
  slips_ = true;
  if (!is_due) return std::nullopt;
  looked_ = time;
  square_slip_ += square_slip(measured, allowed);
  for (Wheel& wheel : wheels_) {
    if (wheel.agrees >= agreements) continue;
    const auto turned = square_slip_turned(solver, wheel, measured, is_reckoned);
    if (!turned) return std::nullopt;
    wheel.square_slip += *turned;
  }
  if (time - began_ < window) return std::nullopt;
  const Wheel* best = nullptr;
  for (Wheel& wheel : wheels_) {
    if (wheel.agrees >= agreements) continue;
    wheel.explains = wheel.square_slip < left * square_slip_ ? wheel.explains + 1 : 0;
    const bool is_sure = wheel.explains >= windows;
    if (is_sure && (best == nullptr || wheel.square_slip < best->square_slip)) best = &wheel;
  }
  std::optional<Event> told;
  if (best != nullptr) {
    const int signal = event_signal::of_joint(best->joint, event_signal::qd);
    told = Event{EventCode::wheel_reversed, time, signal, measured.qd(best->joint)};
  }
  begin_window(time);
  return told;
}

}  // namespace zwang::runtime
