#include "floor_friction.hpp"

#include <cmath>
#include <numbers>

#include "bristle.hpp"
#include "cut.hpp"

namespace zwang::runtime {

FloorFriction::FloorFriction(double mass, double yaw_inertia, double load, double reach)
    : inertia_(mass, yaw_inertia), limit_(load, load * reach) {}

Eigen::Vector3d FloorFriction::step(const Eigen::Vector3d& velocity, double period) noexcept {
  stretch_ += period * velocity;
  const Eigen::Vector2d stiffness = floor_frequency * floor_frequency * inertia_;
  cut(stretch_.head<2>(), limit_[0] / stiffness[0]);
  cut(stretch_.tail<1>(), limit_[1] / stiffness[1]);
  const Eigen::Vector3d pull = stretch_ + 2.0 * floor_damping_ratio / floor_frequency * velocity;
  Eigen::Vector3d force;
  force << -stiffness[0] * pull.head<2>(), -stiffness[1] * pull.tail<1>();
  cut(force.head<2>(), limit_[0]);
  cut(force.tail<1>(), limit_[1]);
  return force;
}

CasterFriction casters_of(const lang::SceneObject& object, double floor, double gravity) {
  const double mass = object.mass.value_or(0.0);
  // On a round object they stand where the corners of the square inside of it are.
  const bool is_round = object.shape == lang::ShapeKind::cylinder;
  const double half = std::numbers::sqrt2 / 2.0;
  const double ahead = is_round ? half * object.size[0] : 0.5 * object.size[0];
  const double aside = is_round ? half * object.size[0] : 0.5 * object.size[1];
  return {mass, object.slides_on(floor) * mass * gravity, object.caster_trail, ahead, aside};
}

FloorFriction floor_friction_of(const lang::SceneObject& object, double floor, double gravity) {
  const double mass = object.mass.value_or(0.0);
  const double a = object.size[0];
  const double b = object.size[1];
  const bool round = object.shape == lang::ShapeKind::cylinder;
  const double area = round ? std::numbers::pi * a * a : a * b;
  const double reach = 2.0 / 3.0 * std::sqrt(area / std::numbers::pi);  // of a disk as large
  return {mass, object.yaw_inertia(), object.slides_on(floor) * mass * gravity, reach};
}

}  // namespace zwang::runtime
