#include "drive/contact_response.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::runtime {

ContactResponse::ContactResponse(const lang::Robot& robot, double period)
    : period_(period),
      drive_(robot.drive),
      filter_(low_pass(robot.drive)),
      motions_(robot.model),
      base_factor_(robot.model.joint_count() + 6),
      base_(Eigen::MatrixXd::Zero(3, robot.model.joint_count() + 6)),
      y_(Eigen::VectorXd::Zero(robot.model.joint_count() + 6)),
      right_(y_),
      pressed_with_(y_) {
  if (const auto frame = robot.model.find_frame(drive_.feels.frame))
    sensor_ = robot.model.frames()[static_cast<std::size_t>(*frame)].pose_in_body;
  if (drive_.feels.by == lang::Feels::By::effort) effort_.emplace(robot);
  // A first-order low pass of white samples, one in a cycle.
  const double a = std::exp(-1.0 / (drive_.rate * filter_));
  threshold_ = sigmas * std::sqrt((1.0 - a) / (1.0 + a)) * (effort_ ? effort_->noise() : drive_.feels.noise);
  if (effort_) threshold_ += effort_->unknown_friction();
}

bool ContactResponse::can_feel(const Sensed& sensed) const noexcept {
  if (effort_) return effort_->can_feel(sensed);
  return sensed.contact_wrench && sensed.contact_wrench->linear.allFinite() &&
         sensed.contact_wrench->angular.allFinite();
}

void ContactResponse::begin() noexcept {
  w_.setZero();
  creep_.setZero();
  felt_at_ = -solver::infinity;
  pressed_for_ = 0.0;
  velocity_.setZero();
  acceleration_.setZero();
  if (effort_) effort_->begin();
}

solver::Vector3 ContactResponse::felt_wrench(const Sensed& sensed) const noexcept {
  const solver::Vector3 force = sensor_.rotation * sensed.contact_wrench->linear;
  const solver::Vector3 moment =
      sensor_.rotation * sensed.contact_wrench->angular + sensor_.position.cross(force);
  return {force.x(), force.y(), moment.z()};
}

void ContactResponse::feel(const Sensed& sensed, double stamp) noexcept {
  const double since = std::min(stamp - felt_at_, 1.0);
  felt_at_ = stamp;
  const solver::Vector3 felt = effort_ ? effort_->feel(sensed, stamp) : felt_wrench(sensed);
  w_ -= std::expm1(-since / filter_) * (felt - w_);
}

double ContactResponse::threshold(const solver::State& state) noexcept {
  if (!effort_) return threshold_;
  const solver::Vector3& v = state.base_twist.linear;
  acceleration_ -= std::expm1(-period_ / accelerated_over) * ((v - velocity_) / period_ - acceleration_);
  velocity_ = v;
  const double mass = 1.0 / (drive_.mass_factor * motions_.base.row(0).head(motions_.count).squaredNorm());
  return threshold_ + share_of_inertia * mass * acceleration_.head<2>().norm();
}

/// ydd = T' tau.
void ContactResponse::take_off_beyond(const Eigen::VectorXd& most,
                                      const solver::Solution& solution) noexcept {
  const int m = motions_.count;
  for (Eigen::Index j = 0; j < most.size(); ++j) {
    const double beyond = solution.tau(j) - std::clamp(solution.tau(j), -most(j), most(j));
    if (beyond != 0.0) y_.head(m).noalias() -= beyond * motions_.joint.row(j).head(m).transpose();
  }
}

void ContactResponse::accelerate(const solver::Solver& solver, const solver::Solution& solution,
                                 const solver::State& state, const Eigen::VectorXd& most,
                                 Eigen::VectorXd& qdd) noexcept {
  if (solver.free_motions(motions_)) {
    base_.leftCols(motions_.count) = motions_.base.leftCols(motions_.count);
    base_factor_.factorise(base_, 3, motions_.count);
  }
  if (effort_) effort_->follow(motions_, solution);
  const int m = motions_.count;
  pressed_with_.head(m).noalias() = motions_.joint.leftCols(m).transpose() * solution.tau;
  y_.head(m).noalias() = motions_.base.leftCols(m).transpose() * w_;
  pressed_for_ = w_.head<2>().norm() > threshold(state) ? pressed_on : std::max(0.0, pressed_for_ - period_);
  if (is_pressed()) {
    take_off_beyond(most, solution);
    const solver::Vector3 V(state.base_twist.linear.x(), state.base_twist.linear.y(),
                            state.base_twist.angular.z());
    for (int k = 0; k < 3; ++k) {
      const bool is_slow = std::abs(V(k)) < (k < 2 ? slow : slow_turn);
      creep_(k) += period_ / taken_over_within * ((is_slow ? V(k) : 0.0) - creep_(k));
    }
    const solver::Vector3 fades = V - creep_;
    right_.head(m).noalias() = motions_.base.leftCols(m).transpose() * fades;
    base_factor_.solve(right_, right_);
    y_.head(m) -= drive_.contact_damping * right_.head(m);
  } else {
    creep_.setZero();
  }
  qdd.noalias() += motions_.joint.leftCols(m) * y_.head(m);
}

}  // namespace zwang::runtime
