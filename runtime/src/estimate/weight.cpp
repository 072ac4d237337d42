#include "estimate/weight.hpp"

#include <Eigen/Geometry>

namespace zwang::runtime {

using solver::JointType;
using solver::Pose;
using solver::Vector3;

WeightFeedForward::WeightFeedForward(const solver::Model& model)
    : model_(model),
      bears_(static_cast<std::size_t>(model.body_count()), false),
      carried_(static_cast<std::size_t>(model.body_count())) {
  for (int j = 0; j < model.joint_count(); ++j) {
    bears_[static_cast<std::size_t>(j) + 1] = model.joint(j).actuated;
  }
  for (const solver::Wheel& wheel : model.wheels()) bears_[static_cast<std::size_t>(wheel.body)] = false;
  for (const bool bears : bears_) any_ = any_ || bears;
}

void WeightFeedForward::add_to(solver::State& state) noexcept {
  if (!any_) return;
  for (std::size_t i = 0; i < carried_.size(); ++i) {
    const solver::Body& body = model_.bodies()[i];
    Carried& c = carried_[i];
    c.pose = state.base_pose;
    if (i > 0) {
      const double q = state.q(static_cast<Eigen::Index>(i) - 1);
      Pose moved;
      if (body.joint.type == JointType::prismatic) {
        moved.position = q * body.joint.axis;
      } else {
        moved.rotation = Eigen::AngleAxisd(q, body.joint.axis).toRotationMatrix();
      }
      c.pose = carried_[static_cast<std::size_t>(body.parent)].pose * body.pose_in_parent * moved;
    }
    c.mass = body.inertia.mass;
    c.first_moment = c.pose.rotation * body.inertia.first_moment + c.mass * c.pose.position;
  }
  for (std::size_t i = carried_.size(); i-- > 1;) {
    const solver::Body& body = model_.bodies()[i];
    const Carried& c = carried_[i];
    Carried& parent = carried_[static_cast<std::size_t>(body.parent)];
    parent.mass += c.mass;
    parent.first_moment += c.first_moment;
    if (!bears_[i]) continue;
    const Vector3 axis = c.pose.rotation * body.joint.axis;
    const Vector3 load = body.joint.type == JointType::prismatic
                             ? Vector3(c.mass * model_.gravity())
                             : (c.first_moment - c.mass * c.pose.position).cross(model_.gravity());
    state.tau_ff(static_cast<Eigen::Index>(i) - 1) -= axis.dot(load);
  }
}

}  // namespace zwang::runtime
