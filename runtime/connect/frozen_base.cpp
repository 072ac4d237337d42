#include "frozen_base.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::connect {

namespace {

constexpr double longest_lateness = 0.5;  // [s] of a message that still counts
constexpr double periods = 3.0;           // that a measurement may stay away

double farthest_motion(const solver::MotionVector& m) {
  return std::hypot(m.linear.x(), m.linear.y()) + FrozenBase::lever * std::abs(m.angular.z());
}

bool is_same(const solver::Pose& a, const solver::Pose& b) {
  return a.position == b.position && a.rotation == b.rotation;
}

bool is_same(const solver::MotionVector& a, const solver::MotionVector& b) {
  return a.linear == b.linear && a.angular == b.angular;
}

}  // namespace

FrozenBase::FrozenBase(const solver::Model& model, double stale_after)
    : wheels_(model),
      state_(model),
      stale_after_(stale_after),
      q_at_pose_(Eigen::VectorXd::Zero(model.joint_count())) {}

double FrozenBase::patience() const noexcept {
  return std::max(stale_after_, periods * period_) + lateness_;
}

bool FrozenBase::Standing::is_stuck(bool is_contradicted, double time, double patience) noexcept {
  if (!is_contradicted) {
    since.reset();
    return false;
  }
  since = since.value_or(time);
  return time - *since > patience;
}

void FrozenBase::take_message(const BaseSample& base) noexcept {
  if (messages_ > 0 && base.arrival == last_.arrival) return;
  if (messages_++ == 0) first_arrival_ = base.arrival;
  if (messages_ > 1) period_ = (base.arrival - first_arrival_) / (messages_ - 1);
}

solver::MotionVector FrozenBase::by_wheels(const Eigen::VectorXd& q, const Eigen::VectorXd& rates) noexcept {
  state_.q = q;
  state_.qd = rates;
  return wheels_.twist(state_).twist;
}

std::optional<double> FrozenBase::look(const BaseSample& base, const Eigen::VectorXd& q,
                                       const Eigen::VectorXd& qd, double time) noexcept {
  take_message(base);
  const solver::MotionVector twist = by_wheels(q, qd);
  const bool is_first = !has_begun_;
  has_begun_ = true;
  if (is_first || !is_same(base.pose, last_.pose)) {
    q_at_pose_ = q;
    lateness_ = std::clamp(base.arrival - base.stamp, 0.0, longest_lateness);
  }
  if (is_first || !is_same(base.twist, last_.twist)) wheels_at_twist_ = twist;
  last_ = base;

  const double way = farthest_motion(by_wheels(q, q - q_at_pose_));
  const double change = farthest_motion(twist - wheels_at_twist_);
  const bool pose_is_stuck = pose_.is_stuck(way > least_way, time, patience());
  const bool twist_is_stuck = twist_.is_stuck(change > least_change, time, patience());
  if (pose_is_stuck) return way;
  if (twist_is_stuck) return change;
  return std::nullopt;
}

}  // namespace zwang::connect
