#include "guard/joint_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace zwang::runtime {

namespace {
constexpr double infinity = std::numeric_limits<double>::infinity();
}  // namespace

JointLimits::JointLimits(const solver::Model& model, const Eigen::VectorXd& max_torque,
                         const Eigen::VectorXd& slew, double period) {
  for (int j = 0; j < model.joint_count(); ++j) {
    const solver::Joint& joint = model.joint(j);
    const bool slides = joint.type == solver::JointType::prismatic;
    // From one limit to the other, and the tick of the sample.
    const double ticks = std::isfinite(slew(j)) ? 2.0 * max_torque(j) / slew(j) : 0.0;
    Limit limit{joint.lower,
                joint.upper,
                speed_margin * joint.max_velocity,
                max_torque(j),
                period * (1.0 + ticks),
                slides ? resolution_m : resolution};
    // A URDF without `lower` and `upper` reads as 0 and 0: no travel is known.
    if (!(joint.lower < joint.upper)) limit.lower = -infinity, limit.upper = infinity;
    limits_.push_back(limit);
  }
}

std::optional<Event> JointLimits::look(const solver::State& state, const Eigen::VectorXd& tau,
                                       const ArmHold& arm, double time) noexcept {
  for (const ArmHold::HeldJoint& held : arm.joints()) {
    Limit& limit = limits_[static_cast<std::size_t>(held.joint)];
    const double q = state.q(held.joint), qd = state.qd(held.joint);
    const solver::JointLoads::Load& load = arm.load_of(held);
    if (std::abs(qd) > limit.speed) {
      return Event{EventCode::joint_speed, time, event_signal::of_joint(held.joint, event_signal::qd), qd};
    }
    // `left` to an end: negative beyond it.
    const auto look_at = [&](double left, bool& rests) {
      if (is_first_) rests = std::abs(left) <= limit.resolution;
      if (left > rest * limit.resolution) rests = false;
    };
    look_at(q - limit.lower, limit.rests_on_lower);
    look_at(limit.upper - q, limit.rests_on_upper);
    const auto stopping_distance = [&](double s, bool rests) {
      const double driven = rests ? 0.0 : std::max(0.0, s * (tau(held.joint) - load.weight) / load.inertia);
      const double v = s * qd + driven * limit.turn;
      const double a = (limit.max_torque + s * load.weight) / load.inertia;
      if (v <= 0.0) return 0.0;
      if (a <= 0.0) return infinity;
      return v * limit.turn + v / (std::numbers::e * ArmHold::frequency) + v * v / (2.0 * a);
    };
    const auto beyond = [&](bool rests) { return (rests ? rest : 1.0) * limit.resolution; };
    if (q + stopping_distance(1.0, limit.rests_on_upper) > limit.upper + beyond(limit.rests_on_upper) ||
        q - stopping_distance(-1.0, limit.rests_on_lower) < limit.lower - beyond(limit.rests_on_lower)) {
      return Event{EventCode::joint_travel, time, event_signal::of_joint(held.joint, event_signal::q), q};
    }
  }
  is_first_ = false;
  return std::nullopt;
}

}  // namespace zwang::runtime
