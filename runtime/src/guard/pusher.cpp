#include "guard/pusher.hpp"

namespace zwang::runtime {

Pusher::Pusher(const lang::Robot& robot, double period)
    : motors_(wheel_motors(robot, smallest)),
      most_told_(Eigen::VectorXd::Zero(robot.model.joint_count())),
      period_(period) {}

void Pusher::reset() noexcept {
  has_begun_ = false;
  is_at_work_ = false;
}

void Pusher::look(const DisturbanceObserver& observer, double power, const Eigen::VectorXd& rates) noexcept {
  const solver::FreeMotions& motions = observer.motions();
  const auto told = observer.torque().cwiseAbs();
  if (observer.force().head(motions.count).norm() < least_force(motors_, motions)) {
    most_told_ = told;
    excess_ = 0.0;
    has_begun_ = true;
    is_at_work_ = false;
    return;
  }
  if (!has_begun_) return;
  most_told_ = most_told_.cwiseMax(told);
  excess_ += period_ * (power - (most_told_ + told).dot(rates.cwiseAbs()));
  is_at_work_ = is_at_work_ || excess_ > least;
}

}  // namespace zwang::runtime
