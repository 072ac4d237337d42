/// A simulated robot in a simulated scene, on MuJoCo. The simulation is written from our own model, never
/// from a URDF.
#pragma once

#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/lang/scene.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::runtime {

/// The simulator's measurements of an object, not the beliefs of the controller.
struct ObjectTruth {
  std::string name;
  double force = 0.0;  ///< [N] normal force that the first robot presses on it with, now, all contacts
  std::optional<double> touched;       ///< [s] time of the first contact
  double peak_force = 0.0;             ///< [N] largest `force` so far
  double x = 0.0, y = 0.0, yaw = 0.0;  ///< [m], [rad] of the object's `at`, of a robot's base
  std::optional<double> latched;       ///< [s] since when a hook holds in its dock
  double pull = 0.0;    ///< [N] with which that hook pulls the dock outwards, now; negative: inwards
  double travel = 0.0;  ///< [rad] about its hinge or [m] along its slide, from where it was written
  double hand = 0.0;    ///< [N] how hard all hands press on it, now; of a robot on the whole of it
  /// [N] those normal forces on the first robot at the peak, in world axes; and the body of its model.
  Eigen::Vector3d peak_push = Eigen::Vector3d::Zero();
  int peak_body = 0;
};

/// Of a robot's base, beside its place and its planar motion.
struct BaseTruth {
  double mass = 0.0;               ///< [kg] of the whole robot, with its payload
  double roll = 0.0, pitch = 0.0;  ///< [rad] about its own x, then y; 0 on its wheels
  /// Means over 20 ms. While a hit falls into them they keep their value.
  double acceleration = 0.0;  ///< [m/s^2] of its origin, in the plane
  double push = 0.0;          ///< [N] planar sum of all contacts and docks of the whole robot
  double hand = 0.0;          ///< [N] how hard all hands press on the whole robot, now
  /// Of the same, at the base's origin and in its axes, now: x, y [N], rz [N m].
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();
  /// [m/s] with which its worst wheel slides over the floor, beyond a tenth of its rim's speed, low-passed
  /// with 50 ms. `slipped`: when it was above `told_slip` first. [s]
  double slip = 0.0;
  std::optional<double> slipped;
  double most_slip = 0.0;  ///< [m/s] up to now
  /// [s] since when it does not stand on its wheels and supports any more: it leans by more than
  /// `largest_lean`, or its body lies on the floor.
  std::optional<double> fallen;
};

/// As the guard's slip event has it. [m/s]
inline constexpr double told_slip = 0.02;
/// A wheel of a base half a metre long is 9 cm off the floor then, and a sixth of the weight pulls along it.
/// No base that its wheels carry comes near. [rad]
inline constexpr double largest_lean = 10.0 * std::numbers::pi / 180.0;
/// A base that stands on its wheels leans by less, and leans on by less. [rad], [rad/s]
inline constexpr double standing_lean = 2.0 * std::numbers::pi / 180.0;
inline constexpr double standing_turn = 1.0 * std::numbers::pi / 180.0;
/// `fell over: roll 1 deg, pitch -14 deg`
ZWANG_EXPORT std::string describe_fall(const BaseTruth& base);

/// Of another robot, beside what is an object's.
struct RobotTruth {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< as Truth::velocity
  BaseTruth base;
};

/// All measurements of the simulator at one instant. The controller never sees them.
struct Truth {
  double time = 0.0;         ///< [s]
  double x = 0.0, y = 0.0;   ///< [m] base frame in the world
  double yaw = 0.0;          ///< [rad]
  Eigen::Vector3d velocity;  ///< planar twist of the base in base axes: vx, vy [m/s], wz [rad/s]
  Eigen::Vector3d
      acceleration;  ///< rates of the components of `velocity` over the last step [m/s^2, m/s^2, rad/s^2]
  BaseTruth base;
  std::vector<double> corner_forces;  ///< [N] normal force on each corner of the footprint, now
  std::vector<ObjectTruth> objects;   ///< the scene's objects, then its robots
  std::vector<RobotTruth> robots;     ///< the scene's
  /// By robot, the first one's first, and by its signals in the scene. Of a wrench: what presses on the link
  /// of its frame and on all that it carries, in the axes of the frame and about its origin. The floor and
  /// the weight are left out. Zero of other signals.
  std::vector<std::vector<solver::ForceVector>> wrenches;
};

/// The force of a hand on the first robot's base, in addition to the scene's forces.
struct Push {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();     ///< [m] where, in the base's axes, as high as its origin
  Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< [N] in the world's axes
};

