#include "drive/virtual_robot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zwang::runtime {

namespace {

solver::Vector3 planar(const solver::MotionVector& motion) {
  return {motion.linear.x(), motion.linear.y(), motion.angular.z()};
}

}  // namespace

LoopInput::LoopInput(const lang::Drive& drive, double period, Eigen::Index count)
    : period_(period),
      time_constant_(drive.time_constant),
      integral_time_(drive.integral_time),
      past_(Eigen::MatrixXd::Zero(
          count, drive.feels_contact() ? 1L : std::max(1L, std::lround(1.0 / (drive.rate * period))))),
      acceleration_(Eigen::VectorXd::Zero(count)),
      made_up_(acceleration_),
      value_(acceleration_) {}

void LoopInput::begin(const Eigen::Ref<const Eigen::VectorXd>& velocity) noexcept {
  for (Eigen::Index i = 0; i < past_.cols(); ++i) past_.col(i) = velocity;
  made_up_.setZero();
  value_ = velocity;
}

void LoopInput::update(const Eigen::Ref<const Eigen::VectorXd>& velocity, bool is_pressed) noexcept {
  acceleration_ = (velocity - past_.col(oldest_)) / (period_ * static_cast<double>(past_.cols()));
  past_.col(oldest_) = velocity;
  oldest_ = (oldest_ + 1) % past_.cols();
  if (integral_time_ && is_pressed) made_up_ *= std::exp(-period_ / *integral_time_);
  if (integral_time_ && !is_pressed)
    made_up_ -= std::expm1(-period_ / *integral_time_) * (acceleration_ - made_up_);
  value_ = time_constant_ * (acceleration_ - made_up_);
  for (Eigen::Index i = 0; i < past_.cols(); ++i) value_ += past_.col(i) / static_cast<double>(past_.cols());
}

VirtualRobot::VirtualRobot(const lang::Robot& robot, double period)
    : period_(period),
      lag_(0.5 * robot.drive.delay + 0.5 / robot.drive.rate),
      state_(robot.model),
      pose_(robot.model, {}, {.memory = memory, .period = period, .time_constant = corrected_within}),
      wheels_(robot.drive, period, robot.model.joint_count()),
      base_(robot.drive, period, 3),
      qdd_(Eigen::VectorXd::Zero(robot.model.joint_count())) {
  if (robot.drive.feels_contact()) {
    contact_.emplace(robot, period);
    release_.emplace(robot, period);
  }
  // The command of a tick has the velocity at its end.
  lag_ = std::max(0.0, lag_ + wheels_.age() - period);
  for (int j = 0; j < robot.model.joint_count(); ++j)
    turns_.push_back(robot.model.joint(j).type != solver::JointType::prismatic);
  past_.resize(static_cast<std::size_t>(std::ceil(memory / period)) + 1, {-1.0, state_.q});
}

void VirtualRobot::begin(const solver::State& state, double time) noexcept {
  state_ = state;
  pose_.start_at(state.base_pose);
  pose_.update(time, state_);
  wheels_.begin(state_.qd);
  base_.begin(planar(state_.base_twist));
  if (contact_) contact_->begin();
  if (release_) release_->begin();
  updates_ = 0;
  corrected_at_ = time;
  has_begun_ = true;
}

void VirtualRobot::correct(const solver::State& measured, double stamp) noexcept {
  const double then = stamp - lag_;
  const double since = then - corrected_at_;
  if (!(since > 0.0) || !pose_.correct(then, measured.base_pose)) return;
  corrected_at_ = then;
  correct_joints(measured.q, then, -std::expm1(-since / corrected_within));
  state_.base_pose = pose_.pose();
}

/// The remembered positions move along, as in Odometry.
void VirtualRobot::correct_joints(const Eigen::VectorXd& measured, double then, double part) noexcept {
  const std::size_t known = std::min(updates_, past_.size());
  std::size_t nearest = known;
  for (std::size_t i = 0; i < known; ++i) {
    if (nearest == known || std::abs(past_[i].time - then) < std::abs(past_[nearest].time - then))
      nearest = i;
  }
  if (nearest == known) return;
  for (Eigen::Index j = 0; j < measured.size(); ++j) {
    const double off = measured(j) - past_[nearest].q(j);
    const bool is_turn = turns_[static_cast<std::size_t>(j)];
    const double change = part * (is_turn ? std::remainder(off, 2.0 * std::numbers::pi) : off);
    state_.q(j) += change;
    for (std::size_t i = 0; i < known; ++i) past_[i].q(j) += change;
  }
}

void VirtualRobot::put(solver::State& state) const noexcept {
  state.q = state_.q;
  state.qd = state_.qd;
  state.base_pose = state_.base_pose;
  state.base_twist = state_.base_twist;
}

void VirtualRobot::move(const solver::State& state, const solver::Solver& solver,
                        const solver::Solution& solution, const Eigen::VectorXd& most, double time) noexcept {
  qdd_ = solution.qdd;
  if (contact_) contact_->accelerate(solver, solution, state, most, qdd_);
  const bool is_pressed = contact_ && contact_->is_pressed();
  state_.q = state.q + period_ * (state.qd + 0.5 * period_ * qdd_);
  state_.qd = state.qd + period_ * qdd_;
  pose_.update(time, state_);
  Past& now = past_[updates_++ % past_.size()];
  now.time = time;
  now.q = state_.q;
  wheels_.update(state_.qd, is_pressed);
  base_.update(planar(state_.base_twist), is_pressed);
}

void VirtualRobot::let_go(Command& command) noexcept {
  contact_->rest();
  release_->update(*contact_);
  if (!release_->is_over()) release_->tell(*contact_, command);
}

void VirtualRobot::tell(Command& command) const noexcept {
  command.velocity = wheels_.value();
  command.twist = base_.value();
}

}  // namespace zwang::runtime
