/// A first task and scene for a robot: a shipped use case, fitted to its outline, its freedoms and its mass.
#pragma once

#include <Eigen/Core>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

/// The use cases that can be fitted.
ZWANG_EXPORT const std::vector<std::string>& fitted_tasks();

/// The motions that a base has.
enum class Freedoms {
  all,      ///< ahead, sideways and about the vertical; or not known yet
  two,      ///< plain wheels on one axle hold it sideways
  skid,     ///< wheels that slide sideways, and no motor pushes it there
  steered,  ///< wheels that motors steer
};

/// The properties of a base that a use case has to fit.
struct BaseFit {
  std::string robot;  ///< its name, for comments
  std::vector<Eigen::Vector2d>
      outline;               ///< [m] corners in the axes of `base`; of the wheels alone where it is not known
  double heading = 0.0;      ///< [rad] of those axes in the base, about its own origin
  double front_lever = 0.0;  ///< [m] from the middle to the nearer end of the edge ahead
  double axle = 0.0;         ///< [m] ahead of the base's origin; 0: nothing holds the base sideways
  bool outline_is_known = false;
  double arm_reach = 0.0;  ///< [m] from the base's origin to the farthest point of an arm beyond the outline
  double arm_ahead = 0.0;  ///< [m] in the base, the foremost of those points; 0: none is ahead
  double mass = 0.0;       ///< [kg]; 0: not known
  double largest_force = 0.0;   ///< [N] of the motors along x; 0: not known
  double effective_mass = 0.0;  ///< [kg] that a force along x moves, wheels and rotors included; 0: not known
  double effective_inertia = 0.0;    ///< [kg m^2] of a turn, likewise
  Eigen::Vector2d centre{0.0, 0.0};  ///< [m] of the mass, in the axes of `base`
  Freedoms freedoms = Freedoms::all;
  std::string base = "base";  ///< what a task calls it
};

/// The masses are those of the first robot that the draft assumes. Unknown values keep their default.
ZWANG_EXPORT BaseFit base_fit(const RobotDraft& draft);
ZWANG_EXPORT BaseFit base_fit(const Robot& robot);

/// What keeps a base that a wall presses on from turning.
struct WallGrip {
  double friction = 0.0;  ///< of the wall
  double lever = 0.0;     ///< [m] the moment that holds the heading, over the push
  bool slides = false;    ///< no wheel holds the base sideways: it slides along the wall
};
/// The yaw [rad] at which the outline comes to rest against a wall across x. The base is pushed to the wall
/// from `yaw`, and turns about the outline's origin. No value: the base turns by more than 90 deg first.
ZWANG_EXPORT std::optional<double> resting_yaw(const std::vector<Eigen::Vector2d>& outline, double yaw,
                                               const WallGrip& grip = {});
/// A base that rests as much askew is round ahead: no wall squares it up. The shipped task promises 0.1 deg,
/// and an outline drawn around the shapes of a URDF is a few millimetres off. [rad]
inline constexpr double round_ahead = 2.0 * std::numbers::pi / 180.0;

/// The yaw [rad] from which a wall squares the base up: the largest of 20, 15, 10 and 5 deg from which its
/// outline comes to rest square. No value: it does from none.
ZWANG_EXPORT std::optional<double> start_askew(const BaseFit& fit);

/// Why this base cannot do `task`; empty: it can, as far as is known.
ZWANG_EXPORT std::string why_unfit(const std::string& task, const BaseFit& fit);

/// The texts of a task file and of its scene.
struct TaskTexts {
  std::string task, scene;
};

/// `shipped`: the task `task` and the scene of a corridor. The task names its files as given.
ZWANG_EXPORT TaskTexts draft_task(const std::string& task, const TaskTexts& shipped, const BaseFit& fit,
                                  const std::string& robot_file, const std::string& scene_file);

}  // namespace zwang::lang
