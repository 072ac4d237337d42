#include "guard/wheel_brake.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimate/ticks.hpp"
#include "schedule/braking.hpp"

namespace zwang::runtime {

WheelBrake::WheelBrake(const lang::Robot& robot, double period)
    : inertia_(planar_inertia(robot.model)),
      period_(period),
      last_qd_(Eigen::VectorXd::Zero(robot.model.joint_count())),
      newest_qd_(last_qd_),
      deceleration_(robot.stop.deceleration),
      footprint_radius_(footprint_radius(robot)),
      first_qd_(last_qd_),
      last_look_(last_qd_),
      ticks_between_looks_(ticks_of(look_every, period)) {
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    const int j = wheel.body - 1;
    const solver::Joint& joint = robot.model.joint(j);
    if (!joint.actuated || !(joint.max_effort > 0.0)) continue;
    const solver::Body& body = robot.model.bodies()[static_cast<std::size_t>(wheel.body)];
    const double spin = joint.axis.dot(body.inertia.rotational * joint.axis) + joint.rotor_inertia;
    wheels_.push_back({.joint = j, .radius = wheel.radius, .limit = joint.max_effort, .spin = spin});
  }
  const double force = robot.stop.force / std::max<double>(1.0, static_cast<double>(wheels_.size()));
  for (DrivenWheel& wheel : wheels_) wheel.limit = std::min(wheel.limit, force * wheel.radius);
}

void WheelBrake::begin(int suspect, double believed) noexcept {
  left_out_ = -1;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    if (wheels_[i].joint == suspect) left_out_ = static_cast<int>(i);
  }
  believed_ = left_out_ < 0 ? 0.0 : believed;
  is_suspected_only_ = left_out_ >= 0 && believed == 0.0;
  may_be_mistaken_ = believed_ > 0.0 && std::isfinite(believed_);
  slope_is_due_ = left_out_ < 0;
  slope_time_ = slope_for_ = 0.0;
  has_obeyed_ = false;
  first_left_out_ = left_out_;
  first_sense_ = 0.0;
  begin_anew();
  ticks_ = ticks_between_looks_;  // the first look is what the others compare with
  last_sum_ = least_sum_ = std::numeric_limits<double>::infinity();
}

void WheelBrake::begin_turned_around() noexcept {
  begin(-1, 0.0);
  first_left_out_ = all();
  first_sense_ = -1.0;
  begin_anew();
  slope_is_due_ = false;
}

/// With the motors that the stop's reason leaves out, as far as they have not obeyed since.
void WheelBrake::begin_anew() noexcept {
  left_out_ = has_obeyed_ ? -1 : first_left_out_;
  sense_ = first_sense_;
  may_turn_ = true;
  looks_turned_ = drives_ = 0;
  even_looks_ = 0;
  tried_ = 0;
}

/// From the last sample.
void WheelBrake::begin_slope() noexcept {
  slope_is_due_ = false;
  first_qd_ = newest_qd_;
  const double speed =
      std::max(newest_twist_.linear.norm(), footprint_radius_ * std::abs(newest_twist_.angular.z()));
  slope_time_ = speed / deceleration_;
  slope_for_ = 0.0;
}

/// The part of its rate that the wheel may keep now; 0 where it has turned around. [rad/s]
double WheelBrake::allowed_rate(const DrivenWheel& wheel, double rate) const noexcept {
  const double first = first_qd_(wheel.joint);
  return is_on_slope() && rate * first > 0.0 ? (1.0 - slope_for_ / slope_time_) * std::abs(first) : 0.0;
}

