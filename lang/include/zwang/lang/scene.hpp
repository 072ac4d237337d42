/// A scene: what stands around a simulated robot.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

struct Program;

/// Where a scripted object stands at a time; between two of them it moves straight and evenly.
struct Waypoint {
  double time = 0.0;           ///< [s]
  std::array<double, 2> at{};  ///< [m] world
  double yaw = 0.0;            ///< [rad]
};

/// A socket in which a hook latches.
struct Dock {
  std::array<double, 2> at{};  ///< [m] in the axes of the object, from its `at`
  double reach = 0.02;         ///< [m] the hook latches when its frame is as near as this
  double press = 0.0;          ///< [N] and when the first robot presses on the object as hard as this
  std::string hook;            ///< a frame of the first robot
  Span hook_span{};
  /// An output of the first robot's task file: the dock catches and holds while it is true. Empty: for good.
  std::string held_while;
  Span held_while_span{};
};

enum class ShapeKind { box, cylinder, wall };

/// It carries an object and leaves it one way to move: a turn about an axis, or a slide along it. The travel
/// q is 0 where the object was written. Positive: to the left about the axis, or along it.
struct Guide {
  bool turns = true;                          ///< about the axis; else it slides along it
  std::array<double, 3> at{};                 ///< [m] a point of the axis, in the object's axes from its `at`
  std::array<double, 3> axis{0.0, 0.0, 1.0};  ///< its direction in the object's axes
  double lower = 0.0, upper = 0.0;            ///< [rad] or [m]; 0 lies in between
  double preload = 0.0;                       ///< [N m] or [N] towards 0, where 0 is an end of the range
  double stiffness = 0.0;                     ///< [N m/rad] or [N/m] of a spring that is relaxed at 0
  double damping = 0.0;                       ///< [N m s/rad] or [N s/m]
  double friction = 0.0;                      ///< [N m] or [N], dry
  bool locked = false;                        ///< nothing moves it
};

/// An object that the robot can meet.
struct SceneObject {
  std::string name;
  ShapeKind shape = ShapeKind::wall;
  std::array<double, 3> size{};  ///< [m] full extents of a box; radius, radius, height of a cylinder; length,
                                 ///< thickness, height of a wall
  std::array<double, 2> at{};    ///< [m] world; a wall's `at` is a point of its face, midway along it
  double yaw = 0.0;  ///< [rad] a wall's face looks along its own -x: a robot that drives along +x meets it
                     ///< square at yaw 0
  /// [rad] Of a fixed box or wall that leans: it is turned about its `at` on the floor, by the roll first.
  double roll = 0.0, pitch = 0.0;
  std::optional<double> mass;      ///< [kg]; none: fixed to the world
  std::optional<Guide> guide;      ///< of one that has a mass, and does not stand on the floor
  std::optional<double> slides;    ///< Coulomb coefficient on the floor; none: by `friction` and the floor's
  double caster_trail = 0.0;       ///< [m] of four swivel casters at its corners; 0: it has none
  double stiffness = 1e5;          ///< [N/m] of one contact point
  double damping = 0.3;            ///< damping ratio of the contact
  std::optional<double> friction;  ///< Coulomb coefficient; none: that of what it touches
  std::vector<Waypoint> motion;    ///< scripted: moves whatever stands in its way; empty: none
  std::optional<Dock> dock;
  Span span;

  /// By pushes, or by its script; else it is fixed to the world.
  bool moves() const { return mass || !motion.empty(); }
  bool is_locked() const { return guide && guide->locked; }
  bool leans() const { return roll != 0.0 || pitch != 0.0; }
  /// [1/kg] 0: nothing pushes it.
  double inverse_mass() const { return mass && !is_locked() ? 1.0 / *mass : 0.0; }
  /// About the vertical through its middle; 0 without a mass. [kg m^2]
  double yaw_inertia() const {
    const double m = mass.value_or(0.0), a = size[0], b = size[1];
    return shape == ShapeKind::cylinder ? 0.5 * m * a * a : m / 12.0 * (a * a + b * b);
  }
  /// Coulomb coefficient on a floor that has `floor`: the more slippery surface of the two gives way first.
  double slides_on(double floor) const { return slides.value_or(std::min(friction.value_or(floor), floor)); }
};

