#include "estimate/friction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zwang::runtime {

FrictionEstimate::FrictionEstimate(const lang::Robot& robot)
    : torque_(Eigen::VectorXd::Zero(robot.model.joint_count())) {
  const int joints = std::min(robot.model.joint_count(), static_cast<int>(robot.friction.size()));
  for (int j = 0; j < joints; ++j) {
    lang::JointFriction friction = robot.friction[static_cast<std::size_t>(j)];
    if (friction.coulomb <= 0.0 && friction.viscous <= 0.0) continue;
    const solver::Joint& joint = robot.model.joint(j);
    if (!joint.actuated) friction.compensate = 0.0;
    terms_.push_back({.joint = j, .friction = friction, .turns = joint.type != solver::JointType::prismatic});
  }
}

void FrictionEstimate::follow(const Eigen::VectorXd& q) noexcept {
  for (Term& term : terms_) {
    double moved = is_followed_ ? q(term.joint) - term.q : 0.0;
    if (term.turns)
      moved = std::remainder(moved, 2.0 * std::numbers::pi);  // encoders may start anew each turn
    const double longest = term.friction.presliding;
    term.stretch = std::clamp(term.stretch + moved, -longest, longest);
    term.q = q(term.joint);
  }
  is_followed_ = true;
}

void FrictionEstimate::update(const Eigen::VectorXd& qd, const Eigen::VectorXd& press) noexcept {
  for (const Term& term : terms_) {
    const lang::JointFriction& friction = term.friction;
    const double rate = qd(term.joint), push = std::abs(press(term.joint));
    double dry = rate / std::hypot(rate, term.turns ? turn_taper : slide_taper);
    if (friction.presliding > 0.0) {
      const double w = push < friction.coulomb ? push / friction.coulomb : 1.0;
      dry += w * (term.stretch / friction.presliding - dry);
    }
    torque_(term.joint) = friction.coulomb * dry + friction.viscous * rate;
  }
}

void FrictionEstimate::compensate(Eigen::VectorXd& tau) const noexcept {
  for (const Term& term : terms_) tau(term.joint) += term.friction.compensate * torque_(term.joint);
}

}  // namespace zwang::runtime
