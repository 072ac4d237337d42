#include "zwang/solver/model.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "zwang/solver/state.hpp"

namespace zwang::solver {

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("model: " + what);
}

bool is_finite(const Pose& pose) {
  return pose.rotation.allFinite() && pose.position.allFinite();
}

void require_physical(const RigidInertia& inertia, const std::string& name) {
  if (!std::isfinite(inertia.mass) || !inertia.first_moment.allFinite() || !inertia.rotational.allFinite()) {
    refuse("the inertia of `" + name + "` is not finite");
  }
  if (inertia.mass <= 0.0) refuse("the mass of `" + name + "` is not positive");
  const Vector3 moments = Eigen::SelfAdjointEigenSolver<Matrix3>(inertia.rotational_at_com()).eigenvalues();
  const double tolerance = 1e-6 * moments.cwiseAbs().maxCoeff();
  if (moments.minCoeff() <= 0.0) refuse("the inertia of `" + name + "` is not positive definite");
  if (moments(0) + moments(1) < moments(2) - tolerance) {
    refuse("the inertia of `" + name + "` breaks the triangle rule: no body can have it");
  }
}

template <typename Items>
auto find_by_name(const Items& items, std::string_view name) {
  return std::find_if(items.begin(), items.end(), [name](const auto& item) { return item.name == name; });
}

}  // namespace

double Model::total_mass() const {
  double mass = 0.0;
  for (const Body& body : bodies_) mass += body.inertia.mass;
  return mass;
}

bool Model::has_joints_of(const Model& other) const {
  if (joint_count() != other.joint_count()) return false;
  for (int j = 0; j < joint_count(); ++j) {
    if (joint(j).name != other.joint(j).name) return false;
  }
  return true;
}

std::optional<int> Model::find_frame(std::string_view name) const {
  const auto it = find_by_name(frames_, name);
  if (it == frames_.end()) return std::nullopt;
  return static_cast<int>(it - frames_.begin());
}

std::optional<int> Model::find_joint(std::string_view name) const {
  for (int j = 0; j < joint_count(); ++j) {
    if (joint(j).name == name) return j;
  }
  return std::nullopt;
}

ModelBuilder::ModelBuilder(BaseType base_type, std::string base_name, const RigidInertia& base_inertia) {
  model_.base_type_ = base_type;
  model_.frames_.push_back({base_name, 0, {}});
  model_.bodies_.push_back({std::move(base_name), -1, {}, {}, base_inertia});
}

const Frame& ModelBuilder::frame(const std::string& name) const {
  const auto index = model_.find_frame(name);
  if (!index) refuse("no link or frame named `" + name + "`");
  return model_.frames_[static_cast<std::size_t>(*index)];
}

ModelBuilder& ModelBuilder::add_link(const std::string& name, const std::string& parent,
                                     const Pose& pose_in_parent, const Joint& joint,
                                     const RigidInertia& inertia) {
  if (model_.find_frame(name)) refuse("two links or frames are named `" + name + "`");
  if (!is_finite(pose_in_parent)) refuse("the pose of `" + name + "` is not finite");
  const Frame anchor = frame(parent);
  const Pose pose_in_body = anchor.pose_in_body * pose_in_parent;
  if (joint.type == JointType::fixed) {
    Body& body = model_.bodies_[static_cast<std::size_t>(anchor.body)];
    body.inertia = body.inertia + inertia.expressed_in(pose_in_body);
    model_.frames_.push_back({name, anchor.body, pose_in_body});
    return *this;
  }
  if (model_.find_joint(joint.name)) refuse("two joints are named `" + joint.name + "`");
  const double length = joint.axis.norm();
  if (!(length > 1e-9) || !std::isfinite(length)) refuse("the axis of `" + joint.name + "` has no direction");
  if (!(joint.rotor_inertia >= 0.0) || !std::isfinite(joint.rotor_inertia)) {
    refuse("the rotor inertia of `" + joint.name + "` is negative or not finite");
  }
  if (!(joint.max_effort >= 0.0)) refuse("the effort limit of `" + joint.name + "` is not a limit");
  Joint normalised = joint;
  normalised.axis /= length;
  model_.frames_.push_back({name, model_.body_count(), {}});
  model_.bodies_.push_back({name, anchor.body, pose_in_body, normalised, inertia});
  return *this;
}

ModelBuilder& ModelBuilder::add_frame(const std::string& name, const std::string& parent,
                                      const Pose& pose_in_parent) {
  if (model_.find_frame(name)) refuse("two links or frames are named `" + name + "`");
  if (!is_finite(pose_in_parent)) refuse("the pose of `" + name + "` is not finite");
  const Frame anchor = frame(parent);
  model_.frames_.push_back({name, anchor.body, anchor.pose_in_body * pose_in_parent});
  return *this;
}

ModelBuilder& ModelBuilder::add_wheel(const std::string& joint, Wheel wheel) {
  const auto index = model_.find_joint(joint);
  if (!index) refuse("no joint named `" + joint + "`");
  if (!(wheel.radius > 0.0) || !std::isfinite(wheel.radius)) {
    refuse("the radius of the wheel on `" + joint + "` is not positive");
  }
  if (model_.joint(*index).type == JointType::prismatic)
    refuse("the joint `" + joint + "` cannot carry a wheel");
  wheel.body = *index + 1;
  model_.wheels_.push_back(wheel);
  return *this;
}

ModelBuilder& ModelBuilder::set_gravity(const Vector3& gravity) {
  if (!gravity.allFinite()) refuse("gravity is not finite");
  model_.gravity_ = gravity;
  return *this;
}

ModelBuilder& ModelBuilder::set_steering_error(double angle) {
  if (!(angle >= 0.0 && angle <= 0.1)) refuse("steering error is not from 0 to 0.1 rad");
  model_.steering_error_ = angle;
  return *this;
}

Model ModelBuilder::build() const {
  for (const Body& body : model_.bodies_) {
    const bool moves = body.parent >= 0 || !model_.has_fixed_base();
    if (moves) require_physical(body.inertia, body.name);
  }
  return model_;
}

State::State(const Model& model)
    : q(Eigen::VectorXd::Zero(model.joint_count())),
      qd(Eigen::VectorXd::Zero(model.joint_count())),
      f_ext(static_cast<std::size_t>(model.body_count())),
      tau_ff(Eigen::VectorXd::Zero(model.joint_count())) {}

}  // namespace zwang::solver
