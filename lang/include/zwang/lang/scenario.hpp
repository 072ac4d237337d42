/// A scenario: a claim about a task that `zwang test` tries, in every cell of its matrix.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/diagnostic.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {

/// How the robot of the simulation differs from the one that the task knows, as factors on the latter's.
struct RobotDeviation {
  double friction = 1.0;      ///< dry and viscous, of every joint
  double wheel_radius = 1.0;  ///< of every wheel with a motor
  // Not factors, and nothing that the task knows.
  double encoder_step = 0.0;   ///< [rad] of every joint; 0: exact positions
  double encoder_noise = 0.0;  ///< [rad] standard deviation of every joint's position, failed or not
};

/// One run: what stands in the place of the task file's own words.
struct ScenarioCell {
  std::string name;  ///< "robot diff_base, start_yaw 20 deg"; "as written" where nothing varies
  std::optional<std::filesystem::path> robot, scene;
  std::optional<std::array<double, 2>> start_at;  ///< [m]
  std::optional<double> start_yaw;                ///< [rad]
  std::map<std::string, std::string> parameters;  ///< name -> quantity as text
  std::vector<Fault> faults;                      ///< beside the scene's own
  std::string fault_set;                          ///< whose they are; empty: nobody's
  RobotDeviation deviation;
  bool shows_each_value = false;      ///< one of the few cells in which each value of the matrix occurs
  std::map<std::string, Span> spans;  ///< where `robot`, `scene`, `params.NAME` are written
};

/// A checked scenario file: one cell for each combination of its matrix.
struct Scenario {
  std::string path;
  std::string about;
  std::filesystem::path task;
  double time_limit = 600.0;  ///< [s] of the run; one that goes on for longer is `unfinished`
  std::uint64_t seed = 0;
  std::optional<double> blend;  ///< [s] in the place of that of every task
  std::vector<ScenarioCell> cells;
};

/// The time at which an expectation is judged.
enum class ExpectationKind {
  outcome,     ///< the run ends with `word`
  diagnostic,  ///< the task is refused, and `word` is among the reasons
  at_end,      ///< `that` holds on the last tick of the last task, before the brake
  within,  ///< `that` holds at the latest `within` after the time `of`, and from then on while a task runs
  always,  ///< `that` holds on every tick
};

/// The signals that `that` asks for are the quantities of `truth_names`; group 0 of them does not exist.
struct Expectation {
  ExpectationKind kind = ExpectationKind::outcome;
  std::string word;
  int of_robot = -1;    ///< whose outcome: an index into Scene::robots; -1: the first robot's, and the run's
  double within = 0.0;  ///< [s]
  int of = -1;          ///< index into `truth_names`, a time; -1: the start
  Condition that;
  std::vector<std::string> units;  ///< SI, of what each node of `that` is or compares; "" of the others
  std::string text;                ///< for reports
  Span span;
};

/// The values of expectations: the plant's measurements, and the times of the run's reports. Their order:
/// - `truth_base_count` values of the base, in the order of its enumeration
/// - `truth_object_count` values of each object, likewise
/// - `truth_robot_count` values of each robot of the scene, likewise
/// - the travel of each object with a guide: an angle, or a length
/// - the six true parts of each wrench that the scene measures on the first robot
/// - each output of the task file
/// - of each region, how far inside of it the footprint is [m]
/// - of each task, when it was entered first [s]
enum TruthOfBase {
  truth_x,       ///< [m] of the base's origin in the world
  truth_y,       ///< [m]
  truth_yaw,     ///< [rad]
  truth_vx,      ///< [m/s] along the base's own x
  truth_vy,      ///< [m/s] along its y
  truth_speed,   ///< [m/s] the norm of both
  truth_turn,    ///< [rad/s] about the vertical
  truth_torque,  ///< share of its limit, of the motor nearest to it
  truth_switch,  ///< [N m] most that a motor's torque went in the two ticks of a switch of tasks, so far
  truth_roll,    ///< [rad] about the base's own x
  truth_pitch,   ///< [rad] about its y
  truth_acceleration,  ///< [m/s^2] of its origin, mean of 20 ms without hits
  truth_push,          ///< [N] of the whole robot in the plane, mean of 20 ms without hits
  truth_slip,          ///< [m/s] of the wheel that slides fastest
  truth_hand,          ///< [N] of all hands on the whole robot
  truth_astray,        ///< [m] of a corner of the footprint from where the robot has it, the largest
  truth_mass,          ///< [kg] of the whole robot, with its payload
  truth_drift,         ///< [m] from where the first fault of the scenario found the base
  run_done,            ///< [s] when the task reached `done`; unknown after a stop
  run_fault,           ///< [s] when the first fault of the scenario began
  run_stopped,         ///< [s] when the protective stop latched
  run_slipped,         ///< [s] when slip was told first
  truth_base_count
};
/// Values of one object.
enum TruthOfObject {
  truth_force,     ///< [N] that the first robot's body presses on it with
  truth_peak,      ///< [N] the largest so far
  truth_steady,    ///< [N] what `force` less `pull` has been for half a second, while the base kept its speed
  truth_touched,   ///< [s] when it was touched first
  truth_object_x,  ///< [m] in the world
  truth_object_y,  ///< [m]
  truth_object_yaw,   ///< [rad]
  truth_latched,      ///< [s] when a hook latched in its dock
  truth_pull,         ///< [N] with which the hook pulls the dock outwards; 0 while it is not latched
  truth_object_hand,  ///< [N] of all hands on it
  truth_stiffness,    ///< [N/m] of one contact point
  truth_object_count
};
/// Of another robot: what an object has, and
enum TruthOfRobot {
  truth_robot_speed = truth_object_count,  ///< [m/s]
  truth_robot_turn,                        ///< [rad/s]
  truth_robot_torque,                      ///< share, as truth_torque
  truth_robot_stopped,                     ///< [s] when its protective stop latched
  truth_robot_count
};
/// The names of these values in that order, as conditions of scenarios write them.
ZWANG_EXPORT std::vector<std::string> truth_names(const Program& program);

/// Reads a scenario file, multiplies its matrix out, and checks the parameters that it names against those
/// that the task file declares. On any error nullopt, and the diagnostics say why.
ZWANG_EXPORT std::optional<Scenario> load_scenario(const std::filesystem::path& path,
                                                   Diagnostics& diagnostics);

/// As `load_scenario`, and asks of every cell what `load_run` would, without running it. Is the task refused
/// on this robot and in this scene, where the scenario does not expect it? Which quantities do the
/// expectations name there? Do the faults have something that can fail? The task file alone is not judged.
ZWANG_EXPORT std::optional<Scenario> check_scenario(const std::filesystem::path& path,
                                                    Diagnostics& diagnostics);

/// A cell ready to run.
struct ScenarioRun {
  std::optional<Program> program;  ///< none: the task was refused, and `of_task` says why
  std::vector<Expectation> expectations;
};

/// nullopt when the scenario itself is wrong: `of_scenario` says why. Both may be empty lists of diagnostics.
ZWANG_EXPORT std::optional<ScenarioRun> load_run(const std::filesystem::path& path, std::size_t cell,
                                                 Diagnostics& of_scenario, Diagnostics& of_task);

}  // namespace zwang::lang
