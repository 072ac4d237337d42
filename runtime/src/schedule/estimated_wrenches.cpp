#include "schedule/estimated_wrenches.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "schedule/signal_table.hpp"

namespace zwang::runtime {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double damping = 1e-9;  // of the trace: keeps a direction without a measurement at 0

}  // namespace

EstimatedWrenches::EstimatedWrenches(const solver::Model& model)
    : model_(model),
      moving_(model),
      bodies_(static_cast<std::size_t>(model.body_count())),
      J_turned_(Eigen::MatrixXd::Zero(6 + model.joint_count(), 6)) {}

void EstimatedWrenches::ask(int frame) {
  const bool is_asked = std::ranges::any_of(asked_, [&](const Asked& asked) { return asked.frame == frame; });
  if (!is_asked) asked_.push_back({frame, false, {}});
}

/// The twist of the frame in its own axes, along each free motion, is a column of J.
solver::ForceVector EstimatedWrenches::wrench_on(int frame, const solver::FreeMotions& motions,
                                                 const Eigen::VectorXd& p,
                                                 const FrameTable& frames) noexcept {
  for (int a = 0; a < motions.count; ++a) {
    moving_.base_twist = {{0.0, 0.0, motions.base(2, a)}, {motions.base(0, a), motions.base(1, a), 0.0}};
    moving_.qd = motions.joint.col(a);
    bodies_.start(model_, moving_);
    const solver::MotionVector twist = bodies_.of(frames.attached(frame)).own_twist();
    J_turned_.row(a) << twist.angular.transpose(), twist.linear.transpose();
  }
  const auto J_turned = J_turned_.topRows(motions.count);
  Matrix6 normal = J_turned.transpose().lazyProduct(J_turned);
  normal.diagonal().array() += damping * normal.trace();
  const Vector6 right = J_turned.transpose().lazyProduct(p.head(motions.count));
  const Vector6 w = normal.llt().solve(right);
  return {w.head<3>(), w.tail<3>()};
}

void EstimatedWrenches::estimate(const solver::FreeMotions& motions, const Eigen::VectorXd& p,
                                 const solver::State& state, const FrameTable& frames, double dt) noexcept {
  const bool any =
      std::ranges::any_of(asked_, [&](const Asked& asked) { return frames.attached(asked.frame).body > 0; });
  if (!any) return;
  moving_ = state;
  for (Asked& asked : asked_) {
    if (frames.attached(asked.frame).body <= 0) continue;
    const solver::ForceVector now = wrench_on(asked.frame, motions, p, frames);
    if (!now.angular.allFinite() || !now.linear.allFinite()) continue;
    const double share = 1.0 - std::exp(-dt / time_constant);
    asked.wrench.angular += share * (now.angular - asked.wrench.angular);
    asked.wrench.linear += share * (now.linear - asked.wrench.linear);
    asked.is_known = true;
  }
}

void EstimatedWrenches::take_base_force(const solver::Vector3& force, const FrameTable& frames) noexcept {
  for (Asked& asked : asked_) {
    const solver::AttachedFrame& frame = frames.attached(asked.frame);
    if (frame.body != 0) continue;
    const solver::Vector3 linear{force.x(), force.y(), 0.0};
    const solver::Vector3 angular = solver::Vector3{0.0, 0.0, force.z()} - frame.pose.position.cross(linear);
    asked.wrench = {frame.pose.rotation.transpose() * angular, frame.pose.rotation.transpose() * linear};
    asked.is_known = force.allFinite();
  }
}

double EstimatedWrenches::part(int frame, lang::WrenchPart part) const noexcept {
  const auto found = std::ranges::find(asked_, frame, &Asked::frame);
  if (found == asked_.end() || !found->is_known) return std::numeric_limits<double>::quiet_NaN();
  return part_of(found->wrench, part);
}

}  // namespace zwang::runtime
