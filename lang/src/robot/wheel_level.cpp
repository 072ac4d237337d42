#include "zwang/lang/wheel_level.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "zwang/solver/constraint.hpp"

namespace zwang::lang {

solver::Pose pose_in_base(const solver::Model& model, int body) {
  solver::Pose pose;
  for (int b = body; b > 0; b = model.bodies()[static_cast<std::size_t>(b)].parent) {
    pose = model.bodies()[static_cast<std::size_t>(b)].pose_in_parent * pose;
  }
  return pose;
}

solver::Pose pose_in_base(const solver::Model& model, int body, const Eigen::VectorXd& q) {
  solver::Pose pose;
  for (int b = body; b > 0; b = model.bodies()[static_cast<std::size_t>(b)].parent) {
    const solver::Body& link = model.bodies()[static_cast<std::size_t>(b)];
    solver::Pose moved;
    if (link.joint.type == solver::JointType::prismatic) {
      moved.position = q(b - 1) * link.joint.axis;
    } else {
      moved.rotation = Eigen::AngleAxisd(q(b - 1), link.joint.axis).toRotationMatrix();
    }
    pose = link.pose_in_parent * moved * pose;
  }
  return pose;
}

namespace {

/// A plain wheel that does not steer.
bool is_of_axle(const solver::Model& model, const solver::Wheel& wheel) {
  return model.bodies()[static_cast<std::size_t>(wheel.body)].parent == 0 && !wheel.roller_angle &&
         wheel.holds_sideways;
}

}  // namespace

bool has_axle(const solver::Model& model) {
  return std::any_of(model.wheels().begin(), model.wheels().end(),
                     [&](const solver::Wheel& wheel) { return is_of_axle(model, wheel); });
}

double axle_ahead(const solver::Model& model, double heading) {
  const Eigen::Vector2d ahead(std::cos(heading), std::sin(heading));
  double sum = 0.0;
  int count = 0;
  for (const solver::Wheel& wheel : model.wheels()) {
    if (!is_of_axle(model, wheel)) continue;
    sum += ahead.dot(pose_in_base(model, wheel.body).position.head<2>());
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

WheelLevel wheel_level(const solver::Model& model) {
  WheelLevel level;
  double smallest = solver::infinity;
  for (const solver::Wheel& wheel : model.wheels()) {
    smallest = std::min(smallest, wheel.radius);
    level.ends.push_back(pose_in_base(model, wheel.body).position.z() - wheel.radius);
    level.mean += level.ends.back() / static_cast<double>(model.wheels().size());
  }
  if (!model.wheels().empty()) level.most_lift = std::max(least_wheel_lift, wheel_lift_share * smallest);
  const auto [low, high] = std::minmax_element(level.ends.begin(), level.ends.end());
  level.lowest = static_cast<std::size_t>(low - level.ends.begin());
  level.highest = static_cast<std::size_t>(high - level.ends.begin());
  return level;
}

}  // namespace zwang::lang
