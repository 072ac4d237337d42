/// Robots for the solver's tests, built from a few figures so that expected values follow from formulas.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "zwang/solver/model.hpp"

namespace zwang::solver::test {

struct MecanumFigures {
  double base_mass = 40.0, yaw_inertia = 1.8;                    // [kg], [kg m^2] without wheels
  double wheel_mass = 1.5, radius = 0.1, spin_inertia = 0.0075;  // [kg], [m], [kg m^2]
  double yaw_inertia_wheel = 0.004, rotor_inertia = 0.001;       // [kg m^2]
  double lx = 0.25, ly = 0.22;                                   // [m]
  double eccentricity = 0.0;                                     // [m] of a wheel's centre of mass
  double effort = 8.0;                                           // [N m]

  double spin() const { return spin_inertia + rotor_inertia; }
  double mass() const { return base_mass + 4.0 * wheel_mass; }
  /// Apparent mass along x and y, apparent yaw inertia: kinetic energy of base and rolling wheels.
  double apparent_mass() const { return mass() + 4.0 * spin() / (radius * radius); }
  double apparent_yaw_inertia() const {
    return yaw_inertia + 4.0 * (wheel_mass * (lx * lx + ly * ly) + yaw_inertia_wheel) +
           4.0 * spin() * (lx + ly) * (lx + ly) / (radius * radius);
  }
};

inline Model mecanum(const MecanumFigures& f) {
  const Matrix3 base_inertia = Vector3(1.5, 1.6, f.yaw_inertia).asDiagonal();
  ModelBuilder builder(BaseType::ground, "base_link",
                       RigidInertia::from_com(f.base_mass, {0.0, 0.0, 0.1}, base_inertia));
  const struct {
    const char* name;
    double x, y, angle;
  } wheels[] = {{"front_left", 1, 1, 45},
                {"front_right", 1, -1, -45},
                {"rear_left", -1, 1, -45},
                {"rear_right", -1, -1, 45}};
  for (const auto& w : wheels) {
    const Matrix3 inertia = Vector3(f.yaw_inertia_wheel, f.spin_inertia, f.yaw_inertia_wheel).asDiagonal();
    Joint joint;
    joint.name = std::string(w.name) + "_joint";
    joint.type = JointType::continuous;
    joint.axis = Vector3::UnitY();
    joint.rotor_inertia = f.rotor_inertia;
    joint.actuated = true;
    joint.max_effort = f.effort;
    builder.add_link(w.name, "base_link", {Matrix3::Identity(), {w.x * f.lx, w.y * f.ly, 0.0}}, joint,
                     RigidInertia::from_com(f.wheel_mass, {f.eccentricity, 0.0, 0.0}, inertia));
    Wheel wheel;
    wheel.radius = f.radius;
    wheel.roller_angle = w.angle * M_PI / 180.0;
    builder.add_wheel(joint.name, wheel);
  }
  return builder.build();
}

/// A wheel on the base, or on a swivel of its own.
struct WheelPlace {
  double x = 0.0, y = 0.0;  ///< [m] of the wheel; of the swivel where there is one
  Wheel wheel{.radius = 0.1};
  bool swivels = false;
  bool steered = false;                  ///< the swivel has a motor
  double swivel_angle = 0.0;             ///< [rad] at q = 0
  std::vector<Vector3> hubs{{0, 0, 0}};  ///< [m] wheel centres on the swivel (or on the base)
  bool driven = true;
};

/// A 40 kg base on any wheels.
inline Model base_on(const std::vector<WheelPlace>& places) {
  const Matrix3 base_inertia = Vector3(1.5, 1.6, 1.8).asDiagonal();
  ModelBuilder builder(BaseType::ground, "base_link",
                       RigidInertia::from_com(40.0, {0.0, 0.0, 0.1}, base_inertia));
  const Matrix3 wheel_inertia = Vector3(0.004, 0.0075, 0.004).asDiagonal();
  const Matrix3 fork_inertia = Vector3(0.004, 0.004, 0.003).asDiagonal();
  int number = 0;
  for (const WheelPlace& place : places) {
    const std::string id = std::to_string(number++);
    std::string carrier = "base_link";
    Vector3 origin(place.x, place.y, 0.0);
    if (place.swivels) {
      Joint swivel{.name = "swivel" + id, .type = JointType::continuous, .axis = Vector3::UnitZ()};
      swivel.actuated = place.steered;
      swivel.max_effort = 5.0;
      builder.add_link("fork" + id, "base_link", {rotation_from_rpy(0.0, 0.0, place.swivel_angle), origin},
                       swivel, RigidInertia::from_com(1.0, Vector3::Zero(), fork_inertia));
      carrier = "fork" + id;
      origin.setZero();
    }
    for (std::size_t k = 0; k < place.hubs.size(); ++k) {
      const std::string name = "wheel" + id + "_" + std::to_string(k);
      Joint joint{.name = name, .type = JointType::continuous, .axis = Vector3::UnitY()};
      joint.rotor_inertia = 0.001;
      joint.actuated = place.driven;
      joint.max_effort = 8.0;
      builder.add_link(name + "_link", carrier, {Matrix3::Identity(), origin + place.hubs[k]}, joint,
                       RigidInertia::from_com(1.5, Vector3::Zero(), wheel_inertia));
      builder.add_wheel(name, place.wheel);
    }
  }
  return builder.build();
}

}  // namespace zwang::solver::test
