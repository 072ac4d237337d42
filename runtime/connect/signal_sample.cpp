#include "signal_sample.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "transforms.hpp"

namespace zwang::connect {

using runtime::SignalSample;

namespace {

SignalSample valid_sample(lang::SignalType type, double stamp) {
  SignalSample sample;
  sample.type = type;
  sample.stamp = stamp;
  sample.valid = true;
  return sample;
}

}  // namespace

PoseFields fields_of(const solver::Pose& pose) {
  const Eigen::Quaterniond q(pose.rotation);
  const solver::Vector3& p = pose.position;
  return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

SixFields fields_of(const solver::MotionVector& m) {
  return {m.linear.x(), m.linear.y(), m.linear.z(), m.angular.x(), m.angular.y(), m.angular.z()};
}

SixFields fields_of(const solver::ForceVector& w) {
  return {w.linear.x(), w.linear.y(), w.linear.z(), w.angular.x(), w.angular.y(), w.angular.z()};
}

solver::ForceVector wrench_of(const SixFields& w) {
  solver::ForceVector wrench;
  wrench.linear = {w[0], w[1], w[2]};
  wrench.angular = {w[3], w[4], w[5]};
  return wrench;
}

std::optional<SignalSample> sample_of(const Bool& message, const lang::SignalSource&, double arrival) {
  SignalSample sample = valid_sample(lang::SignalType::boolean, arrival);
  sample.boolean = message.data;
  return sample;
}

std::optional<SignalSample> sample_of(const Float64& message, const lang::SignalSource&, double arrival) {
  if (!std::isfinite(message.data)) return std::nullopt;
  SignalSample sample = valid_sample(lang::SignalType::number, arrival);
  sample.number = message.data;
  return sample;
}

std::optional<SignalSample> sample_of(const LaserScan& message, const lang::SignalSource& source, double) {
  const auto nearest = message.nearest((*source.nearest)[0], (*source.nearest)[1]);
  SignalSample sample = valid_sample(lang::SignalType::number, message.header.stamp());
  sample.valid = nearest.has_value();
  sample.number = nearest.value_or(0.0);
  return sample;
}

std::optional<SignalSample> sample_of(const PoseStamped& message, const lang::SignalSource&, double) {
  const auto pose = pose_of(message.pose);
  if (!pose) return std::nullopt;
  SignalSample sample = valid_sample(lang::SignalType::pose, message.header.stamp());
  sample.pose = *pose;
  return sample;
}

std::optional<SignalSample> sample_of(const WrenchStamped& message, const lang::SignalSource&, double) {
  if (!are_finite(message.wrench)) return std::nullopt;
  SignalSample sample = valid_sample(lang::SignalType::wrench, message.header.stamp());
  sample.wrench = wrench_of(message.wrench);
  return sample;
}

}  // namespace zwang::connect