void WheelBrake::look(const Eigen::VectorXd& qd) noexcept {
  ++looks_turned_;
  double sum = 0.0;
  for (const DrivenWheel& wheel : wheels_) {
    const double rim = wheel.radius * qd(wheel.joint);
    sum += rim * rim;
  }
  const auto count = static_cast<int>(wheels_.size());
  if (sum > growth * least_sum_ && sum > count * slow * slow) {
    least_sum_ = sum;
    if (sense_ == 0.0) drives_ = 0;
    if (sense_ != 0.0 && is_suspected_only_) {
      brake_with_the_suspect();
    } else if (sense_ != 0.0 && may_be_mistaken_ && left_out_ == first_left_out_) {
      take_a_drive(std::sqrt(sum));
    } else if (sense_ != 0.0) {
      sense_ = 0.0;
      may_turn_ = false;
    } else if (left_out_ == all()) {
      begin_anew();
    } else if (sum > count * believed_ * believed_) {
      tried_ == 0 ? leave_out_the_fastest(qd) : leave_out_the_next();
    }
  }
  last_look_ = qd;
  least_sum_ = std::min(sum, forgotten * least_sum_);
  if (sum < count * slow * slow) tried_ = 0;
  const bool rolls_on = !is_on_slope() && sum > evenly * last_sum_ && sum > count * rest * rest;
  if (!rolls_on || even_looks_ == 0) even_from_ = std::sqrt(last_sum_);
  even_looks_ = rolls_on ? even_looks_ + 1 : 0;
  last_sum_ = sum;
  if (even_looks_ < even_looks || left_out_ < 0) return;
  if (may_turn_ && sense_ == 0.0) {
    sense_ = -1.0;
    looks_turned_ = 0;
    turned_at_ = std::sqrt(sum);
    gain_before_ = (turned_at_ - even_from_) / even_looks_;
  }
  if (sense_ == 0.0 && left_out_ == all() && !has_tried_all()) leave_out_the_next();
}

/// The reversed torque drove the base: the motor obeys its command.
void WheelBrake::brake_with_the_suspect() noexcept {
  is_suspected_only_ = false;
  left_out_ = -1;
  sense_ = 0.0;
  even_looks_ = 0;
}

/// The wheels got faster under the reversed torque. By a push they do so at any time, and without that
/// torque, too.
void WheelBrake::take_a_drive(double speed) noexcept {
  const double gain = (speed - turned_at_) / looks_turned_;
  drives_ = gain > most_by_a_push * gain_before_ ? drives_ + 1 : 0;
  sense_ = 0.0;
  even_looks_ = 0;
  if (drives_ == drives) brake_with_the_accused();
}

/// A motor that was taken for lost or reversed brakes likewise. The growth can have another source, as a wall
/// that gives back. So the brake is soft, and from now on any growth leaves out another motor.
void WheelBrake::brake_with_the_accused() noexcept {
  brake_with_the_suspect();
  is_suspected_only_ = has_obeyed_ = true;
  may_be_mistaken_ = false;
  believed_ = 0.0;
}

/// Of the wheels that were told to brake, the one whose rate grew most since the last look.
void WheelBrake::leave_out_the_fastest(const Eigen::VectorXd& qd) noexcept {
  int fastest = -1;
  double most = 0.0;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const DrivenWheel& wheel = wheels_[i];
    if (static_cast<int>(i) == left_out_) continue;
    const double grown = wheel.radius * (std::abs(qd(wheel.joint)) - std::abs(last_look_(wheel.joint)));
    if (grown > most) {
      most = grown;
      fastest = static_cast<int>(i);
    }
  }
  if (fastest < 0 || left_out_ == all()) return leave_out_the_next();
  ++tried_;
  left_out_ = fastest;
  may_turn_ = true;
  even_looks_ = 0;
}

void WheelBrake::leave_out_the_next() noexcept {
  ++tried_;
  left_out_ = left_out_ < all() ? left_out_ + 1 : -1;
  if (has_tried_all()) left_out_ = all();
  may_turn_ = !has_tried_all();
  even_looks_ = 0;
}

void WheelBrake::brake(const Eigen::VectorXd& qd, Eigen::VectorXd& tau) noexcept {
  if (slope_is_due_) begin_slope();
  if (++ticks_ >= ticks_between_looks_) {
    ticks_ = 0;
    look(qd);
  }
  put(qd, 1.0, tau);
  slope_for_ += period_;
}

