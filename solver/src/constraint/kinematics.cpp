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

void put_motion_in_world(const AttachedFrame& frame, FrameMotion& motion) {
  motion.pose = frame.pose;
  motion.angular.noalias() = frame.pose.rotation * frame.twist.angular;
  motion.linear.noalias() = frame.pose.rotation * frame.twist.linear;
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
  FrameMotion motion;
  if (frame.body < 0) {
    put_motion_in_world(frame, motion);
    return motion;
  }
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

MotionVector BodyMotions::twist_of(int body) noexcept {
  if (body > 0) return of(body).own_twist();
  return model_->has_fixed_base() ? MotionVector{} : state_->base_twist;
}

FrameMotion BodyMotions::of(const AttachedFrame& frame) noexcept {
  FrameMotion place;
  return of(frame, place);
}

const FrameMotion& BodyMotions::of(const AttachedFrame& frame, FrameMotion& place) noexcept {
  if (frame.body < 0) {
    put_motion_in_world(frame, place);
    return place;
  }
  const FrameMotion& body = of(frame.body);
  if (!is_origin(frame.pose)) return place = body.at(frame.pose);
  return &body == &forgotten_.motion ? place = body : body;
}

const Pose& BodyMotions::pose_of(const AttachedFrame& frame, Pose& place) noexcept {
  if (frame.body < 0) return frame.pose;
  const FrameMotion& body = of(frame.body);
  if (!is_origin(frame.pose)) return place = body.pose * frame.pose;
  return &body == &forgotten_.motion ? place = body.pose : body.pose;
}

}  // namespace zwang::solver
