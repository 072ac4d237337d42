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

/// The body's own frame, as most of those that a task names.
bool is_origin(const Pose& pose) {
  return pose.position == Vector3::Zero() && pose.rotation == Matrix3::Identity();
}

FrameMotion motion_in_world(const AttachedFrame& frame) {
  return {frame.pose, frame.pose.rotation * frame.twist.angular, frame.pose.rotation * frame.twist.linear};
}

}  // namespace

FrameMotion motion_of_base(const Model& model, const State& state) noexcept {
  FrameMotion motion;
  motion.pose = state.base_pose;
  if (!model.has_fixed_base()) {
    motion.angular = motion.pose.rotation * state.base_twist.angular;
    motion.linear = motion.pose.rotation * state.base_twist.linear;
  }
  return motion;
}

FrameMotion motion_on_parent(const Body& body, double q, double qd, const FrameMotion& parent) noexcept {
  FrameMotion motion = parent.at(pose_in_parent(body, q));
  const Vector3 axis = motion.pose.rotation * body.joint.axis;
  (body.joint.type == JointType::prismatic ? motion.linear : motion.angular) += axis * qd;
  return motion;
}

FrameMotion motion_of_body(int index, const Model& model, const State& state,
                           const FrameMotion& base) noexcept {
  if (index == 0) return base;
  const Body& body = model.bodies()[static_cast<std::size_t>(index)];
  const FrameMotion parent = motion_of_body(body.parent, model, state, base);
  return motion_on_parent(body, state.q(index - 1), state.qd(index - 1), parent);
}

FrameMotion motion_of(const AttachedFrame& frame, const Model& model, const State& state) noexcept {
  if (frame.body < 0) return motion_in_world(frame);
  return motion_of_body(frame.body, model, state, motion_of_base(model, state)).at(frame.pose);
}

BodyMotions::BodyMotions(std::size_t capacity) {
  known_.reserve(capacity);
}

void BodyMotions::start(const Model& model, const State& state) noexcept {
  model_ = &model;
  state_ = &state;
  known_.clear();
}

const FrameMotion& BodyMotions::of(int body) noexcept {
  for (const Known& known : known_) {
    if (known.body == body) return known.motion;
  }
  Known found{body, {}};
  if (body == 0) {
    found.motion = motion_of_base(*model_, *state_);
  } else {
    const Body& link = model_->bodies()[static_cast<std::size_t>(body)];
    found.motion = motion_on_parent(link, state_->q(body - 1), state_->qd(body - 1), of(link.parent));
  }
  if (known_.size() == known_.capacity()) return (forgotten_ = found).motion;
  known_.push_back(found);
  return known_.back().motion;
}

FrameMotion BodyMotions::of(const AttachedFrame& frame) noexcept {
  FrameMotion place;
  return of(frame, place);
}

const FrameMotion& BodyMotions::of(const AttachedFrame& frame, FrameMotion& place) noexcept {
  if (frame.body < 0) return place = motion_in_world(frame);
  const FrameMotion& body = of(frame.body);
  if (!is_origin(frame.pose)) return place = body.at(frame.pose);
  return &body == &forgotten_.motion ? place = body : body;
}

}  // namespace zwang::solver
