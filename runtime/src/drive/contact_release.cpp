#include "drive/contact_release.hpp"

#include <algorithm>
#include <cmath>

#include "schedule/braking.hpp"

namespace zwang::runtime {

namespace {

/// Each motor turns a wheel whose axle is fixed to the base's body.
bool has_only_fixed_axles(const solver::Model& model) {
  for (int j = 0; j < model.joint_count(); ++j) {
    if (!model.joint(j).actuated) continue;
    const auto is_its_wheel = [&](const solver::Wheel& wheel) { return wheel.body == j + 1; };
    if (std::ranges::none_of(model.wheels(), is_its_wheel)) return false;
    if (model.bodies()[static_cast<std::size_t>(j) + 1].parent != 0) return false;
  }
  return true;
}

}  // namespace

ContactRelease::ContactRelease(const lang::Robot& robot, double period)
    : period_(period),
      radius_(footprint_radius(robot)),
      lead_(robot.drive.time_constant),
      damping_(std::max(damping, robot.drive.contact_damping)),
      settled_(robot.drive.delay + 2.0 / robot.drive.rate +
               time_constants * (robot.drive.time_constant + robot.drive.feels.filter +
                                 ContactResponse::low_pass(robot.drive))),
      is_rigid_(has_only_fixed_axles(robot.model)),
      yd_(Eigen::VectorXd::Zero(robot.model.joint_count() + 6)),
      told_(yd_),
      felt_(yd_) {
  begin();
}

void ContactRelease::begin() noexcept {
  pause();
  since_ = way_ = 0.0;
  quiet_for_ = quiet;
  is_over_ = !is_rigid_;
}

void ContactRelease::pause() noexcept {
  yd_.setZero();
  told_.setZero();
  runs_ = false;
}

void ContactRelease::update(const ContactResponse& contact) noexcept {
  runs_ = true;
  since_ += period_;
  if (since_ < settled_) return;
  const solver::FreeMotions& motions = contact.motions();
  const int m = motions.count;
  const solver::Vector3& w = contact.force();
  felt_.head(m).noalias() = motions.base.leftCols(m).transpose() * w;
  const bool presses = w.head<2>().norm() > contact.threshold();
  const double back = -felt_.head(m).dot(contact.pressed_with());
  const bool is_answer = back > least_answer * felt_.head(m).norm() * contact.pressed_with().norm();
  quiet_for_ = presses ? 0.0 : quiet_for_ + period_;
  is_over_ = (presses && !is_answer) || quiet_for_ >= quiet || way_ >= farthest || since_ >= longest ||
             !w.allFinite();
  if (is_over_) return pause();
  told_ = yd_;
  yd_.head(m) += period_ * felt_.head(m);
  yd_ *= 1.0 / (1.0 + damping_ * period_);
  const solver::Vector3 V = motions.base.leftCols(m) * yd_.head(m);
  const double speed = V.head<2>().norm() + radius_ * std::abs(V.z());
  if (speed > fastest) yd_ *= fastest / speed;
  way_ += period_ * std::min(speed, fastest);
  told_ = yd_ + lead_ / period_ * (yd_ - told_);
}

void ContactRelease::tell(const ContactResponse& contact, Command& command) const noexcept {
  const solver::FreeMotions& motions = contact.motions();
  const int m = motions.count;
  command.velocity.noalias() = motions.joint.leftCols(m) * told_.head(m);
  command.twist.noalias() = motions.base.leftCols(m) * told_.head(m);
}

}  // namespace zwang::runtime
