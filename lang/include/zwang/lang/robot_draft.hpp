/// A robot file's first draft, from a URDF: the wheels found, and what nobody but the owner can know.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::lang {

/// A wheel that the draft has found.
struct DraftWheel {
  std::string joint;
  std::string link;
  std::array<double, 3> at{};      ///< [m] in the base
  Eigen::Vector2d axle{0.0, 1.0};  ///< direction in the base, from above
  std::optional<double> radius;    ///< [m] of the link's largest cylinder or sphere
  std::string mesh;                ///< wheels that share one have one radius
  std::optional<double> effort;    ///< [N m] of the URDF's limit
  std::string swivel;              ///< the joint that steers it; empty: fixed to the base
  double trail = 0.0;              ///< [m] of its axle behind the swivel's axis
};

/// A joint that is called a wheel and cannot be one.
struct StuckWheel {
  std::string joint;
  std::string how;  ///< "`fixed`", for example
};

/// In the place of an `<axis>` that a URDF lacks.
struct JointAxis {
  std::string joint;
  solver::Vector3 axis;  ///< a unit vector in the frame of the joint
};

/// The draft with its open places filled by assumption, to be looked at and not to be run.
struct AssumedRobot {
  std::string as;  ///< "differential", "skid steering", "mecanum", ...
  Robot robot;
};

/// The facts that a URDF gives about a robot, and the text of its robot file.
struct RobotDraft {
  std::string name;
  std::string base;
  std::string drive;  ///< what the wheels look like, in words
  double mass = 0.0;  ///< [kg] of all links
  std::vector<DraftWheel> wheels;
  std::vector<DraftWheel> idle;               ///< wheels without a motor that hold the base
  std::vector<DraftWheel> casters;            ///< wheels on swivels, and no motor of either
  std::vector<std::string> supports;          ///< links
  std::vector<StuckWheel> stuck;              ///< called wheels, and none of the above
  std::vector<std::string> missing;           ///< what could not be known, a line each
  std::vector<AssumedRobot> assumed;          ///< one for each kind of wheel that it may have; empty where no
                                              ///< assumption makes a model of it
  std::vector<std::string> assumption_notes;  ///< what was assumed, a line each
  /// [m] Corners in the base, counter-clockwise; of the wheels alone where the URDF does not tell it.
  std::vector<Eigen::Vector2d> outline;
  bool outline_is_known = false;
  double heading = 0.0;    ///< [rad] of what the tasks call `base`, where its x is not ahead
  std::string base_ahead;  ///< the frame that is turned so; empty: the base itself
  /// [m] From the base's origin to the farthest point of an arm beyond the outline; 0: none is.
  double arm_reach = 0.0;
  bool has_own_base = false;  ///< the URDF calls a link `base` that is not the base
  std::string text;           ///< the robot file; `FILL_IN` stands where it is refused until filled
};

inline constexpr const char* fill_in = "FILL_IN";

/// Facts that the owner of the robot gives beforehand.
struct DraftOptions {
  bool with_hook =
      false;  ///< the frame `hook` is in the draft, to be filled in where nobody knows the outline
  std::optional<double> back;        ///< x of the outline's back in the base [m], where the owner measured it
  std::vector<std::string> ignored;  ///< links that are left out
  std::vector<std::string> turning;  ///< joints that turn without end, though the URDF holds them
  std::vector<JointAxis> axes;       ///< that the owner gave
};

/// `named_as` is how the robot file names the URDF, relative to itself. nullopt on a URDF that is refused.
ZWANG_EXPORT std::optional<RobotDraft> draft_robot(const std::filesystem::path& urdf,
                                                   const std::string& named_as, Diagnostics& diagnostics,
                                                   const DraftOptions& options = {});

}  // namespace zwang::lang
