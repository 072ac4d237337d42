/// A robot: its URDF, and the robot file that says what a URDF cannot.
#pragma once

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/diagnostic.hpp"
#include "zwang/solver/constraint.hpp"
#include "zwang/solver/model.hpp"
#include "zwang/solver/state.hpp"

namespace zwang::lang {

/// A range on one planar axis of the base (x, y or rz), with its place in the robot file.
struct BaseLimit {
  solver::Axis axis = solver::Axis::x;
  solver::Quantity quantity = solver::Quantity::acceleration;
  solver::Range range;  ///< SI
  Span span;
};

/// The one brake: after `done`, after `failed`, and in a protective stop.
struct Stop {
  double deceleration = 1.0;  ///< [m/s^2]
  double force = 100.0;       ///< [N]
};

/// Dry and viscous friction of a joint, and how much of it the controller makes up for.
struct JointFriction {
  double coulomb = 0.0;     ///< [N m] or [N]
  double presliding = 0.0;  ///< how far the joint gives before it slides [rad] or [m]; 0: not known
  double viscous = 0.0;     ///< [N m s/rad] or [N s/m]
  double compensate = 0.0;  ///< fraction in [0, 1)
};

/// Where a robot file gives no `control_period`. [s]
inline constexpr double default_control_period = 1e-3;
/// The longest control period [s]. Limits brake within a horizon h of the same length. An axis that brakes to
/// a limit within h loses dt / h of its excess from tick to tick.
inline constexpr double longest_control_period = 10e-3;
inline constexpr double shortest_control_period = 0.1e-3;

/// The way that the guard lets motors move a wheel's rim before an encoder confirms it. It is the larger of
/// `least_blind_way` [m] and `blind_steps` steps of the encoder.
inline constexpr double least_blind_way = 0.5e-3;
inline constexpr double blind_steps = 4.0;
/// Of an encoder: 63 steps a turn. [rad]
inline constexpr double longest_encoder_step = 0.1;

/// Where a robot file gives no `slew`, a motor takes as long for all of its torque. [s]
inline constexpr double full_torque_within = 5e-3;

/// A flat end of an arm: a rectangle across the x axis of a frame, which touches with its four corners.
struct Pad {
  std::string frame;                 ///< of a link that a motor moves
  double width = 0.0, height = 0.0;  ///< [m] along the frame's y and z
};

/// The source by which a robot feels contact forces. The sensor's low pass is of first order.
struct Feels {
  enum class By {
    nothing,
    wrench,  ///< a sensor between the base and what touches the world
    effort,  ///< the torques of the wheels' motors
  };
  By by = By::nothing;
  std::string frame;        ///< of a wrench: its axes and its origin, fixed to the base
  double noise = 0.0;       ///< standard deviation of a sample: [N] of a wrench, [N m] of an effort
  double resolution = 0.0;  ///< [N m] of an effort; 0: not known
  double filter = 0.0;      ///< [s] time constant of the sensor's low pass

  /// A wrench's moments have the noise of its forces at this arm. [m]
  static constexpr double moment_arm = 0.1;
};

/// The commands that the motors' drive takes, and its delay. Half of the delay is an encoder's value on its
/// way to the runtime. The other half is the command on its way to the wheel.
struct Drive {
  bool takes_velocity = false;  ///< false: torques
  bool takes_twist = false;     ///< of the base; false: velocities of the wheels
  /// The drive has torque limits of its own. False: one is sent with each velocity.
  bool limit_is_fixed = false;
  double rate = 0.0;                    ///< [1/s] of commands and of samples
  double delay = 0.0;                   ///< [s]
  double time_constant = 0.0;           ///< T_c [s] of the wheels' velocity loops
  std::optional<double> integral_time;  ///< T_i [s] of the same; none: they have no integral
  Feels feels;
  /// Of a robot that feels, chosen for its drive: the virtual robot is so many times as heavy as the real
  /// one,
  double mass_factor = 1.0;
  double contact_damping = 0.0;  ///< and while something presses on it, each velocity fades so fast [1/s]

  /// It pushes as hard as it can until its wheels turn as they are told: the base is led by a virtual robot.
  bool has_virtual_robot() const { return takes_velocity && limit_is_fixed; }
  /// And nothing tells of forces.
  bool is_blind() const { return has_virtual_robot() && feels.by == Feels::By::nothing; }
  bool feels_contact() const { return has_virtual_robot() && feels.by != Feels::By::nothing; }

  /// Within which limits act [s]: of a drive that takes velocities from a sample to what the wheels make of
  /// it. A virtual robot does at once what the solver says.
  double horizon() const {
    if (!takes_velocity || has_virtual_robot()) return solver::limit_horizon;
    return std::max(solver::limit_horizon, time_constant + delay + 1.0 / rate);
  }
};

/// The slowest and the latest drive that zwang has been tried on.
inline constexpr double slowest_drive_rate = 20.0;    ///< [1/s]
inline constexpr double longest_drive_delay = 50e-3;  ///< [s]

/// A checked robot file with its model. SI; vectors by joint are parallel to the joints of the model.
struct Robot {
  std::string name;
  solver::Model model;
  std::string base_frame;  ///< the link that floats
  /// `base` and `lead`, as far as neither the URDF nor the robot file has a link or frame of that name.
  std::vector<std::string> implied_frames;
  std::vector<BaseLimit> limits;
  Stop stop;
  std::vector<solver::Vector3>
      footprint;                        ///< polygon corners in the base frame [m], z = 0, counter-clockwise
  std::vector<JointFriction> friction;  ///< of each joint
  /// How fast each joint's torque may change [N m/s] or [N/s]; infinite without a motor. Empty: not limited.
  Eigen::VectorXd slew;
  Eigen::VectorXd posture;            ///< q at the start [rad] or [m]; empty: all 0
  std::vector<std::string> supports;  ///< passive links that hold nothing in the plane
  double bumper_height = 0.15;        ///< [m] above the ground where the footprint touches the world
  bool bumper_height_said = true;     ///< by the robot file; else the height above is a guess
  double bumper_stiffness = 20e3;     ///< [N/m]
  double control_period = default_control_period;  ///< [s] from one torque to the next
  double encoder_step = 0.0;                       ///< [rad] of the driven wheels; 0: not known
  Drive drive;
  std::vector<Pad> pads;
  std::vector<Span> joint_spans;  ///< where each joint's limits come from
};

/// How the robot stands before it moves: at the world's origin, its joints in their posture.
ZWANG_EXPORT solver::State start_state(const Robot& robot);

/// Reads and checks a robot file and the URDF it names. The only URDF reader. On any error nullopt, and the
/// diagnostics say why.
ZWANG_EXPORT std::optional<Robot> load_robot(const std::filesystem::path& path, Diagnostics& diagnostics);

}  // namespace zwang::lang
