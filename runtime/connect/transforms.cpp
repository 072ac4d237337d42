#include "transforms.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace zwang::connect {

namespace {

constexpr double least_rotation = 0.5;  // the norm of a quaternion that was filled in
constexpr int longest_chain = 64;

/// Before tf2 names began with a slash.
std::string without_slash(const std::string& frame) {
  return frame.starts_with('/') ? frame.substr(1) : frame;
}

}  // namespace

std::optional<solver::Pose> pose_of(const PoseFields& f) {
  Eigen::Quaterniond rotation(f[6], f[3], f[4], f[5]);
  if (!are_finite(f) || !(rotation.norm() > least_rotation)) return std::nullopt;
  solver::Pose pose;
  pose.position = {f[0], f[1], f[2]};
  pose.rotation = rotation.normalized().toRotationMatrix();
  return pose;
}

TransformChain::TransformChain(std::string parent, std::string child)
    : parent_(without_slash(parent)), child_(without_slash(child)) {}

TransformChain::Verdict TransformChain::take(const TransformStamped& transform, bool is_static,
                                             const Sender& sender, double arrival) {
  const auto pose = pose_of(transform.transform);
  if (!pose) return Verdict::bad;
  const std::string child = without_slash(transform.child_frame);
  const std::lock_guard lock(mutex_);
  if (links_.size() >= most_frames && links_.count(child) == 0) return Verdict::taken;
  Link& link = links_[child];
  if (!link.publisher.admits(sender, arrival)) return Verdict::of_another;
  link.parent = without_slash(transform.header.frame);
  link.stamp = transform.header.stamp();
  link.is_static = is_static;
  link.pose = *pose;
  is_changed_ = true;
  return Verdict::taken;
}

std::optional<TransformChain::Found> TransformChain::find() {
  const std::lock_guard lock(mutex_);
  if (!std::exchange(is_changed_, false)) return std::nullopt;
  Found found;
  bool is_moving = false;
  std::string frame = child_;
  for (int i = 0; frame != parent_; ++i) {
    const auto link = links_.find(frame);
    if (link == links_.end() || i == longest_chain) return std::nullopt;
    if (!link->second.is_static && !is_moving) found.stamp = link->second.stamp;
    is_moving = is_moving || !link->second.is_static;
    found.pose = link->second.pose * found.pose;
    frame = link->second.parent;
  }
  if (!is_moving) return std::nullopt;  // a robot that nobody has measured
  return found;
}

}  // namespace zwang::connect
