/// One robot inside the simulation: where its numbers are, what drives it, how it is read.
#pragma once

#include <array>
#include <vector>

#include "joint_friction.hpp"
#include "mjcf.hpp"
#include "side_friction.hpp"
#include "zwang/runtime/plant.hpp"

struct mjModel_;
struct mjData_;

namespace zwang::runtime {

class MovingRobot {
 public:
  MovingRobot(const SimulatedRobot& simulated, double floor_friction);

  const solver::Model& model() const noexcept { return simulated_.robot.model; }
  const SimulatedRobot& simulated() const noexcept { return simulated_; }
  bool floats() const noexcept { return !model().has_fixed_base(); }
  bool is_on_ground() const noexcept { return model().base_type() == solver::BaseType::ground; }

  void find_addresses(const mjModel_& m);
  int base_body() const noexcept { return base_body_; }
  /// Faults of the base's own body; each replaces the one before it. [kg] in excess of its weight, [m] ahead
  /// of its centre of mass, and a factor of its own inertia about that centre.
  void set_payload(mjModel_& m, double mass) const noexcept;
  /// Of all its links, payload included. [kg]
  double mass(const mjModel_& m) const noexcept;
  void shift_centre_of_mass(mjModel_& m, double ahead) const noexcept;
  void scale_inertia(mjModel_& m, double factor) const noexcept;
  /// How many of the simulation's freedoms are this robot's.
  int freedoms() const noexcept { return freedoms_; }

  /// The base at this place, its joints in their posture.
  void place(mjModel_& m, mjData_& d, const std::array<double, 2>& at, double yaw);
  /// Vertical [m/s^2], and about the base's own x and y. [rad/s^2]
  solver::Vector3 sinking(const mjData_& d) const noexcept;
  /// While the robot settles: joints other than the wheels keep their posture, and bear what hangs on them.
  void hold_joints(mjData_& d) const noexcept;
  /// As `standing`, but with the height and the tilt that the base has now, at the heading `yaw`.
  void stand(mjData_& d, double yaw, double height, const solver::Matrix3& tilted) const noexcept;

  /// False, and nothing is given, for torques that are not finite or too few.
  bool give(mjData_& d, const Eigen::VectorXd& tau, double period) noexcept;
  /// Before a step: what stands in for the wheels' own inertia, and skidding wheels' friction.
  void push(const mjModel_& m, mjData_& d) noexcept;
  /// Into `xfrc_applied`, beside what is there for the next step: a force on the base [N] in world axes, at a
  /// point of it [m] in its own.
  void press(const mjModel_& m, mjData_& d, const Eigen::Vector2d& at,
             const Eigen::Vector2d& force) const noexcept;
  /// A point of the base, as high as its origin. [m]
  solver::Vector3 in_world(const mjModel_& m, const mjData_& d, const Eigen::Vector2d& at) const noexcept;
  /// After a step. `loads`: of the wheels, see `needs_loads`.
  void read(const mjModel_& m, const mjData_& d) noexcept;
  bool needs_loads() const noexcept { return !side_friction_.empty(); }
  std::vector<double>& wheel_loads() noexcept { return wheel_loads_; }
  void set_floor_friction(double coefficient) noexcept { side_friction_.set_coefficient(coefficient); }
  void set_floor_friction(double coefficient, std::size_t wheel) noexcept {
    side_friction_.set_coefficient(coefficient, wheel);
  }
  void forget_bristles() noexcept { side_friction_.reset(); }

  void sense(const mjModel_& m, const mjData_& d, solver::State& state) const noexcept;
  solver::Vector3 base_position(const mjModel_& m, const mjData_& d) const noexcept;
  solver::Matrix3 base_rotation(const mjModel_& m, const mjData_& d) const noexcept;
  /// In base axes and at the base's origin.
  solver::MotionVector base_twist(const mjModel_& m, const mjData_& d) const noexcept;
  /// vx, vy [m/s] and wz [rad/s] of it.
  solver::Vector3 planar_twist(const mjModel_& m, const mjData_& d) const noexcept;
  Eigen::Index joint_count() const noexcept { return q_.size(); }

 private:
  /// How one joint of the model is read.
  struct JointAddress {
    int position = 0;                       ///< in qpos
    int velocity = 0;                       ///< in qvel
    int motor = -1;                         ///< in ctrl; -1 without a motor
    const RollingSphere* sphere = nullptr;  ///< set: a ball joint; q is integrated
    bool turns_wheel = false;
  };
  /// The base's body before any fault. It also has the yaw inertia by which the forms of the wheels differ.
  struct BaseAsBuilt {
    double mass = 0.0;    ///< [kg]
    double centre = 0.0;  ///< [m] of its mass, ahead of its origin
    /// [kg m^2] about the principal axes of the body, which those of its own are parallel to
    solver::Vector3 inertia = solver::Vector3::Zero(), own_inertia = solver::Vector3::Zero();
  };
  void remember_base(const mjModel_& m);

  SimulatedRobot simulated_;
  Eigen::VectorXd posture_;  ///< q at the start
  SideFriction side_friction_;
  JointFriction joint_friction_;
  Eigen::VectorXd torque_;           ///< of the joints, friction included
  std::vector<double> wheel_loads_;  ///< [N] that the floor carries each wheel with, in the last step
  std::vector<JointAddress> joints_;
  int base_body_ = 0;
  BaseAsBuilt as_built_;
  int base_position_ = 0, base_velocity_ = 0;  ///< of the free joint, in qpos and qvel
  int freedoms_ = 0;
  Eigen::VectorXd q_, qd_;
};

}  // namespace zwang::runtime
