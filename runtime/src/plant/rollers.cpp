#include "rollers.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "rolling_spheres.hpp"

namespace zwang::runtime {

using solver::Matrix3;
using solver::Pose;
using solver::Vector3;

namespace {

constexpr double roller_share = 0.22;  ///< r over R
constexpr double mass_share = 0.3;     ///< of all rollers in the wheel's mass

Matrix3 rotation_in_base(const solver::Model& model, int body) {
  Matrix3 rotation = Matrix3::Identity();
  for (int i = body; i > 0; i = model.bodies()[static_cast<std::size_t>(i)].parent) {
    rotation = model.bodies()[static_cast<std::size_t>(i)].pose_in_parent.rotation * rotation;
  }
  return rotation;
}

}  // namespace

std::optional<RollerWheel> build_rollers(const solver::Model& model, const solver::Wheel& wheel) {
  const solver::Body& body = model.bodies()[static_cast<std::size_t>(wheel.body)];
  const double r = roller_share * wheel.radius;
  const double centre = wheel.radius - r;
  const double slant = std::abs(std::sin(*wheel.roller_angle));
  if (slant < 0.3) return std::nullopt;
  const double handover = std::numbers::pi / roller_count;
  const double reach = wheel.radius - centre * std::cos(handover);
  const double lean = slant * std::sin(handover);
  const double half = std::sqrt(r * r + (reach * reach - r * r) / (lean * lean));

  const Matrix3 in_wheel = rotation_in_base(model, wheel.body).transpose();
  const Vector3 axis = body.joint.axis;
  const Vector3 down = in_wheel * -Vector3::UnitZ();
  const Vector3 along = Eigen::AngleAxisd(*wheel.roller_angle, in_wheel * Vector3::UnitZ()) * axis;
  const Matrix3 first = solver::rotation_between(Vector3::UnitZ(), along);
  const double mass = mass_share * body.inertia.mass / roller_count;
  const Vector3 moments = 0.2 * mass * Vector3(r * r + half * half, r * r + half * half, 2.0 * r * r);

  RollerWheel built;
  built.hub = body.inertia;
  for (int i = 0; i < roller_count; ++i) {
    const Matrix3 turned =
        Eigen::AngleAxisd(2.0 * std::numbers::pi * i / roller_count, axis).toRotationMatrix();
    Roller roller;
    roller.pose = Pose{turned * first, turned * (centre * down)};
    roller.radius = r;
    roller.half = half;
    roller.inertia = solver::RigidInertia::from_com(mass, Vector3::Zero(), moments.asDiagonal());
    const solver::RigidInertia there = roller.inertia.expressed_in(roller.pose);
    built.hub.mass -= there.mass;
    built.hub.first_moment -= there.first_moment;
    built.hub.rotational -= there.rotational;
    built.rollers.push_back(roller);
  }
  if (!is_physical(built.hub)) return std::nullopt;
  return built;
}

}  // namespace zwang::runtime
