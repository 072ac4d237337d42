#include "schedule/pose_line.hpp"

#include <Eigen/Geometry>

namespace zwang::runtime {

namespace {

using solver::Matrix3;
using solver::Vector3;

Vector3 rotation_vector(const Matrix3& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

Matrix3 rotation_by(const Vector3& vector) {
  const double angle = vector.norm();
  if (!(angle > 0.0)) return Matrix3::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

}  // namespace

void PoseLine::add(double time, const solver::Pose& pose) noexcept {
  const double spacing = window_ / static_cast<double>(most - 2);
  const bool replaces = count_ > 1 && sample(0).time - sample(1).time < spacing;
  if (!replaces) {
    newest_ = (newest_ + 1) % most;
    if (count_ < most) ++count_;
  }
  samples_[newest_] = {time, pose};
}

solver::FrameMotion PoseLine::at_newest() const noexcept {
  const Sample& last = sample(0);
  solver::FrameMotion motion{last.pose, Vector3::Zero(), Vector3::Zero()};
  double n = 0.0, sum_t = 0.0, sum_tt = 0.0;
  Vector3 sum_p = Vector3::Zero(), sum_tp = Vector3::Zero(), sum_r = Vector3::Zero(),
          sum_tr = Vector3::Zero();
  double span = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const double t = sample(i).time - last.time;
    if (-t > window_) break;
    const Vector3 p = sample(i).pose.position - last.pose.position;
    const Vector3 r = rotation_vector(sample(i).pose.rotation * last.pose.rotation.transpose());
    n += 1.0;
    sum_t += t;
    sum_tt += t * t;
    sum_p += p;
    sum_tp += t * p;
    sum_r += r;
    sum_tr += t * r;
    span = -t;
  }
  const double spread = n * sum_tt - sum_t * sum_t;
  if (span < 0.5 * window_ || !(spread > 0.0)) return motion;
  motion.linear = (n * sum_tp - sum_t * sum_p) / spread;
  motion.angular = (n * sum_tr - sum_t * sum_r) / spread;
  motion.pose.position += (sum_p - sum_t * motion.linear) / n;
  motion.pose.rotation = rotation_by((sum_r - sum_t * motion.angular) / n) * motion.pose.rotation;
  return motion;
}

solver::FrameMotion carried_on(const solver::FrameMotion& motion, double dt) noexcept {
  solver::FrameMotion later = motion;
  later.pose.position += dt * motion.linear;
  later.pose.rotation = rotation_by(dt * motion.angular) * motion.pose.rotation;
  return later;
}

}  // namespace zwang::runtime
