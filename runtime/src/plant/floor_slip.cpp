#include "floor_slip.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "zwang/solver/frame.hpp"

namespace zwang::runtime {

namespace {

using solver::Vector3;

/// Of the wheel's lowest point, along what the wheel holds. [m/s]
double sliding(const solver::Model& model, const solver::Wheel& wheel, const solver::State& state) {
  const solver::FrameMotion motion = solver::motion_of({wheel.body, {}, {}}, model, state);
  const Vector3 velocity = motion.linear + motion.angular.cross(Vector3(0.0, 0.0, -wheel.radius));
  const Vector3 shaft = motion.pose.rotation * model.joint(wheel.body - 1).axis;
  const Vector3 sideways = Vector3(shaft.x(), shaft.y(), 0.0).normalized();
  if (wheel.roller_angle)
    return std::abs(velocity.dot(Eigen::AngleAxisd(*wheel.roller_angle, Vector3::UnitZ()) * sideways));
  const double across = wheel.holds_sideways ? velocity.dot(sideways) : 0.0;
  const double along = wheel.holds_rolling ? velocity.dot(sideways.cross(Vector3::UnitZ())) : 0.0;
  return std::hypot(along, across);
}

}  // namespace

FloorSlip::FloorSlip(const solver::Model& model, double period)
    : part_(1.0 - std::exp(-period / time_constant)), slips_(model.wheels().size(), 0.0) {}

void FloorSlip::look(const solver::Model& model, const solver::State& state) noexcept {
  speed_ = 0.0;
  for (std::size_t w = 0; w < slips_.size(); ++w) {
    const solver::Wheel& wheel = model.wheels()[w];
    slips_[w] += part_ * (sliding(model, wheel, state) - slips_[w]);
    speed_ = std::max(speed_, slips_[w] - share * wheel.radius * std::abs(state.qd(wheel.body - 1)));
  }
}

}  // namespace zwang::runtime
