#include "guard/arm_hold.hpp"

#include "zwang/solver/wheels.hpp"

namespace zwang::runtime {

using solver::Body;
using solver::JointType;
using solver::Matrix3;
using solver::Pose;
using solver::Vector3;

namespace {

Pose moved(const Body& body, double q) noexcept {
  const solver::Joint& joint = body.joint;
  Pose pose = body.pose_in_parent;
  if (joint.type == JointType::prismatic) {
    pose.position += pose.rotation * joint.axis * q;
  } else if (joint.type != JointType::fixed) {
    pose.rotation = pose.rotation * Eigen::AngleAxisd(q, joint.axis).toRotationMatrix();
  }
  return pose;
}

}  // namespace

ArmHold::ArmHold(const solver::Model& model)
    : model_(model), poses_(model.bodies().size()), subtrees_(model.bodies().size()) {
  for (int j = 0; j < model.joint_count(); ++j) {
    if (model.joint(j).actuated && !carries_wheel(model, j + 1)) joints_.push_back({.joint = j});
  }
}

/// What hangs on a joint, m at c from a point of its axis u:   g = -u . (c x m gravity),   I = u' J u + d;
/// of one that slides  -u . m gravity  and  m + d.
void ArmHold::weigh(const solver::State& state) noexcept {
  const Vector3 gravity = state.base_pose.rotation.transpose() * model_.gravity();
  const std::vector<Body>& bodies = model_.bodies();
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const auto parent = static_cast<std::size_t>(bodies[i].parent);
    poses_[i] = poses_[parent] * moved(bodies[i], state.q(static_cast<Eigen::Index>(i) - 1));
    subtrees_[i] = bodies[i].inertia.expressed_in(poses_[i]);
  }
  for (std::size_t i = bodies.size() - 1; i > 0; --i) {
    const auto parent = static_cast<std::size_t>(bodies[i].parent);
    if (parent > 0) subtrees_[parent] = subtrees_[parent] + subtrees_[i];
  }
  for (HeldJoint& held : joints_) {
    const auto i = static_cast<std::size_t>(held.joint) + 1;
    const solver::Joint& joint = bodies[i].joint;
    const Vector3 axis = poses_[i].rotation * joint.axis;
    const solver::RigidInertia& beyond = subtrees_[i];
    if (joint.type == JointType::prismatic) {
      held.weight = -beyond.mass * axis.dot(gravity);
      held.inertia = beyond.mass + joint.rotor_inertia;
      continue;
    }
    const Vector3& p = poses_[i].position;
    const Vector3 moment_arm = beyond.first_moment - beyond.mass * p;
    held.weight = -axis.dot(moment_arm.cross(gravity));
    const solver::RigidInertia about_joint = beyond.expressed_in({Matrix3::Identity(), -p});
    held.inertia = axis.dot(about_joint.rotational * axis) + joint.rotor_inertia;
  }
}

void ArmHold::take(const solver::State& state) noexcept {
  if (joints_.empty()) return;
  weigh(state);
  for (HeldJoint& held : joints_) held.posture = state.q(held.joint);
}

void ArmHold::hold(const solver::State& state, Eigen::VectorXd& tau) noexcept {
  if (joints_.empty()) return;
  weigh(state);
  for (const HeldJoint& held : joints_) {
    const double spring = held.inertia * frequency * frequency * (held.posture - state.q(held.joint));
    const double damper = -2.0 * held.inertia * frequency * state.qd(held.joint);
    tau(held.joint) = held.weight + spring + damper;
  }
}

void ArmHold::hold_blind(Eigen::VectorXd& tau) const noexcept {
  for (const HeldJoint& held : joints_) tau(held.joint) = held.weight;
}

}  // namespace zwang::runtime
