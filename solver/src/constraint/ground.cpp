#include "constraint/ground.hpp"

#include <cmath>

namespace zwang::solver {

namespace {

constexpr int base_rows = 3;

/// The base's own z axis is the ground's normal. In its axes rx, ry and z have no velocity products.
GroundRow base_row(int index) {
  GroundRow row;
  if (index < 2) {
    row.a.angular = Vector3::Unit(index);
  } else {
    row.a.linear = Vector3::UnitZ();
  }
  return row;
}

Vector3 ground_normal(int body, const Model& model, const Sweeps& sweeps) {
  if (body == 0) return Vector3::UnitZ();
  const int parent = model.bodies()[static_cast<std::size_t>(body)].parent;
  return sweeps.bodies[static_cast<std::size_t>(body)].X.E * ground_normal(parent, model, sweeps);
}

/// Held direction number `index` of a wheel, a unit vector in the ground's plane.
Vector3 held_direction(const Wheel& wheel, int index, const Vector3& axis, const Vector3& normal) {
  const Vector3 rolling = axis.cross(normal).normalized();
  const Vector3 sideways = (axis - axis.dot(normal) * normal).normalized();
  if (wheel.roller_angle) {
    const double angle = *wheel.roller_angle;
    return std::cos(angle) * sideways + std::sin(angle) * normal.cross(sideways);
  }
  return wheel.holds_rolling && index == 0 ? rolling : sideways;
}

/// No slip along u at the contact point, P = -R n from the wheel's centre:  u . (v + w x P) = 0, u fixed to
/// the carrier (twist w_c), n to the world. In the wheel's coordinates, at its centre, a = (P x u, u), and
/// its rate of change gives
///   gamma = (v x u) . w + (w_c x u) . (v + w x P)
GroundRow wheel_row(const Wheel& wheel, int index, const Model& model, const Sweeps& sweeps) {
  const auto body = static_cast<std::size_t>(wheel.body);
  const BodySweep& sweep = sweeps.bodies[body];
  const Vector3 normal = ground_normal(wheel.body, model, sweeps);
  const Vector3 u = held_direction(wheel, index, model.bodies()[body].joint.axis, normal);
  const Vector3 P = -wheel.radius * normal;
  const auto carrier = static_cast<std::size_t>(model.bodies()[body].parent);
  const Vector3 w_c = sweep.X.E * sweeps.bodies[carrier].v.angular;
  const Vector3& w = sweep.v.angular;
  const Vector3& v = sweep.v.linear;
  const double gamma = v.cross(u).dot(w) + w_c.cross(u).dot(v + w.cross(P));
  return {wheel.body, {P.cross(u), u}, -gamma};
}

}  // namespace

int ground_row_count(const Model& model) noexcept {
  int count = model.base_type() == BaseType::ground ? base_rows : 0;
  for (const Wheel& wheel : model.wheels()) count += wheel.held_directions();
  return count;
}

GroundRow ground_row(int index, const Model& model, const Sweeps& sweeps) noexcept {
  if (model.base_type() == BaseType::ground) {
    if (index < base_rows) return base_row(index);
    index -= base_rows;
  }
  for (const Wheel& wheel : model.wheels()) {
    if (index < wheel.held_directions()) return wheel_row(wheel, index, model, sweeps);
    index -= wheel.held_directions();
  }
  return {};
}

}  // namespace zwang::solver
