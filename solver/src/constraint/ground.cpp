#include "constraint/ground.hpp"

#include <algorithm>
#include <cmath>

namespace zwang::solver {

namespace {

constexpr int base_rows = 3;

/// The base's own z axis is the ground's normal. In its axes rx, ry and z have no velocity products.
GroundRow base_row(int index) {
  return {0, Vector6::Unit(index < 2 ? index : 5), 0.0};
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

/// No slip along u at the contact point P = C - R n under the wheel's centre C:
///   u . (v + w x P) = 0,   (w, v) the wheel's twist,   u fixed to the carrier (twist (w_c, v_c)), C moving
///   with the wheel.
/// As a wrench a = (P x u, u). Its rate of change gives, with the velocity v_C of the centre,
///   gamma = (v_C x u) . w + (w_c x u) . (v + w x P)
GroundRow wheel_row(const Wheel& wheel, int index, const Model& model, const Sweeps& sweeps) {
  const auto body = static_cast<std::size_t>(wheel.body);
  const BodySweep& sweep = sweeps.bodies[body];
  const Vector3 normal = Vector3::UnitZ();
  const Vector3 u = held_direction(wheel, index, sweep.S.head<3>(), normal);
  const Vector3 P = sweep.p - wheel.radius * normal;
  const auto carrier = static_cast<std::size_t>(model.bodies()[body].parent);
  const Vector3 w_c = sweeps.bodies[carrier].v.head<3>();
  const Vector3 w = sweep.v.head<3>();
  const Vector3 v = sweep.v.tail<3>();
  const Vector3 v_C = v + w.cross(sweep.p);
  const double gamma = v_C.cross(u).dot(w) + w_c.cross(u).dot(v + w.cross(P));
  GroundRow row{wheel.body, Vector6::Zero(), -gamma};
  row.a << P.cross(u), u;
  return row;
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

bool every_motion_turns_a_wheel(const Model& model) noexcept {
  if (model.base_type() != BaseType::ground) return false;
  // Gram matrix of the held directions on (x, y, rz), with lengths in units of the farthest wheel's distance.
  Matrix3 gram = Matrix3::Zero();
  double size = 0.0;
  for (const Wheel& wheel : model.wheels()) {
    size =
        std::max(size, model.bodies()[static_cast<std::size_t>(wheel.body)].pose_in_parent.position.norm());
  }
  if (!(size > 0.0)) return false;
  for (const Wheel& wheel : model.wheels()) {
    const Body& body = model.bodies()[static_cast<std::size_t>(wheel.body)];
    if (body.parent != 0) continue;
    const Vector3 axis = body.pose_in_parent.rotation * body.joint.axis;
    const Vector3& at = body.pose_in_parent.position;
    for (int i = 0; i < wheel.held_directions(); ++i) {
      const Vector3 u = held_direction(wheel, i, axis, Vector3::UnitZ());
      const Vector3 row(u.x(), u.y(), (at.x() * u.y() - at.y() * u.x()) / size);
      gram += row * row.transpose();
    }
  }
  const double mean = gram.trace() / 3.0;
  return gram.determinant() > 1e-4 * mean * mean * mean;
}

}  // namespace zwang::solver
