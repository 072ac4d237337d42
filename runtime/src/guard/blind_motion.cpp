#include "guard/blind_motion.hpp"

#include <algorithm>
#include <cmath>

#include "zwang/solver/wheels.hpp"

namespace zwang::runtime {

namespace {

/// A torque of less than `friction` moves nothing, and of more only the rest counts.
double beyond(double torque, double friction) {
  return std::copysign(std::max(0.0, std::abs(torque) - friction), torque);
}

/// [m] How far what hangs on the body may be from its joint: along the tree to the frame that is farthest.
double reach_of(const solver::Model& model, int body) {
  double most = 0.0;
  for (const solver::Frame& frame : model.frames()) {
    if (frame.body == body) most = std::max(most, frame.pose_in_body.position.norm());
  }
  for (int b = body + 1; b < model.body_count(); ++b) {
    const solver::Body& next = model.bodies()[static_cast<std::size_t>(b)];
    if (next.parent == body) most = std::max(most, next.pose_in_parent.position.norm() + reach_of(model, b));
  }
  return most;
}

double radius_of(const solver::Model& model, int j, BlindMotion::Part part) {
  constexpr double least_reach = 0.1;  // [m] of a joint at the tip of an arm
  double radius = 0.0;
  for (const solver::Wheel& wheel : model.wheels()) {
    if (wheel.body == j + 1) radius = wheel.radius;
  }
  if (part == BlindMotion::Part::wheels) return radius;
  if (solver::carries_wheel(model, j + 1)) return 0.0;
  return model.joint(j).type == solver::JointType::prismatic ? 1.0
                                                             : std::max(least_reach, reach_of(model, j + 1));
}

std::vector<BlindMotion::DrivenJoint> driven_joints(const lang::Robot& robot, BlindMotion::Part part) {
  const solver::Model& model = robot.model;
  const bool is_arm = part == BlindMotion::Part::arm;
  std::vector<BlindMotion::DrivenJoint> driven;
  double count = 0.0;
  for (int j = 0; j < model.joint_count(); ++j) {
    const solver::Joint& joint = model.joint(j);
    if (!joint.actuated) continue;
    BlindMotion::DrivenJoint one{.joint = j};
    one.turns_on = joint.type == solver::JointType::continuous;
    one.radius = radius_of(model, j, part);
    count += one.radius > 0.0 ? 1.0 : 0.0;
    const auto i = static_cast<std::size_t>(j);
    const double coulomb = i < robot.friction.size() ? robot.friction[i].coulomb : 0.0;
    const double share = is_arm ? BlindMotion::least_torque_of_arm : BlindMotion::least_torque;
    const double least = std::isfinite(joint.max_effort) ? share * joint.max_effort : 0.0;
    if (one.radius > 0.0 && std::isfinite(joint.max_effort)) one.effort = joint.max_effort;
    one.friction = std::max(coulomb, least);
    if (is_arm && one.radius > 0.0 && joint.lower < joint.upper)
      one.lower = joint.lower, one.upper = joint.upper;
    driven.push_back(one);
  }
  for (BlindMotion::DrivenJoint& one : driven)
    one.limit =
        std::min(model.joint(one.joint).max_effort, robot.stop.force / std::max(1.0, count) * one.radius);
  return driven;
}

}  // namespace

BlindMotion::BlindMotion(const lang::Robot& robot, Part part)
    : joints_(driven_joints(robot, part)),
      part_(part),
      T_factor_(robot.model.joint_count() + 6),
      C_factor_(robot.model.joint_count() + 6),
      wheel_factor_(static_cast<Eigen::Index>(joints_.size())) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (!solver::carries_wheel(robot.model, joints_[i].joint + 1)) arm_.push_back(i);
    is_empty_ = is_empty_ && joints_[i].radius <= 0.0;
  }
  const auto n = static_cast<Eigen::Index>(joints_.size());
  const Eigen::Index most = robot.model.joint_count() + 6;
  T_ = Eigen::MatrixXd::Zero(n, most);
  B_ = Eigen::MatrixXd::Zero(3, most);
  C_turned_ = Eigen::MatrixXd::Zero(most, 3 + static_cast<Eigen::Index>(arm_.size()));
  T_wheels_turned_ = Eigen::MatrixXd::Zero(most, n);
  a_ = lost_ = right_ = Eigen::VectorXd::Zero(most);
  expected_ = torques_ = Eigen::VectorXd::Zero(n);
}

double BlindMotion::norm_of_row(std::size_t joint) const noexcept {
  return T_.row(static_cast<Eigen::Index>(joint)).head(m_).norm();
}

/// The weights that an arm's joints bear, and the ends on which they rest.
void BlindMotion::find_weights(const solver::State& state) noexcept {
  if (part_ != Part::arm) return;
  for (DrivenJoint& driven : joints_) {
    if (driven.radius <= 0.0) continue;
    const double q = state.q(driven.joint);
    driven.weight = state.tau_ff(driven.joint);
    driven.way_out = q < driven.lower + rest ? 1 : q > driven.upper - rest ? -1 : 0;
  }
}

/// Each end pushes as hard as it takes, and never pulls: y + T_j' l, l >= 0.
void BlindMotion::keep_in_travel(Eigen::VectorXd& y) const noexcept {
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      if (joints_[i].way_out == 0) continue;
      const auto row = T_.row(static_cast<Eigen::Index>(i)).head(m_);
      const double rate = row.dot(y.head(m_)), norm = row.squaredNorm();
      if (rate * joints_[i].way_out < 0.0 && norm > 0.0) y.head(m_) -= rate / norm * row.transpose();
    }
  }
}

