/// Dry friction between the floor and an object that slides on it.
///
/// MuJoCo's own sliding contact makes an object hop. While the object slides at v, its normal direction is in
/// balance only about mu v B/K above the floor, where the contact is gone. Instead the object moves in the
/// plane, and its friction is an elastic bristle that yields. This is Prandtl's model, which sticks without
/// creep. With stretch s, ds/dt = v,
///     f = -(k s + c v), |f| <= mu m g, and |k s| <= mu m g by cutting s.
/// k = m w^2 with w = 200 1/s: 0.15 mm of give at mu = 0.6. About the vertical the model has the torque mu m
/// g r, with r the mean distance of the face on the floor from its centre.
#pragma once

#include <Eigen/Core>

#include "caster_friction.hpp"
#include "zwang/lang/scene.hpp"

namespace zwang::runtime {

class FloorFriction {
 public:
  FloorFriction() = default;
  /// `yaw_inertia` about the centre of mass [kg m^2], `load` mu m g [N], `reach` r [m].
  FloorFriction(double mass, double yaw_inertia, double load, double reach);

  /// Force and moment (fx, fy [N], mz [N m]) at the planar velocity (vx, vy [m/s], wz [rad/s]), in axes that
  /// do not turn. Moves the bristles by one step of `period` [s].
  Eigen::Vector3d step(const Eigen::Vector3d& velocity, double period) noexcept;

 private:
  Eigen::Vector2d inertia_ = Eigen::Vector2d::Zero();  ///< mass, yaw inertia
  Eigen::Vector2d limit_ = Eigen::Vector2d::Zero();    ///< force [N], moment [N m]
  Eigen::Vector3d stretch_ = Eigen::Vector3d::Zero();  ///< [m, m, rad]
};

/// Of an object with a mass, on a floor of the friction `floor`. `gravity` [m/s^2]
CasterFriction casters_of(const lang::SceneObject& object, double floor, double gravity);
FloorFriction floor_friction_of(const lang::SceneObject& object, double floor, double gravity);

}  // namespace zwang::runtime
