#include "zwang/runtime/odometry.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "estimate/rotation.hpp"

namespace zwang::runtime {

namespace {

using solver::Matrix3;
using solver::Pose;
using solver::Vector3;

/// About z.
Matrix3 turn(double sine, double cosine) {
  Matrix3 R;
  R << cosine, -sine, 0.0, sine, cosine, 0.0, 0.0, 0.0, 1.0;
  return R;
}

/// The way along a constant planar twist for dt, by the exponential of SE(2). Its factors sin a / a and
/// (1 - cos a) / a are smooth at 0:
///   x = (sin a vx - (1 - cos a) vy) / w,   y = ((1 - cos a) vx + sin a vy) / w,   a = w dt
Pose way_along(const solver::MotionVector& twist, double dt) {
  const double a = twist.angular.z() * dt;
  const double small = a * a;
  const double sine = std::sin(a);
  const double cosine = std::cos(a);
  const double s = std::abs(a) < 1e-4 ? 1.0 - small / 6.0 : sine / a;
  const double c = std::abs(a) < 1e-4 ? a / 2.0 : (1.0 - cosine) / a;
  const double x = twist.linear.x() * dt;
  const double y = twist.linear.y() * dt;
  return {turn(sine, cosine), {s * x - c * y, c * x + s * y, 0.0}};
}

bool is_sound(const Pose& pose) {
  constexpr double largest = 1e9;  // [m]
  return (pose.position.array().abs() <= largest).all() && is_rotation(pose.rotation);
}

}  // namespace

Odometry::Odometry(const solver::Model& model, const Pose& start, const OdometrySettings& settings)
    : wheels_(model), settings_(settings), pose_(start) {
  const bool good = settings.memory > 0.0 && settings.period > 0.0 && settings.time_constant > 0.0;
  if (!good || !(settings.memory / settings.period < 1e6)) {
    throw std::invalid_argument("odometry: a setting that is not positive, or a memory of too many periods");
  }
  past_.resize(static_cast<std::size_t>(std::ceil(settings.memory / settings.period)) + 1);
}

void Odometry::start_at(const Pose& start) noexcept {
  pose_ = start;
  twist_ = {};
  started_ = false;
  updates_ = 0;
  last_correction_ = 0.0;
}

void Odometry::update(double time, solver::State& state) noexcept {
  const solver::WheelTwist seen = wheels_.twist(state);
  slip_ = seen.slip;
  if (started_) {
    const Past& last = past_[(updates_ - 1) % past_.size()];
    // The mean of both ends is exact to the second order in the period.
    const solver::MotionVector mean = (twist_ + seen.twist) * 0.5;
    pose_ = pose_ * way_along(mean, std::clamp(time - last.time, 0.0, longest_step));
  }
  started_ = true;
  twist_ = seen.twist;
  past_[updates_++ % past_.size()] = {time, pose_};
  state.base_pose = pose_;
  state.base_twist = twist_;
}

const Odometry::Past* Odometry::at(double stamp) const noexcept {
  const Past* nearest = nullptr;
  for (std::size_t i = 0; i < std::min(updates_, past_.size()); ++i) {
    const Past& past = past_[i];
    if (nearest == nullptr || std::abs(past.time - stamp) < std::abs(nearest->time - stamp)) nearest = &past;
  }
  const bool remembered =
      nearest != nullptr && std::abs(nearest->time - stamp) <= std::max(1.5 * settings_.period, 1e-9);
  return remembered ? nearest : nullptr;
}

/// The measurement says by which motion E of the world's frame the reckoning was off at the stamp. A part of
/// E is corrected now: 1 - exp(-dt/T), with the time dt since the last measurement.
///   X_WB := E^part X_WB,   E = X_measured X_then^-1
bool Odometry::correct(double stamp, const Pose& measured) noexcept {
  if (!std::isfinite(stamp) || !is_sound(measured)) return false;
  const Past* then = at(stamp);
  if (then == nullptr) return false;
  const double since = std::max(0.0, stamp - last_correction_);
  last_correction_ = stamp;
  const double part = 1.0 - std::exp(-since / settings_.time_constant);
  const double angle =
      std::remainder(solver::yaw_of(measured.rotation) - solver::yaw_of(then->pose.rotation), 2.0 * M_PI);
  const Vector3 shift = (measured.position - then->pose.position).cwiseProduct(Vector3(1.0, 1.0, 0.0));
  // About the point where the base was then: turn by the angle's part, shift by the way's.
  const Vector3 pivot = then->pose.position;
  const Pose made_good{turn(std::sin(part * angle), std::cos(part * angle)), Vector3::Zero()};
  const auto move = [&](Pose& pose) {
    pose.position = made_good.rotation * (pose.position - pivot) + pivot + part * shift;
    pose.rotation = made_good.rotation * pose.rotation;
  };
  move(pose_);
  // The remembered poses move along, or the next late measurement would be corrected twice.
  for (std::size_t i = 0; i < std::min(updates_, past_.size()); ++i) move(past_[i].pose);
  return true;
}

}  // namespace zwang::runtime
