#include "constraint/ground.hpp"

namespace zwang::solver {

Ground::Ground(const Model& model) {
  for_each_held_direction(model, [&](const Wheel& wheel, const HeldDirection& direction) {
    const auto body = static_cast<std::size_t>(wheel.body);
    const auto carrier = static_cast<std::size_t>(model.bodies()[body].parent);
    held_.push_back({body, carrier, wheel.radius, direction});
  });
}

/// No slip along u at the contact point P = C - R n under the wheel's centre C. The wheel has the twist
/// (w, v) and its carrier (w_c, v_c). The axis u is fixed to the carrier, and C moves with the wheel:
///   u . (v + w x P) = 0
/// As a wrench a = (P x u, u). Its rate of change gives, with the velocity v_C of the centre,
///   gamma = (v_C x u) . w + (w_c x u) . (v + w x P)
Vector6 Ground::axis(int index, const Sweeps& sweeps) const noexcept {
  const Held& held = held_[static_cast<std::size_t>(index)];
  const BodySweep& sweep = sweeps.bodies[held.body];
  const Vector3 u = held.direction.along(sweep.S.head<3>());
  const Vector3 P = sweep.p - held.radius * Vector3::UnitZ();
  Vector6 a;
  a << P.cross(u), u;
  return a;
}

double Ground::bias(int index, const Eigen::Ref<const Vector6>& a, const Sweeps& sweeps) const noexcept {
  const Held& held = held_[static_cast<std::size_t>(index)];
  const BodySweep& sweep = sweeps.bodies[held.body];
  const Vector3 u = a.tail<3>();
  const Vector3 P = sweep.p - held.radius * Vector3::UnitZ();
  const Vector3 w_c = sweeps.bodies[held.carrier].v.head<3>();
  const Vector3 w = sweep.v.head<3>();
  const Vector3 v = sweep.v.tail<3>();
  const Vector3 v_C = v + w.cross(sweep.p);
  return -(v_C.cross(u).dot(w) + w_c.cross(u).dot(v + w.cross(P)));
}

}  // namespace zwang::solver
