#include "guard/arm_hold.hpp"

#include "zwang/solver/wheels.hpp"

namespace zwang::runtime {

ArmHold::ArmHold(const solver::Model& model) : loads_(model) {
  for (std::size_t i = 0; i < loads_.all().size(); ++i) {
    const int joint = loads_.all()[i].joint;
    if (!carries_wheel(model, joint + 1)) joints_.push_back({.joint = joint, .load = i});
  }
}

void ArmHold::take(const solver::State& state) noexcept {
  if (joints_.empty()) return;
  loads_.weigh(state);
  for (HeldJoint& held : joints_) held.posture = state.q(held.joint);
}

void ArmHold::hold(const solver::State& state, Eigen::VectorXd& tau) noexcept {
  if (joints_.empty()) return;
  loads_.weigh(state);
  for (const HeldJoint& held : joints_) {
    const solver::JointLoads::Load& load = load_of(held);
    const double spring = load.inertia * frequency * frequency * (held.posture - state.q(held.joint));
    const double damper = -2.0 * load.inertia * frequency * state.qd(held.joint);
    tau(held.joint) = load.weight + spring + damper;
  }
}

void ArmHold::hold_blind(Eigen::VectorXd& tau) const noexcept {
  for (const HeldJoint& held : joints_) tau(held.joint) = load_of(held).weight;
}

void ArmHold::copy(const Eigen::VectorXd& from, Eigen::VectorXd& tau) const noexcept {
  for (const HeldJoint& held : joints_) tau(held.joint) = from(held.joint);
}

}  // namespace zwang::runtime
