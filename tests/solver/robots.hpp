/// Robots for the solver's tests, built from a few figures so that expected values follow from formulas.
#pragma once

#include <cmath>
#include <string>

#include "zwang/solver/model.hpp"

namespace zwang::solver::test {

struct MecanumFigures {
  double base_mass = 40.0, yaw_inertia = 1.8;                    // [kg], [kg m^2] without wheels
  double wheel_mass = 1.5, radius = 0.1, spin_inertia = 0.0075;  // [kg], [m], [kg m^2]
  double yaw_inertia_wheel = 0.004, rotor_inertia = 0.001;       // [kg m^2]
  double lx = 0.25, ly = 0.22;                                   // [m]
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
                     RigidInertia::from_com(f.wheel_mass, Vector3::Zero(), inertia));
    Wheel wheel;
    wheel.radius = f.radius;
    wheel.roller_angle = w.angle * M_PI / 180.0;
    builder.add_wheel(joint.name, wheel);
  }
  return builder.build();
}

}  // namespace zwang::solver::test
