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
  bool holds_rolling = true;
  bool holds_sideways = true;
  Span span;
};

struct ActuatorText {
  Word joint;
  std::optional<ValueText> effort_text;  ///< a torque or a force, as the joint says
  std::optional<ValueText> slew_text;    ///< of the same, per second
  double gear = 1.0;
  double rotor_inertia = 0.0;  ///< [kg m^2], the rotor's own
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

struct RobotFile {
  Word urdf;
  Word base;
  Word lead;  ///< the link or frame that tasks drive; not given: the base
  std::vector<WheelText> wheels;
  std::vector<Word> fixed;    ///< joints that do not move, whatever the URDF says
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
  Span drive_span;
  std::vector<FrameText> frames;
};

/// What messages call it.
std::string posture_name(const std::string& joint);

/// The shape of a robot file. nullopt when it is not one at all.
std::optional<RobotFile> parse_robot_file(const Document& document, Diagnostics& diagnostics);

}  // namespace zwang::lang
