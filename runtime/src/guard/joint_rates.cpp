#include "guard/joint_rates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zwang::runtime {

JointRates::JointRates(const solver::Model& model) {
  for (int j = 0; j < model.joint_count(); ++j) {
    const solver::Joint& joint = model.joint(j);
    if (!joint.actuated) continue;
    const bool slides = joint.type == solver::JointType::prismatic;
    joints_.push_back({.joint = j,
                       .turns_on = joint.type == solver::JointType::continuous,
                       .resolution = slides ? resolution_m : resolution});
  }
}

std::optional<Event> JointRates::look(const solver::State& state, double time) noexcept {
  const double dt = time - last_time_;
  // Where the clock starts anew.
  const bool goes_on = has_last_ && dt > 0.0 && dt <= window;
  const double part = goes_on ? 1.0 - std::exp(-dt / quick) : 0.0;
  window_time_ = goes_on ? window_time_ + dt : 0.0;
  const bool is_over = window_time_ >= window;
  std::optional<Event> told;
  for (DrivenJoint& driven : joints_) {
    const double q = state.q(driven.joint), qd = state.qd(driven.joint);
    if (goes_on) {
      double step = q - driven.last_q;
      if (driven.turns_on && std::abs(step) > std::numbers::pi)
        step = std::remainder(step, 2.0 * std::numbers::pi);
      driven.way += step;
      driven.integral += 0.5 * (driven.last_qd + qd) * dt;
      driven.rate += part * (step / dt - driven.rate);
    }
    driven.last_q = q;
    driven.last_qd = qd;
    if (!goes_on || is_over) {
      const double off = driven.way - driven.integral;
      const double allowed =
          share * std::max(std::abs(driven.way), std::abs(driven.integral)) + driven.resolution;
      driven.more = off > allowed ? driven.more + 1 : 0;
      driven.less = off < -allowed ? driven.less + 1 : 0;
      driven.way = driven.integral = 0.0;
      if (!told && std::max(driven.more, driven.less) >= windows)
        told = Event{EventCode::rate_contradicts, time,
                     event_signal::of_joint(driven.joint, event_signal::qd), qd};
    }
  }
  if (is_over) window_time_ = 0.0;
  last_time_ = time;
  has_last_ = true;
  return told;
}

void JointRates::mend(Eigen::VectorXd& qd) const noexcept {
  for (const DrivenJoint& driven : joints_) {
    if (std::abs(qd(driven.joint)) < 2.0 * std::abs(driven.rate)) qd(driven.joint) = driven.rate;
  }
}

}  // namespace zwang::runtime
