#include "side_friction.hpp"

#include <algorithm>
#include <stdexcept>

namespace zwang::runtime {

namespace {

constexpr double side_frequency = 200.0;    ///< [1/s] of the share of the robot's mass on a bristle
constexpr double side_damping_ratio = 0.7;  ///< while the bristles hold

}  // namespace

SideFriction::SideFriction(const solver::Model& model, double coefficient) {
  for (std::size_t w = 0; w < model.wheels().size(); ++w) {
    const solver::Wheel& wheel = model.wheels()[w];
    if (wheel.roller_angle || wheel.holds_sideways) continue;
    const solver::Body& body = model.bodies()[static_cast<std::size_t>(wheel.body)];
    if (body.parent != 0)
      throw std::invalid_argument("plant: the skidding wheel `" + body.name + "` is not on the base");
    Bristle bristle;
    bristle.wheel = w;
    bristle.coefficient = coefficient;
    bristle.axis = body.pose_in_parent.rotation * body.joint.axis;
    bristle.contact = body.pose_in_parent.position - solver::Vector3(0.0, 0.0, wheel.radius);
    wheels_.push_back(bristle);
  }
  if (wheels_.empty()) return;
  const double mass = model.total_mass() / static_cast<double>(wheels_.size());
  stiffness_ = mass * side_frequency * side_frequency;
  damping_ = 2.0 * side_damping_ratio * mass * side_frequency;
}

solver::ForceVector SideFriction::step(const solver::MotionVector& twist, const std::vector<double>& loads,
                                       double period) noexcept {
  solver::ForceVector wrench;
  for (Bristle& bristle : wheels_) {
    const double limit = bristle.coefficient * loads[bristle.wheel];
    const double v = bristle.axis.dot(twist.linear + twist.angular.cross(bristle.contact));
    const double longest = limit / stiffness_;
    bristle.stretch = std::clamp(bristle.stretch + period * v, -longest, longest);
    const double f = std::clamp(-(stiffness_ * bristle.stretch + damping_ * v), -limit, limit);
    wrench += {bristle.contact.cross(f * bristle.axis), f * bristle.axis};
  }
  return wrench;
}

void SideFriction::set_coefficient(double coefficient) noexcept {
  for (Bristle& bristle : wheels_) bristle.coefficient = coefficient;
}

void SideFriction::set_coefficient(double coefficient, std::size_t wheel) noexcept {
  for (Bristle& bristle : wheels_) {
    if (bristle.wheel == wheel) bristle.coefficient = coefficient;
  }
}

void SideFriction::reset() noexcept {
  for (Bristle& bristle : wheels_) bristle.stretch = 0.0;
}

}  // namespace zwang::runtime
