/// The gains of the wheels' velocity loops, as a robot file tells them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::runtime {

/// A PI loop at a driven wheel:
///     torque = k_p (V - v) + k_i sum (V - v) dt,   k_p = m R^2 / (n T_c),   k_i = k_p / T_i.
/// m is the mass that n wheels of the radius R drive, rotors included. Alone on the floor the base follows a
/// step as 1 - e^(-t/T_c), apart from the integral. The weight of a wheel is its rotation for a way of the
/// base. It is averaged over the directions in which motors drive the base: an omni wheel counts half.
struct LoopGain {
  int joint = 0;
  double limit = 0.0;         ///< [N m]
  double proportional = 0.0;  ///< k_p [N m s/rad]
  double integral = 0.0;      ///< k_i [N m/rad]
  /// V for 1 m/s of the base's x, of its y, and 1 rad/s; 0 of a wheel that swivels. With u the direction that
  /// the wheel holds at its contact point P, and d the way of P for 1 rad of the wheel,
  ///     u . (v + w z x P + V d) = 0.
  Eigen::Vector3d per_twist = Eigen::Vector3d::Zero();  ///< [rad/s]
};

ZWANG_EXPORT std::vector<LoopGain> loop_gains(const lang::Robot& robot);
double driven_mass(const lang::Robot& robot);  ///< m [kg]

}  // namespace zwang::runtime