/// One value of a script, from its time on.
struct ScriptStep {
  double time = 0.0;   ///< [s] from here on
  double value = 0.0;  ///< SI; 0 and 1 of a bool
  bool valid = true;   ///< false: nothing is measured
};

/// The type of a script's steps.
enum class ScriptKind {
  lost,   ///< nothing else
  truth,  ///< true and false
  number
};

/// The quantity that a signal of the scene measures.
enum class SceneSignalKind {
  script,    ///< a bool or a number
  pose,      ///< of the object or robot, in the frame that the task file's signal is seen from
  distance,  ///< of the object's or robot's edge from the seeing robot's base frame, in the plane [m]
  latch,     ///< whether the hook holds in the dock of the object or robot
  force,     ///< that the first robot and the object or robot press each other with [N]
  travel,    ///< how far an object has gone in its guide [rad] or [m], or whether that is `beyond`
  wrench,    ///< that presses on the link of a frame of the seeing robot, and on all that it carries
};

/// Where a signal of the task file with this name comes from, and how well it is measured.
struct SceneSignal {
  std::string name;
  SceneSignalKind kind = SceneSignalKind::script;
  std::vector<ScriptStep> script;
  ScriptKind script_kind = ScriptKind::lost;
  /// Of length, mass, time and angle, in what the numbers of a script or a travel measure.
  std::array<int, 4> powers{};
  std::optional<double> beyond;  ///< [rad], [m] true where the travel is as far from 0, on its side
  Span source_span{};            ///< of what is seen; of a script its first value
  int object = -1;               ///< what is seen: an index into Scene::objects, or of a robot (`seen_robot`)
  std::string frame;             ///< of a wrench: the sensor's axes and its origin
  double noise = 0.0;            ///< [m], [N] standard deviation of a distance, a pose's x and y, a force
  double bias = 0.0;             ///< [N] that a force is measured too large
  std::array<double, 3> force_bias{};  ///< [N] of a wrench, along the sensor's axes
  double angle_noise = 0.0;            ///< [rad] of a pose's yaw
  double delay = 0.0;                  ///< [s] from the measurement to its arrival
  double period = 0.0;                 ///< [s] between measurements; 0: every tick
  double dropouts = 0.0;               ///< the share of measurements that are lost, 0 to 1
  Span span;
};

/// Standard deviations of what the robot is told of itself; all 0: the plant's truth.
struct StateNoise {
  double position = 0.0;     ///< [m]
  double yaw = 0.0;          ///< [rad]
  double velocity = 0.0;     ///< [m/s]
  double turn = 0.0;         ///< [rad/s]
  double delay = 0.0;        ///< [s] of whole samples, joints and stamp included
  bool wheels_only = false;  ///< the base is not measured tick by tick: the joints are, and where it starts
  /// With `wheels_only`: how somebody measures the base's pose now and then. Its name and source mean
  /// nothing.
  std::optional<SceneSignal> fix;
};

/// The kind of a fault.
enum class FaultKind {
  samples_lost,     ///< no sample arrives
  samples_nan,      ///< an entry of the state is not a number
  samples_inf,      ///< it is infinite
  samples_huge,     ///< it is 1e300
  samples_frozen,   ///< the state of the fault's begin, with the clock running on
  samples_dead,     ///< the joints' positions of the fault's begin, and rates that are 0
  clock_backwards,  ///< samples are stamped 10 ms before the fault's begin
  clock_ahead,      ///< they are stamped 200 ms late
  torque_lost,      ///< of `joint`: the motor gives none
  torque_stuck,     ///< it keeps what it gave at the fault's begin
  torque_flipped,   ///< it gives the opposite
  floor_friction,   ///< the floor's friction is `value`, under the wheel `joint` or under all wheels
  payload,          ///< the base weighs `value` [kg] more, where its centre of mass is; negative: less
  centre_of_mass,   ///< the base's own centre of mass lies `value` [m] farther ahead
  inertia,          ///< the base turns `value` times its own inertia harder; negative: more easily
  plant_diverges,   ///< the simulation leaves the finite numbers
  object_leaves,    ///< `object` goes `leaves_by` away from the first robot within `leaves_within`
};

