/// The simulation behind MujocoPlant: MuJoCo's model and data, the robots and objects in them, what is true
/// of them. It is set up in plant_start.cpp and plant_settle.cpp, and stepped and read in mujoco_plant.cpp.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base_watch.hpp"
#include "contact_friction.hpp"
#include "contact_reader.hpp"
#include "moving_robot.hpp"
#include "simulated_object.hpp"
#include "simulator.hpp"
#include "zwang/runtime/mujoco_plant.hpp"

namespace zwang::runtime {

struct MujocoPlant::Simulation {
  struct Start {
    std::array<double, 2> at;
    double yaw;
  };

  /// A socket: of an object, or of one of the scene's robots.
  struct SimulatedDock {
    std::size_t owner = 0;  ///< in the truth's objects
    lang::Dock dock;
    int body = 0;  ///< that the hook is tied to
    int equality = -1;
    int hook_body = 0;
    int hook_part = 0;                               ///< the same body of the robot's model
    solver::Vector3 hook = solver::Vector3::Zero();  ///< [m] in that body
    bool holds = true;
  };

  /// At a frame of a robot, in the place of a signal of the scene.
  struct WrenchSensor {
    std::size_t robot, signal;         ///< in the truth's wrenches
    int body;                          ///< of the simulation
    solver::Pose pose;                 ///< of the frame in it
    std::vector<std::size_t> carried;  ///< bodies of the robot's model: the frame's and what hangs on it
  };

  // Set up, in plant_start.cpp.
  Simulation(const lang::Robot& robot, const lang::Scene& scene, const MujocoPlantOptions& options);
  static std::vector<SimulatedRobot> describe_robots(const lang::Robot& robot, const lang::Scene& scene,
                                                     bool real_rollers);
  void find_addresses();
  void find_objects(const lang::Scene& scene);
  /// The floor under an object with a mass.
  void add_floor(double friction, SimulatedObject& object) const;
  void find_docks(const lang::Scene& scene);
  void find_sensors(const lang::Scene& scene);
  /// Lets the robots sink into their wheels' contacts. Then puts them exactly where they start, at rest, at
  /// t = 0. Height and tilt of the settled base are kept.
  void start(const std::vector<Start>& starts);
  void settle(const std::vector<Start>& starts);
  /// Of a robot on the floor: height [m], roll and pitch [rad] of its base, or how fast each of them changes
  /// its speed.
  using Lean = solver::Vector3;
  void lean(const std::vector<Start>& starts, const std::vector<Lean>& leans) noexcept;
  /// Accelerations of robots that lean so, at rest and without torque; nothing if MuJoCo fails.
  std::optional<std::vector<Lean>> accelerations(const std::vector<Start>& starts,
                                                 const std::vector<Lean>& leans);
  /// Where the floor carries every robot, near `at`; nothing if one of them is not firm there.
  std::optional<std::vector<Lean>> find_rest(const std::vector<Start>& starts, std::vector<Lean> at);
  /// The same by time that passes: also of robots that fall meanwhile.
  void drop(const std::vector<Start>& starts);
  void refuse_overlap() const;
  std::string name_of(const GeomOwner& owner) const;

  // Step by step.
  MovingRobot& first() noexcept { return robots.front(); }
  const MovingRobot& first() const noexcept { return robots.front(); }
  int id_of(int type, const std::string& name) const;
  /// Ties a hook to the object where it is, if it is near enough to its socket and pressed hard enough on it.
  void latch_hooks() noexcept;
  void set_dock(std::size_t owner, bool holds) noexcept;
  /// MuJoCo's tie pushes the hook with `f`, and so the dock with -f: pull = -f . n, n outwards.
  void read_pulls() noexcept;
  void read_objects() noexcept;
  void set_floor_friction(double coefficient) noexcept;
  void set_wheel_friction(std::size_t robot, std::size_t wheel, double coefficient) noexcept;
  /// Of a pair of geoms that may touch the one that rolls, if any does.
  const GeomOwner& rolling_in(int pair) const;
  void set_pair_friction(int pair, double coefficient) noexcept;
  const GeomOwner& owner_of(int geom) const { return contacts.owner_of(geom); }
  /// An object without joints, where its motion has it.
  void place_fixed(const SimulatedObject& object) noexcept;
  /// One step; false when the simulation is void.
  bool step() noexcept;
  void read_loads() noexcept;
  void read_base() noexcept;
  BaseTruth& base_truth(std::size_t robot) noexcept {
    return robot == 0 ? truth.base : truth.robots[robot - 1].base;
  }
  /// After `contacts` and the docks were read; `before` [s] is the beginning of the step.
  void read_motion(double before) noexcept;
  void look_for_falls() noexcept;
  void add_push(const GeomOwner& owner, const solver::Vector3& force, const solver::Vector3& at) noexcept;
  /// Counted: MuJoCo's own clock adds up its steps and with them their rounding.
  double time() const noexcept;
  PlantStatus give(std::size_t robot, const Eigen::VectorXd& tau) noexcept;
  PlantStatus apply(const Eigen::VectorXd& tau) noexcept;
  PlantStatus sense(std::size_t robot, Sensed& sensed) const noexcept;
  /// The force of the hand goes into the step, behind the friction of contacts, and to the sum of all
  /// contacts.
  void press_by_hand() noexcept;
  void feel_hand() noexcept;
  /// Where a push presses, and with what, in world axes: `act(body, point, force, torque)`.
  template <typename Act>
  void for_each_push(Act act) const;
  void read_wrenches() noexcept;

  std::vector<MovingRobot> robots;  ///< the first, then the scene's
  std::string text;
  ModelPointer model;
  DataPointer data;
  ContactReader contacts;
  ContactFriction contact_friction;
  std::vector<BaseWatch> watches;  ///< by robot
  std::vector<SimulatedObject> objects;
  std::vector<SimulatedDock> docks;
  solver::Vector3 velocity = solver::Vector3::Zero();
  Push push;
  std::vector<BodyPush> more_pushes;
  std::vector<WrenchSensor> sensors;
  std::vector<std::vector<int>> bodies;  ///< the simulation's number of each body, by robot
  Truth truth;
  std::int64_t steps_since_start = 0;
  bool diverged = false;
};

}  // namespace zwang::runtime
