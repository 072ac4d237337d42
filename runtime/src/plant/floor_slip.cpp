#include "floor_slip.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace zwang::runtime {

namespace {

using solver::Vector3;

/// Of the wheel's lowest point, along what the wheel holds. The body that carries the wheel has the wheel's
/// place and shaft, so the wheel's own angle does not matter. [m/s]
double sliding(const solver::Body& body, const solver::Wheel& wheel, double rate,
               const solver::FrameMotion& carrier) {
  const solver::FrameMotion motion = carrier.at(body.pose_in_parent);
  const Vector3 shaft = motion.pose.rotation * body.joint.axis;
  const Vector3 velocity =
      motion.linear + (motion.angular + rate * shaft).cross(Vector3(0.0, 0.0, -wheel.radius));
  const Vector3 sideways = Vector3(shaft.x(), shaft.y(), 0.0).normalized();
  if (wheel.roller_angle)
    return std::abs(velocity.dot(Eigen::AngleAxisd(*wheel.roller_angle, Vector3::UnitZ()) * sideways));
  const double across = wheel.holds_sideways ? velocity.dot(sideways) : 0.0;
  const double along = wheel.holds_rolling ? velocity.dot(sideways.cross(Vector3::UnitZ())) : 0.0;
  return std::hypot(along, across);
}

}  // namespace

FloorSlip::FloorSlip(const solver::Model& model, double period)
    : part_(1.0 - std::exp(-period / time_constant)),
      slips_(model.wheels().size(), 0.0),
      motions_(static_cast<std::size_t>(model.body_count())) {}

void FloorSlip::look(const solver::Model& model, const solver::State& state) noexcept {
  speed_ = 0.0;
  motions_.start(model, state);
  for (std::size_t w = 0; w < slips_.size(); ++w) {
    const solver::Wheel& wheel = model.wheels()[w];
    const solver::Body& body = model.bodies()[static_cast<std::size_t>(wheel.body)];
    const double rate = state.qd(wheel.body - 1);
    slips_[w] += part_ * (sliding(body, wheel, rate, motions_.of(body.parent)) - slips_[w]);
    speed_ = std::max(speed_, slips_[w] - share * wheel.radius * std::abs(rate));
  }
}

}  // namespace zwang::runtime