/// The way of an object that leaves, and the time for it: faster than any robot follows.
inline constexpr double leaves_by = 3.0, leaves_within = 0.2;  // [m], [s]

/// A fault that begins at a time.
struct Fault {
  FaultKind kind = FaultKind::samples_lost;
  double at = 0.0;                                            ///< [s]
  double duration = std::numeric_limits<double>::infinity();  ///< [s]
  std::string joint;                                          ///< of a motor or a wheel; empty: of none
  Span joint_span{};
  std::string robot;  ///< whose: one of Scene::robots; empty: the first one's, or the world's
  Span robot_span{};
  std::string object;  ///< of the scene, that leaves
  Span object_span{};
  /// A time of the run from which `at` counts, as an expectation names it: `run.entered.press`. Empty: the
  /// start.
  std::string of;
  Span of_span{};
  double value = 0.0;  ///< of the kinds that have one, in the unit that FaultKind names
  bool is_drawn =
      false;  ///< by a study: from the start the robot differs from its model; not a fault of the run
  Span span;
};

/// A person's hand on a robot or on an object.
struct ScenePush {
  double at = 0.0;                                            ///< [s]
  double duration = std::numeric_limits<double>::infinity();  ///< [s]
  std::string robot;                        ///< whose frame: one of Scene::robots; empty: the first one's
  std::string object;                       ///< pressed on in the place of a robot; empty: none
  std::string frame;                        ///< of the robot, at whose origin it presses; empty: its base's
  std::array<double, 2> point{};            ///< [m] of the object, from its `at`
  std::array<double, 3> force{}, torque{};  ///< [N], [N m] in the axes of the frame or the object
  Span whose_span{}, frame_span{}, wrench_span{};
};

/// A parameter's value as a scene writes it.
struct GivenParameter {
  std::string name, value;  ///< `push`, `20 N`
  Span name_span, value_span;
};

/// Another robot, under a task file of its own. The first robot meets its footprint as it meets an object.
struct SceneRobot {
  std::string name;
  std::string task;  ///< path of its task file, as written
  Span task_span;
  std::string robot;  ///< path of its robot file, in the place of the task's own; empty: that one
  Span robot_span;
  std::vector<GivenParameter> parameters;  ///< in the place of its task file's own values
  std::string robot_path;                  ///< the same, as it was opened
  std::array<double, 2> at{};              ///< [m] where its base starts in the world
  double yaw = 0.0;                        ///< [rad]
  double stiffness = 1e5;                  ///< [N/m] of one contact point
  double damping = 0.3;                    ///< damping ratio of the contact
  std::optional<double> friction;          ///< as SceneObject::friction
  std::optional<Dock> dock;                ///< `at` in the axes of its base
  std::vector<SceneSignal> signals;        ///< those of its own task file
  StateNoise state;
  /// Its task file, loaded; without the objects of this scene. None where the scene alone was read.
  std::shared_ptr<const Program> program;
  Span span;
};

/// Beside the first robot.
inline constexpr std::size_t most_scene_robots = 4;

/// A checked scene file.
struct Scene {
  std::string path;                  ///< as it was opened
  std::array<double, 2> start_at{};  ///< [m] world
  double start_yaw = 0.0;            ///< [rad]
  double floor_friction = 0.9;       ///< Coulomb coefficient
  bool real_rollers = false;         ///< mecanum and omni wheels are built roller by roller
  Span real_rollers_span;
  std::vector<SceneObject> objects;
  std::vector<SceneRobot> robots;  ///< beside the first one
  std::vector<SceneSignal> signals;
  StateNoise state;
  std::vector<Fault> faults;
  std::vector<ScenePush> pushes;

  /// How SceneSignal::object calls a robot: -1 the first one, which scenes call `base`, else an index into
  /// `robots`.
  int seen_robot(int robot) const { return static_cast<int>(objects.size()) + 1 + robot; }
};

/// Reads and checks a scene file by itself, and the task files of its other robots. On any error nullopt, and
/// the diagnostics say why.
ZWANG_EXPORT std::optional<Scene> load_scene(const std::filesystem::path& path, Diagnostics& diagnostics);

}  // namespace zwang::lang
