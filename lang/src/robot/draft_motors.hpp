/// `each_joint` and `actuated` of a first robot file.
#pragma once

#include <string>
#include <vector>

#include "robot/draft_bodies.hpp"
#include "robot/urdf.hpp"
#include "robot/wheel_search.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

bool contains(const std::vector<std::string>& names, const std::string& name);

/// No URDF gives the torque of a wheel with a motor: it stands once, in `each_wheel`.
bool share_effort(const FoundWheels& found);

/// Empty where fewer than two joints that turn lack a torque. `held`: joints of `fixed`. `effort`: what
/// stands in the open place.
std::string each_joint_entry(const Urdf& urdf, const FoundWheels& found, const std::vector<std::string>& held,
                             const std::string& effort);

std::string actuated_entry(const Urdf& urdf, const FoundWheels& found, const std::vector<std::string>& held,
                           const std::vector<DraftBody>& bodies, const std::string& effort);

/// A slide whose motor, as the URDF has it, is weaker than what hangs on it.
struct SinkingSlide {
  std::string joint;
  double borne = 0.0, effort = 0.0;  ///< [N]
};

/// At the start of the assumed robot. A screw or a spring holds such a slide in truth.
std::vector<SinkingSlide> sinking_slides(const RobotDraft& draft, const Urdf& urdf);

}  // namespace zwang::lang
