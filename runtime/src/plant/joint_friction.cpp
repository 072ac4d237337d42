#include "joint_friction.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

namespace {

constexpr double joint_frequency = 500.0;    ///< [1/s] of the stiffest bristle
constexpr double joint_damping_ratio = 0.7;  ///< while the bristle holds

}  // namespace

JointFriction::JointFriction(const lang::Robot& robot) {
  for (std::size_t j = 0; j < robot.friction.size(); ++j) {
    const lang::JointFriction& friction = robot.friction[j];
    if (friction.coulomb <= 0.0 && friction.viscous <= 0.0) continue;
    const solver::Body& body = robot.model.bodies()[j + 1];
    const bool slides = body.joint.type == solver::JointType::prismatic;
    const double inertia =
        body.joint.rotor_inertia +
        (slides ? body.inertia.mass : body.joint.axis.dot(body.inertia.rotational * body.joint.axis));
    RubbingJoint rubbing;
    rubbing.joint = static_cast<Eigen::Index>(j);
    rubbing.viscous = friction.viscous;
    const double stiffest = inertia * joint_frequency * joint_frequency;
    Bristle& bristle = rubbing.bristle;
    bristle.most = friction.coulomb;
    bristle.longest = std::max(friction.presliding, friction.coulomb / stiffest);
    bristle.stiffness = bristle.longest > 0.0 ? friction.coulomb / bristle.longest : stiffest;
    bristle.damping = 2.0 * joint_damping_ratio * std::sqrt(inertia * bristle.stiffness);
    joints_.push_back(rubbing);
  }
}

void JointFriction::add_to(Eigen::VectorXd& torque, const Eigen::VectorXd& qd, double period) noexcept {
  for (RubbingJoint& rubbing : joints_) {
    const double rate = qd(rubbing.joint);
    torque(rubbing.joint) -= rubbing.bristle.step(rate, period) + rubbing.viscous * rate;
  }
}

}  // namespace zwang::runtime
