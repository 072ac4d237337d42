/// The command to a drive that takes velocities, as columns of the log.
#pragma once

#include <array>
#include <string>

#include "zwang/runtime/command.hpp"
#include "zwang/solver/model.hpp"

namespace zwang::runtime {

struct CommandColumn {
  std::string name, unit;
};

inline std::array<CommandColumn, 3> command_columns(const solver::Joint& joint) {
  const bool slides = joint.type == solver::JointType::prismatic;
  const char* torque = slides ? "N" : "N m";
  return {CommandColumn{joint.name + ".qd_told", slides ? "m/s" : "rad/s"},
          CommandColumn{joint.name + ".tau_low", torque}, CommandColumn{joint.name + ".tau_high", torque}};
}

/// Of a drive that takes the base's twist, in the order of Command::twist.
inline constexpr std::array<std::array<const char*, 2>, 3> twist_columns{
    {{"base.vx_told", "m/s"}, {"base.vy_told", "m/s"}, {"base.wz_told", "rad/s"}}};

/// In the same order.
inline std::array<double, 3> command_values(const Command& command, Eigen::Index joint) noexcept {
  return {command.velocity(joint), command.lower(joint), command.upper(joint)};
}

}  // namespace zwang::runtime
