#include "constraint/ground.hpp"

#include <algorithm>

namespace zwang::solver {

Ground::Ground(const Model& model) : base_rows_(model.base_type() == BaseType::ground ? 3 : 0) {
  for_each_held_direction(model, [&](const Wheel& wheel, const HeldDirection& direction) {
    const auto body = static_cast<std::size_t>(wheel.body);
    const auto carrier = static_cast<std::size_t>(model.bodies()[body].parent);
    held_.push_back({body, carrier, wheel.radius, direction});
  });
}

/// The base's own z axis is the ground's normal. In its axes rx, ry and z have no velocity products.
GroundRow Ground::row(int index, const Sweeps& sweeps) const noexcept {
  if (index < base_rows_) return {0, Vector6::Unit(index < 2 ? index : 5), 0.0};
  return wheel_row(held_[static_cast<std::size_t>(index - base_rows_)], sweeps);
}

/// No slip along u at the contact point P = C - R n under the wheel's centre C:
///   u . (v + w x P) = 0,   (w, v) the wheel's twist,   u fixed to the carrier (twist (w_c, v_c)), C moving
///   with the wheel.
/// As a wrench a = (P x u, u). Its rate of change gives, with the velocity v_C of the centre,
///   gamma = (v_C x u) . w + (w_c x u) . (v + w x P)
GroundRow Ground::wheel_row(const Held& held, const Sweeps& sweeps) const noexcept {
  const BodySweep& sweep = sweeps.bodies[held.body];
  const Vector3 u = held.direction.along(sweep.S.head<3>());
  const Vector3 P = sweep.p - held.radius * Vector3::UnitZ();
  const Vector3 w_c = sweeps.bodies[held.carrier].v.head<3>();
  const Vector3 w = sweep.v.head<3>();
  const Vector3 v = sweep.v.tail<3>();
  const Vector3 v_C = v + w.cross(sweep.p);
  const double gamma = v_C.cross(u).dot(w) + w_c.cross(u).dot(v + w.cross(P));
  GroundRow row{static_cast<int>(held.body), Vector6::Zero(), -gamma};
  row.a << P.cross(u), u;
  return row;
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
  for_each_held_direction(model, [&](const Wheel& wheel, const HeldDirection& direction) {
    const Body& body = model.bodies()[static_cast<std::size_t>(wheel.body)];
    if (body.parent != 0) return;
    const Vector3 u = direction.along(body.pose_in_parent.rotation * body.joint.axis);
    const Vector3& at = body.pose_in_parent.position;
    const Vector3 row(u.x(), u.y(), (at.x() * u.y() - at.y() * u.x()) / size);
    gram += row * row.transpose();
  });
  const double mean = gram.trace() / 3.0;
  return gram.determinant() > 1e-4 * mean * mean * mean;
}

}  // namespace zwang::solver
