/// A robot file as its author wrote it, in SI.
#pragma once

#include <optional>
#include <string>
#include <vector>

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
  double gear = 1.0;
  double rotor_inertia = 0.0;  ///< [kg m^2], the rotor's own
};

struct FrictionText {
  Word joint;
  JointFriction friction;
};

struct RobotFrameText {
  Word name;
  Word parent;
  std::vector<double> at;   ///< [m]
  std::vector<double> rpy;  ///< [rad]
};

struct RobotFile {
  Word urdf;
  Word base;
  std::vector<WheelText> wheels;
  std::vector<Word> supports;
  std::vector<ActuatorText> actuators;
  std::vector<BaseLimit> limits;
  Stop stop;
  std::vector<FrictionText> friction;
  std::vector<solver::Vector3> footprint;
  Span footprint_span;
  std::optional<double> bumper_stiffness;
  std::optional<double> bumper_height;
  std::vector<RobotFrameText> frames;
};

/// The shape of a robot file. nullopt when it is not one at all.
std::optional<RobotFile> parse_robot_file(const Document& document, Diagnostics& diagnostics);

}  // namespace zwang::lang
