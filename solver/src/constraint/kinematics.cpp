#include "constraint/kinematics.hpp"

namespace zwang::solver {

Pose pose_in_parent(const Body& body, double q) noexcept {
  const Joint& joint = body.joint;
  const Pose& fixed = body.pose_in_parent;
  if (joint.type == JointType::prismatic) {
    return {fixed.rotation, fixed.position + fixed.rotation * (joint.axis * q)};
  }
  return {fixed.rotation * Eigen::AngleAxisd(q, joint.axis).toRotationMatrix(), fixed.position};
}

BodyMotion motion_of_body(int index, const Model& model, const State& state) noexcept {
  const Body& body = model.bodies()[static_cast<std::size_t>(index)];
  BodyMotion motion;
  if (index == 0) {
    motion.pose = state.base_pose;
    if (!model.has_fixed_base()) {
      motion.angular = motion.pose.rotation * state.base_twist.angular;
      motion.linear = motion.pose.rotation * state.base_twist.linear;
    }
    return motion;
  }
  const double q = state.q(index - 1);
  const double qd = state.qd(index - 1);
  const FrameMotion carried = motion_of_body(body.parent, model, state).at(pose_in_parent(body, q));
  motion.pose = carried.pose;
  motion.angular = carried.angular;
  motion.linear = carried.linear;
  const Vector3 axis = motion.pose.rotation * body.joint.axis;
  (body.joint.type == JointType::prismatic ? motion.linear : motion.angular) += axis * qd;
  return motion;
}

}  // namespace zwang::solver
