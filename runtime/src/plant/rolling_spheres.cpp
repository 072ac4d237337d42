#include "rolling_spheres.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace zwang::runtime {

namespace {

using solver::Body;
using solver::Matrix3;
using solver::Model;
using solver::RigidInertia;
using solver::Vector3;
using solver::Wheel;

/// The wheel's inertia in base axes about its centre (the origin of its body), averaged over its spin.
struct SpunInertia {
  double axial = 0.0;
  double diametral = 0.0;
  double offset = 0.0;  ///< of the centre of mass along the axis [m]
};

/// nullopt for a wheel out of balance: its centre of mass is not on its axis.
std::optional<SpunInertia> average_over_spin(const Body& body, double radius) {
  const Vector3& axis = body.joint.axis;
  const Vector3 com = body.inertia.first_moment / body.inertia.mass;
  SpunInertia spun;
  spun.offset = com.dot(axis);
  if ((com - spun.offset * axis).norm() > 0.02 * radius) return std::nullopt;
  spun.axial = axis.dot(body.inertia.rotational * axis);
  spun.diametral = 0.5 * (body.inertia.rotational.trace() - spun.axial);
  return spun;
}

/// nullopt for a wheel that is not on the base, carries something, is not level or drives nothing.
std::optional<RollingSphere> sphere_for(const Model& model, int index) {
  const Wheel& wheel = model.wheels()[static_cast<std::size_t>(index)];
  const Body& body = model.bodies()[static_cast<std::size_t>(wheel.body)];
  const auto hangs_on_it = [&](const Body& other) { return other.parent == wheel.body; };
  if (body.parent != 0 || std::any_of(model.bodies().begin(), model.bodies().end(), hangs_on_it))
    return std::nullopt;
  RollingSphere sphere;
  sphere.wheel = index;
  sphere.body = wheel.body;
  sphere.centre = body.pose_in_parent.position;
  sphere.radius = wheel.radius;
  sphere.mass = body.inertia.mass;
  sphere.axis = body.pose_in_parent.rotation * body.joint.axis;
  if (std::abs(sphere.axis.z()) > 1e-3) return std::nullopt;
  sphere.axis.z() = 0.0;
  sphere.axis.normalize();
  sphere.along = sphere.axis.cross(Vector3::UnitZ());
  const Vector3 held = Eigen::AngleAxisd(*wheel.roller_angle, Vector3::UnitZ()) * sphere.axis;
  const double driven = held.dot(sphere.along);
  if (std::abs(driven) < 1e-3) return std::nullopt;
  sphere.slope = held.dot(sphere.axis) / driven;
  return sphere;
}

/// Row of the planar twist (vx, vy, wz) that gives the velocity of `point` along `direction`.
Vector3 planar_row(const Vector3& direction, const Vector3& point) {
  return {direction.x(), direction.y(), point.x() * direction.y() - point.y() * direction.x()};
}

}  // namespace

bool is_physical(const RigidInertia& inertia) {
  if (!(inertia.mass > 0.0)) return false;
  const Matrix3 at_com = inertia.rotational_at_com();
  // Second moments of the mass: all positive is the triangle rule.
  const Matrix3 moments = 0.5 * at_com.trace() * Matrix3::Identity() - at_com;
  const double tolerance = 1e-6 * at_com.trace();
  return Eigen::SelfAdjointEigenSolver<Matrix3>(moments).eigenvalues().minCoeff() >= -tolerance;
}

bool is_rolling_sphere(const Wheel& wheel) {
  return wheel.roller_angle.has_value();
}

std::optional<SphereBase> replace_wheels_by_spheres(const Model& model) {
  SphereBase result;
  result.base = model.bodies().front().inertia;
  Matrix3 wheel_form = Matrix3::Zero();   // of the planar twist, wheels of the model
  Matrix3 sphere_form = Matrix3::Zero();  // spheres with I = J
  double reach = 0.0;
  for (std::size_t i = 0; i < model.wheels().size(); ++i) {
    if (!is_rolling_sphere(model.wheels()[i])) continue;
    const std::optional<RollingSphere> found = sphere_for(model, static_cast<int>(i));
    if (!found) return std::nullopt;
    RollingSphere sphere = *found;
    const Body& body = model.bodies()[static_cast<std::size_t>(sphere.body)];
    const std::optional<SpunInertia> spun = average_over_spin(body, sphere.radius);
    if (!spun) return std::nullopt;
    sphere.inertia = spun->axial + body.joint.rotor_inertia;  // J; scaled below
    const double weight = sphere.inertia / (sphere.radius * sphere.radius);
    const Vector3 rolling = planar_row(sphere.along, sphere.centre);
    const Vector3 sideways = planar_row(sphere.axis, sphere.centre);
    const Vector3 driven = rolling + sphere.slope * sideways;
    wheel_form += weight * driven * driven.transpose();
    sphere_form += weight * (rolling * rolling.transpose() + sideways * sideways.transpose());
    reach = std::max(reach, sphere.centre.head<2>().norm());

    RigidInertia rest;  // of the wheel that does not spin, beyond its mass at its centre
    rest.first_moment = sphere.mass * spun->offset * sphere.axis;
    rest.rotational = spun->diametral * (Matrix3::Identity() - sphere.axis * sphere.axis.transpose());
    result.base = result.base + rest.expressed_in({Matrix3::Identity(), sphere.centre});
    result.spheres.push_back(sphere);
  }
  if (result.spheres.empty()) return result;

  const double scale = wheel_form.topLeftCorner<2, 2>().trace() / sphere_form.topLeftCorner<2, 2>().trace();
  for (RollingSphere& sphere : result.spheres) sphere.inertia *= scale;
  const Matrix3 difference = wheel_form - scale * sphere_form;
  const double allowed = 5e-4 * model.total_mass();  // [kg], a quarter of the plant's accuracy
  if (difference.topLeftCorner<2, 2>().cwiseAbs().maxCoeff() > allowed ||
      difference.topRightCorner<2, 1>().cwiseAbs().maxCoeff() > allowed * reach)
    return std::nullopt;
  const double yaw = difference(2, 2);
  // As a ring: a mass distribution of its own keeps the triangle rule. The ground holds roll and pitch.
  result.base.rotational.diagonal() += Vector3(0.5 * yaw, 0.5 * yaw, yaw);
  if (!is_physical(result.base)) return std::nullopt;
  return result;
}

solver::ForceVector sphere_products(const SphereBase& base, const solver::MotionVector& twist) noexcept {
  const Vector3 spin(0.0, 0.0, twist.angular.z());
  solver::ForceVector wrench;
  for (const RollingSphere& sphere : base.spheres) {
    const double weight = sphere.inertia / (sphere.radius * sphere.radius);
    const Vector3 force = weight * spin.cross(twist.linear + spin.cross(sphere.centre));
    wrench += {sphere.centre.cross(force), force};
  }
  return wrench;
}

}  // namespace zwang::runtime
