#include "zwang/solver/joint_loads.hpp"

#include <Eigen/Geometry>

#include "zwang/solver/wheels.hpp"

namespace zwang::solver {

namespace {

/// The body in its parent.
Pose moved(const Body& body, double q) noexcept {
  Pose pose = body.pose_in_parent;
  if (body.joint.type == JointType::prismatic) {
    pose.position += pose.rotation * body.joint.axis * q;
  } else if (body.joint.type != JointType::fixed) {
    pose.rotation = pose.rotation * Eigen::AngleAxisd(q, body.joint.axis).toRotationMatrix();
  }
  return pose;
}

}  // namespace

JointLoads::JointLoads(const Model& model)
    : model_(model), poses_(model.bodies().size()), subtrees_(model.bodies().size()) {
  for (int j = 0; j < model.joint_count(); ++j) {
    if (model.joint(j).actuated && !turns_wheel(model, j + 1)) loads_.push_back({.joint = j});
  }
}

void JointLoads::weigh(const State& state) noexcept {
  if (loads_.empty()) return;
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
  for (Load& load : loads_) {
    const auto i = static_cast<std::size_t>(load.joint) + 1;
    const Joint& joint = bodies[i].joint;
    const Vector3 axis = poses_[i].rotation * joint.axis;
    const RigidInertia& beyond = subtrees_[i];
    if (joint.type == JointType::prismatic) {
      load.weight = -beyond.mass * axis.dot(gravity);
      load.inertia = beyond.mass + joint.rotor_inertia;
      continue;
    }
    const Vector3& origin = poses_[i].position;
    const Vector3 moment_arm = beyond.first_moment - beyond.mass * origin;  // m (c - o)
    load.weight = -axis.dot(moment_arm.cross(gravity));
    const RigidInertia about_joint = beyond.expressed_in({Matrix3::Identity(), -origin});
    load.inertia = axis.dot(about_joint.rotational * axis) + joint.rotor_inertia;
  }
}

void JointLoads::bear(State& state) noexcept {
  weigh(state);
  for (const Load& load : loads_) state.tau_ff(load.joint) += load.weight;
}

}  // namespace zwang::solver