/// The wrench of a hand on any body.
struct BodyPush {
  int robot = 0;      ///< 0 is the first one; -1: an object
  int body = 0;       ///< of the robot's model; or the object, by its number in the scene
  solver::Pose pose;  ///< of the place and the axes in which it presses: in the body; of an object in
                      ///< its axes, from its `at`
  solver::ForceVector wrench;  ///< [N m], [N] at that place and in those axes
};

/// Of the library that is loaded, as `2.3.7`.
ZWANG_EXPORT const char* mujoco_version() noexcept;

struct MujocoPlantOptions {
  double period = 1e-3;                           ///< [s] of a simulation step
  std::optional<std::array<double, 2>> start_at;  ///< [m] in the world; overrides the scene's
  std::optional<double> start_yaw;                ///< [rad] likewise
  /// Mecanum and omni wheels with eighteen rollers each, as they are built, in the place of smooth ones:
  /// slower, and with their ripple. Scenes may say so, too.
  bool real_rollers = false;
};

/// Wheels that hold one direction are spheres that act exactly as the model's wheels do. Other wheels are
/// spheres on hinges, and wheels that skid slide sideways against dry friction. Dry and viscous friction of
/// the joints is the robot file's. The robot meets objects with the corners and sides of its footprint's
/// convex hull, at the bumper's height. Each contact point is a spring of the object's stiffness. Objects
/// with a mass slide on the floor. The scene's other robots are in the same simulation. The host gives them
/// torques before `apply`, or they keep their last. Contact forces are those of the last step, so they belong
/// to the instant at its beginning. MuJoCo's error and warning handlers are replaced for the whole process.
class ZWANG_EXPORT MujocoPlant : public Plant {
 public:
  /// Throws std::invalid_argument when the robot or the scene cannot be simulated, with the reason.
  MujocoPlant(const lang::Robot& robot, const lang::Scene& scene, const MujocoPlantOptions& options = {});
  ~MujocoPlant() override;

  /// The base is measured. Once diverged, always diverged, and `sensed` stays as it is.
  PlantStatus sense(Sensed& sensed) noexcept override;
  /// `unreachable`, and no step, for torques that are not finite or too few. Torques are not clamped here.
  PlantStatus apply(const Eigen::VectorXd& tau) noexcept override;
  /// Of another robot, by its number in the scene; its numbers belong to the same instant as the first one's.
  PlantStatus sense_partner(std::size_t partner, Sensed& sensed) const noexcept;
  /// For the next step, which `apply` makes.
  PlantStatus give_partner(std::size_t partner, const Eigen::VectorXd& tau) noexcept;
  const Truth& truth() const noexcept;
  /// From now on; kept finite and positive by the caller.
  void set_floor_friction(double coefficient) noexcept;
  /// The same under one wheel, by its number in the model. `robot`: 0 is the first one, others follow in the
  /// order of the scene.
  void set_wheel_friction(std::size_t robot, std::size_t wheel, double coefficient) noexcept;
  /// The base weighs this much [kg] more than its model says, where its centre of mass is; negative: less,
  /// and the caller leaves it some.
  void set_payload(double mass) noexcept;
  void set_partner_payload(std::size_t partner, double mass) noexcept;
  /// The base's own centre of mass, without the wheels and arms, lies this much [m] farther ahead than its
  /// model says. `robot` as above.
  void shift_centre_of_mass(std::size_t robot, double ahead) noexcept;
  /// The base's own inertia about its centre of mass is that of its model times `factor`, > 0. `robot` as
  /// above.
  void scale_inertia(std::size_t robot, double factor) noexcept;
  /// From the next step on, until another one; finite.
  void set_push(const Push& push) noexcept;
  /// Beside that one; as many as there ever were do not allocate.
  void set_more_pushes(std::span<const BodyPush> pushes) noexcept;
  /// From now on an object of the scene, by its number, follows these points in time instead of its own,
  /// whatever stands in its way. At least one point. After the last one an object with a mass is let go. A
  /// fixed object meets the robot as if it stood: the dampers of its contacts do not see how fast it moves.
  void move_object(std::size_t object, std::vector<lang::Waypoint> motion);
  /// Whether the dock of an object or robot, by its number in `Truth::objects`, catches and holds. At first
  /// each does. A dock that lets go has not latched.
  void set_dock(std::size_t owner, bool holds) noexcept;
  /// As if the simulation had failed.
  void diverge() noexcept;
  /// The MJCF that was compiled, for inspection.
  const std::string& mjcf() const noexcept;

 private:
  struct Simulation;
  std::unique_ptr<Simulation> simulation_;
};

}  // namespace zwang::runtime
