#include "estimate/friction.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

FrictionFeedForward::FrictionFeedForward(const lang::Robot& robot) {
  const int joints = std::min(robot.model.joint_count(), static_cast<int>(robot.friction.size()));
  for (int j = 0; j < joints; ++j) {
    const lang::JointFriction& friction = robot.friction[static_cast<std::size_t>(j)];
    const solver::Joint& joint = robot.model.joint(j);
    if (!joint.actuated || !(friction.compensate > 0.0)) continue;
    terms_.push_back({j, friction, joint.type == solver::JointType::prismatic ? slide_taper : turn_taper});
  }
}

void FrictionFeedForward::add_to(Eigen::VectorXd& tau, const solver::State& state) const noexcept {
  for (const Term& term : terms_) {
    const double qd = state.qd(term.joint);
    const double dry = term.friction.coulomb * qd / std::hypot(qd, term.taper);
    tau(term.joint) += term.friction.compensate * (dry + term.friction.viscous * qd);
  }
}

}  // namespace zwang::runtime
