/// Wheels that hold one direction (mecanum, omni) as spheres on ball joints: a smooth plant on which they act
/// exactly, without the ripple of real rollers.
///
/// One wheel. Let a be the wheel's axis in base axes and R its radius. Its rolling direction is e = a x z,
/// and u = Rz(roller angle) a is the axis of the roller at the ground. The ground holds u:
///     u . (v + (w + a qd) x (-R z)) = 0   =>   qd = u . v / (R u . e) = (v_e + s v_a) / R,   s = u_a / u_e,
/// with v the velocity of the wheel's centre. The torque t reaches the base as the force t (e + s a) / R. A
/// sphere that rolls on the ground has v_e = R w_a and v_a = -R w_e, so
///     qd = w_a - s w_e      of its angular velocity w relative to the base ("virtual wheel rate"), and
///     torque t (a - s e)    on the sphere does the work t qd: it is the wheel's torque.
///
/// Inertia. With J = axial inertia + rotor inertia the wheel holds 1/2 J (v_e + s v_a)^2 / R^2. A sphere of
/// inertia I holds 1/2 I (v_e^2 + v_a^2) / R^2. Both are quadratic forms of the base's planar twist
/// (vx, vy, wz), summed over the wheels. Their difference must be a yaw inertia alone, which the base then
/// gets: 8 lx ly J / R^2 for four mecanum wheels at (+-lx, +-ly). I = c J, with c chosen so that the traces
/// of the xy parts agree: 1 for 45 degree rollers, 1/2 for three omni wheels. If a remainder is left, spheres
/// cannot replace the wheels. The sphere does not turn about the vertical with the base. So the base also
/// gets the wheel's own inertia about its diameters. The mass stays at the wheel's centre.
///
/// Velocity products. J enters the wheel's equation as J d(qd)/dt, the rate of body components. The sphere's
/// inertia force is I/R^2 times the acceleration of its centre, d(v)/dt + wz z x v. The second part has no
/// counterpart in the wheel, so the plant adds I/R^2 wz z x v at each centre.
#pragma once

#include <optional>
#include <vector>

#include "zwang/solver/model.hpp"

namespace zwang::runtime {

struct RollingSphere {
  int wheel = 0;           ///< index into Model::wheels()
  int body = 0;            ///< body of the model that the sphere stands for
  solver::Vector3 centre;  ///< [m] in the base frame
  solver::Vector3 axis;    ///< a, unit, in base axes
  solver::Vector3 along;   ///< e
  double slope = 0.0;      ///< s
  double radius = 0.0;     ///< [m]
  double mass = 0.0;       ///< [kg]
  double inertia = 0.0;    ///< I [kg m^2]

  solver::Vector3 torque_direction() const { return axis - slope * along; }
};

struct SphereBase {
  std::vector<RollingSphere> spheres;
  solver::RigidInertia base;  ///< of the simulated base
};

/// True for wheels that may be simulated as spheres on ball joints: those with rollers.
bool is_rolling_sphere(const solver::Wheel& wheel);

/// A body can have this inertia: its mass is positive and its moments keep the triangle rule.
bool is_physical(const solver::RigidInertia& inertia);

/// nullopt where spheres cannot stand exactly for the wheels: wheels of different inertia, out of balance,
/// behind a steering, not level. They are then simulated as hinged wheels (mjcf_robot.cpp).
std::optional<SphereBase> replace_wheels_by_spheres(const solver::Model& model);

/// The wrench that cancels the excess velocity products of the spheres: I/R^2 wz z x v at each centre. It is
/// in base axes and about the base's origin, at the base's twist in the same. Does not allocate.
solver::ForceVector sphere_products(const SphereBase& base, const solver::MotionVector& twist) noexcept;

}  // namespace zwang::runtime
