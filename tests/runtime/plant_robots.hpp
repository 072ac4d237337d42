/// Robots built by hand for the tests of the plant, and their dense planar dynamics as an oracle.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "zwang/lang/robot.hpp"
#include "zwang/lang/scene.hpp"
#include "zwang/runtime/mujoco_plant.hpp"

namespace zwang::runtime::testing {

using solver::Matrix3;
using solver::Pose;
using solver::RigidInertia;
using solver::Vector3;

RigidInertia box_inertia(double mass, const Vector3& com, const Vector3& size);
RigidInertia wheel_inertia(double mass, double radius, double width);

struct WheelPlace {
  const char* name;
  double x, y;
  std::optional<double> roller_angle;
  double yaw = 0.0;  ///< of the wheel's axis, from +y
};

struct BaseDesign {
  double wheel_radius = 0.05;
  double wheel_mass = 1.5;
  double wheel_width = 0.05;
  double rotor_inertia = 0.002;  ///< reflected [kg m^2]
  double body_mass = 40.0;
  Vector3 body_com{0.01, -0.005, 0.06};
  double body_product = 0.0;  ///< of inertia, xy about the centre of mass [kg m^2]
};

lang::Robot build_base(const BaseDesign& design, const std::vector<WheelPlace>& places);
lang::Robot mecanum_base(const BaseDesign& design = {});
/// Mecanum wheels mounted the wrong way round: the rollers at the ground lie as they should on top.
lang::Robot mirrored_mecanum_base();
/// Mecanum wheels with rollers at 30 deg: their inertia counts three times as much sideways as ahead, which
/// no sphere has.
lang::Robot steep_mecanum_base();
/// Three omni wheels whose axes are radial; each holds its rolling direction.
lang::Robot omni_base();
lang::Robot differential_base(BaseDesign design = {});

/// The planar motion of a base on wheels: z = (vx, vy, wz, wheel rates). The no-slip rows are P z = 0, and
/// their entries are constant in base axes. So
///   M z' + c = (0, tau) + P' lambda,   P z' = 0
/// c are the velocity products of the rigid base in the rates of body components.
class PlanarReference {
 public:
  explicit PlanarReference(const solver::Model& model);

  Eigen::VectorXd products(const Vector3& v) const;

  /// The rates of (vx, vy, wz) under the wheel torques.
  Vector3 acceleration(const Eigen::VectorXd& tau, const Vector3& v) const;

  /// Minimum-norm torques for the rates; what the no-slip rows forbid is the caller's fault.
  Eigen::VectorXd torque(const Vector3& rates, const Vector3& v) const;

  /// Mass that a force along the unit planar direction (fx, fy, moment) at the base's origin meets.
  double apparent_mass(const Vector3& direction) const;

  /// Minimum-norm torques that push with the planar wrench (fx, fy, moment) when nothing moves.
  Eigen::VectorXd torque_of_wrench(const Vector3& wrench) const;

  Eigen::MatrixXd M, P;
  double mass = 0.0;
  Vector3 com = Vector3::Zero();
};

}  // namespace zwang::runtime::testing
