/// A robot file as its author wrote it, in SI.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "spec/task_file.hpp"
#include "spec/value.hpp"
#include "tree/read.hpp"
#include "zwang/lang/robot.hpp"

namespace zwang::lang {

struct WheelText {
  Word joint;
  std::optional<double> radius;  ///< [m]
  std::optional<double> roller;  ///< [rad]
  std::optional<double> drop;    ///< [m] that it stands lower than the URDF draws it
  bool holds_rolling = true;
  bool holds_sideways = true;
  bool gives_radius = false, gives_holds = false;  ///< the file has the keys
  Span span;
};

enum class WheelKind { plain, skid, mecanum };

/// Of every wheel with a motor that says nothing itself.
struct EachWheel {
  WheelKind kind = WheelKind::plain;
  std::optional<double> radius;  ///< [m]
  bool gives_radius = false;     ///< the file has the key
  std::optional<ValueText> effort;
  std::optional<double> gear;
  std::optional<double> rotor_inertia;  ///< [kg m^2]
  std::optional<double> mass;           ///< [kg] of one under `inertias` to which the URDF gives none
};

/// A body for a link, in the place of the URDF's.
struct InertiaText {
  Word link;
  std::optional<double> mass;    ///< [kg]; not given: the URDF's
  std::optional<double> radius;  ///< [m]; not given: the wheel's
  std::vector<double> at;        ///< [m] its centre of mass, in the link's axes; empty: the URDF's
  Span at_span{};
};

/// In the place of the URDF's <axis>.
struct JointAxisText {
  Word joint;
  solver::Vector3 axis;  ///< a unit vector in the frame of the joint
};

/// Of every motor that turns no wheel, where neither its own entry nor the URDF says it.
struct EachJoint {
  std::optional<ValueText> effort;  ///< of joints that turn, or of those that slide, as its dimension says
  std::optional<double> gear;
  std::optional<double> rotor_inertia;  ///< [kg m^2]
};

struct ActuatorText {
  Word joint;
  std::optional<ValueText> effort_text;  ///< a torque or a force, as the joint says
  std::optional<ValueText> slew_text;    ///< of the same, per second
  std::optional<double> gear;            ///< not given: 1
  std::optional<double> rotor_inertia;   ///< [kg m^2], the rotor's own; not given: 0
};

/// Where a joint stands at the start.
struct PostureText {
  Word joint;
  ValueText value;  ///< an angle or a length, as the joint says
};

struct FrictionText {
  Word joint;
  std::optional<ValueText> coulomb, presliding, viscous;  ///< of a force or a torque, as the joint says
  double compensate = 0.0;
};

/// The treatment of a <mimic> of the URDF.
struct MimicText {
  Word joint;  ///< that follows
  /// By a belt or a chain, which the floor keeps in step; else it moves by itself.
  bool is_coupled = false;
};

struct PadText {
  Word frame;
  double width = 0.0, height = 0.0;  ///< [m]
};

struct RobotFile {
  Word urdf;
  Word base;
  Word lead;  ///< the link or frame that tasks drive; not given: the base
  std::vector<WheelText> wheels;
  EachWheel each_wheel;
  EachJoint each_joint;
  std::vector<JointAxisText> axes;
  std::vector<InertiaText> inertias;
  std::vector<Word> fixed;    ///< joints that do not move, whatever the URDF says
  std::vector<Word> turning;  ///< joints that turn without end, whatever the URDF says
  std::vector<MimicText> mimics;
  std::vector<Word> ignored;  ///< links that are left out, with all that hangs on them
  std::vector<Word> supports;
  std::vector<ActuatorText> actuators;
  std::vector<PostureText> posture;
  std::vector<BaseLimit> limits;
  Stop stop;
  std::vector<FrictionText> friction;
  std::vector<solver::Vector3> footprint;
  Span footprint_span;
  std::optional<double> bumper_stiffness;
  std::optional<double> bumper_height;
  std::optional<double> control_period;
  std::optional<double> encoder_step;
  Drive drive;
  Span drive_span, feels_span;
  std::vector<PadText> pads;
  std::vector<FrameText> frames;
};

/// What messages call it.
std::string posture_name(const std::string& joint);

/// The shape of a robot file. nullopt when it is not one at all.
std::optional<RobotFile> parse_robot_file(const Document& document, Diagnostics& diagnostics);

}  // namespace zwang::lang