/// The torques against `share` of what the rates are beyond the slope.
void WheelBrake::put(const Eigen::VectorXd& qd, double share, Eigen::VectorXd& tau) const noexcept {
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const DrivenWheel& wheel = wheels_[i];
    const double rate = qd(wheel.joint);
    const double beyond = std::max(0.0, std::abs(rate) - allowed_rate(wheel, rate));
    const double full = is_suspected_only_ ? soft_brake_speed : full_brake_speed;
    const double damped = -wheel.limit / full * share * std::copysign(beyond, rate);
    const bool is_left_out = left_out_ == static_cast<int>(i) || left_out_ == all();
    const double sense = is_left_out ? sense_ : 1.0;
    tau(wheel.joint) = sense * std::clamp(damped, -wheel.limit, wheel.limit);
  }
}

void WheelBrake::remember(const solver::State& state) noexcept {
  last_qd_ = newest_qd_;
  last_twist_ = newest_twist_;
  newest_qd_ = state.qd;
  newest_twist_ = state.base_twist;
  blind_for_ = 0.0;
}

void WheelBrake::brake_blind(Eigen::VectorXd& tau) noexcept {
  slope_is_due_ = left_out_ < 0;
  if (blind_for_ <= 0.0) {
    double power = 0.0;
    for (const DrivenWheel& wheel : wheels_) power += wheel.limit * std::abs(last_qd_(wheel.joint));
    const double energy = kinetic_energy();
    blind_stop_ = power > 0.0 ? 2.0 * energy / power : 0.0;
    // A body of the robot's mass and of this energy slows down with v / (2 T / P).
    const double slowest_stop = std::sqrt(2.0 * energy / inertia_.mass) / deceleration_;
    blind_share_ = std::min(1.0, blind_stop_ / std::max(slowest_stop, 1e-9));
    blind_stop_ /= std::max(blind_share_, 1e-9);
    slope_time_ = 0.0;
  }
  if (blind_for_ < trusted * blind_stop_) {
    put(last_qd_, 1.0 - blind_for_ / blind_stop_, tau);
    for (const DrivenWheel& wheel : wheels_) tau(wheel.joint) *= blind_share_;
  }
  blind_for_ += period_;
}

/// Of the last sample: T = 1/2 m v.v + v.(w x h) + 1/2 J w^2 with the first moment h, and what the wheels
/// spin.
double WheelBrake::kinetic_energy() const noexcept {
  const Eigen::Vector2d v = last_twist_.linear.head<2>();
  const double w = last_twist_.angular.z();
  const Eigen::Vector2d& h = inertia_.first_moment;
  double twice =
      inertia_.mass * v.squaredNorm() + 2.0 * w * (v.y() * h.x() - v.x() * h.y()) + inertia_.yaw * w * w;
  for (const DrivenWheel& wheel : wheels_)
    twice += wheel.spin * last_qd_(wheel.joint) * last_qd_(wheel.joint);
  return 0.5 * twice;
}

WheelBrake::PlanarInertia WheelBrake::planar_inertia(const solver::Model& model) {
  PlanarInertia sum;
  std::vector<solver::Pose> poses;
  for (const solver::Body& body : model.bodies()) {
    solver::Pose pose = body.pose_in_parent;
    if (!poses.empty()) {
      const solver::Pose& parent = poses[static_cast<std::size_t>(body.parent)];
      pose.position = parent.position + parent.rotation * pose.position;
      pose.rotation = parent.rotation * pose.rotation;
    }
    poses.push_back(pose);
    const solver::Matrix3& R = pose.rotation;
    const Eigen::Vector2d p = pose.position.head<2>();
    const Eigen::Vector2d h = (R * body.inertia.first_moment).head<2>();
    sum.mass += body.inertia.mass;
    sum.first_moment += h + body.inertia.mass * p;
    sum.yaw += R.row(2).dot(body.inertia.rotational * R.row(2).transpose()) + 2.0 * p.dot(h) +
               body.inertia.mass * p.squaredNorm();
  }
  return sum;
}

}  // namespace zwang::runtime
