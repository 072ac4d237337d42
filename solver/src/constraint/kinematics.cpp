#include "constraint/kinematics.hpp"

namespace zwang::solver {

namespace {

/// X_PB(q): the body's frame in its parent's.
Pose pose_in_parent(const Body& body, double q) {
  const Joint& joint = body.joint;
  const Pose& fixed = body.pose_in_parent;
  if (joint.type == JointType::prismatic) {
    return {fixed.rotation, fixed.position + fixed.rotation * (joint.axis * q)};
  }
  return {fixed.rotation * Eigen::AngleAxisd(q, joint.axis).toRotationMatrix(), fixed.position};
}

}  // namespace

BodyMotion motion_of_base(const Model& model, const State& state) noexcept {
  BodyMotion motion;
  motion.pose = state.base_pose;
  if (!model.has_fixed_base()) {
    motion.angular = motion.pose.rotation * state.base_twist.angular;
    motion.linear = motion.pose.rotation * state.base_twist.linear;
  }
  return motion;
}

BodyMotion motion_on_parent(const Body& body, double q, double qd, const BodyMotion& parent) noexcept {
  BodyMotion motion{parent.at(pose_in_parent(body, q))};
  const Vector3 axis = motion.pose.rotation * body.joint.axis;
  (body.joint.type == JointType::prismatic ? motion.linear : motion.angular) += axis * qd;
  return motion;
}

BodyMotion motion_of_body(int index, const Model& model, const State& state,
                          const BodyMotion& base) noexcept {
  if (index == 0) return base;
  const Body& body = model.bodies()[static_cast<std::size_t>(index)];
  const BodyMotion parent = motion_of_body(body.parent, model, state, base);
  return motion_on_parent(body, state.q(index - 1), state.qd(index - 1), parent);
}

}  // namespace zwang::solver