/// They stay while no mass moves in the base's axes, as on a base of round wheels.
void BlindMotion::take_motions(const solver::FreeMotions& motions) noexcept {
  if (factorisation_ == motions.factorisation && m_ == motions.count) return;
  factorisation_ = motions.factorisation;
  m_ = motions.count;
  const auto n = static_cast<Eigen::Index>(joints_.size());
  B_.leftCols(m_) = motions.base.leftCols(m_);
  for (Eigen::Index i = 0; i < n; ++i)
    T_.row(i).head(m_) = motions.joint.row(joints_[static_cast<std::size_t>(i)].joint).head(m_);
  for (int a = 0; a < m_; ++a) {
    for (int row = 0; row < 3; ++row) C_turned_(a, row) = B_(row, a);
    for (std::size_t i = 0; i < arm_.size(); ++i)
      C_turned_(a, 3 + static_cast<Eigen::Index>(i)) = T_(static_cast<Eigen::Index>(arm_[i]), a);
  }
  T_factor_.factorise(T_, n, m_);
  C_factor_.factorise(C_turned_, m_, C_turned_.cols());
}

void BlindMotion::expect(const DisturbanceObserver& model, const Eigen::VectorXd& friction,
                         const Eigen::VectorXd& sent, const solver::State& state) noexcept {
  if (is_empty_) return;
  find_weights(state);
  take_motions(model.motions());
  const auto n = static_cast<Eigen::Index>(joints_.size());
  for (Eigen::Index i = 0; i < n; ++i)
    expected_(i) = model.expected()(joints_[static_cast<std::size_t>(i)].joint);
  to_motions(expected_, a_);
  bool is_told = false;
  lost_.head(m_).setZero();
  for (Eigen::Index i = 0; i < n; ++i) {
    const DrivenJoint& driven = joints_[static_cast<std::size_t>(i)];
    if (driven.radius <= 0.0) continue;
    const double told = sent(driven.joint) - driven.weight;
    const double torque = beyond(told, driven.friction + weight_error * std::abs(driven.weight));
    is_told = is_told || torque != 0.0;
    const double more = torque - (told - friction(driven.joint));
    (more * torque > 0.0 ? a_ : lost_).head(m_) += more * T_.row(i).head(m_).transpose();
  }
  // Friction takes motion away and makes none: where torques only hold what an arm does to the base, there is
  // none to take.
  const double all = a_.head(m_).norm();
  const double left = std::max(0.0, all - lost_.head(m_).norm());
  a_.head(m_) *= all > 0.0 ? left / all : 0.0;
  if (!is_told) a_.setZero();
  keep_in_travel(a_);
}

void BlindMotion::expect_brake(const Eigen::VectorXd& sent) noexcept {
  if (is_empty_) return;
  a_.head(m_).setZero();
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i].radius <= 0.0) continue;
    const double torque = beyond(sent(joints_[i].joint) - joints_[i].weight, joints_[i].friction);
    a_.head(m_) += torque * T_.row(static_cast<Eigen::Index>(i)).head(m_).transpose();
  }
}

void BlindMotion::to_motions(const Eigen::VectorXd& rates, Eigen::VectorXd& y) noexcept {
  for (int a = 0; a < m_; ++a) right_(a) = dot(T_.col(a).data(), rates.data(), T_.rows());
  T_factor_.solve(right_, y);
}

void BlindMotion::to_rates(const Eigen::VectorXd& y, Eigen::VectorXd& rates) const noexcept {
  rates = T_.leftCols(m_).lazyProduct(y.head(m_));
}

void BlindMotion::to_wrench(const Eigen::VectorXd& p, Eigen::VectorXd& w) noexcept {
  for (Eigen::Index a = 0; a < C_turned_.cols(); ++a) right_(a) = dot(C_turned_.col(a).data(), p.data(), m_);
  C_factor_.solve(right_, w);
}

void BlindMotion::to_force(const Eigen::VectorXd& w, Eigen::VectorXd& p) const noexcept {
  p.head(m_) = C_turned_.topRows(m_).lazyProduct(w);
}

/// Of the torques that make T' tau = -yd / time as nearly as wheels can, the smallest:
///   (T T') tau = -T yd / time.
bool BlindMotion::to_stop(const Eigen::VectorXd& y, double time, Eigen::VectorXd& tau) noexcept {
  const auto n = static_cast<Eigen::Index>(joints_.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool is_counted = joints_[static_cast<std::size_t>(i)].radius > 0.0;
    for (int a = 0; a < m_; ++a) T_wheels_turned_(a, i) = is_counted ? T_(i, a) : 0.0;
    torques_(i) = -dot(T_wheels_turned_.col(i).data(), y.data(), m_) / time;
  }
  wheel_factor_.factorise(T_wheels_turned_, m_, n);
  wheel_factor_.solve(torques_, torques_);
  double share = 1.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double limit = joints_[static_cast<std::size_t>(i)].limit;
    if (std::abs(torques_(i)) > limit) share = std::min(share, limit / std::abs(torques_(i)));
  }
  bool is_felt = false;
  for (Eigen::Index i = 0; i < n; ++i) {
    torques_(i) *= share;
    is_felt = is_felt || std::abs(torques_(i)) > joints_[static_cast<std::size_t>(i)].friction;
  }
  is_felt = is_felt && torques_.allFinite();
  for (Eigen::Index i = 0; i < n; ++i) {
    const DrivenJoint& driven = joints_[static_cast<std::size_t>(i)];
    if (driven.radius <= 0.0) continue;
    const double over = std::clamp(torques_(i), -driven.friction, driven.friction);
    tau(driven.joint) = driven.weight + (is_felt ? torques_(i) + over : 0.0);
  }
  return is_felt;
}

}  // namespace zwang::runtime
