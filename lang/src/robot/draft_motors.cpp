#include "robot/draft_motors.hpp"

#include <algorithm>
#include <cmath>

#include "robot/draft_entries.hpp"
#include "zwang/lang/robot.hpp"
#include "zwang/solver/joint_loads.hpp"
#include "zwang/solver/wheels.hpp"

namespace zwang::lang {

namespace {

/// Joints that turn, are no wheels, and whose torque the URDF does not say, where there are several.
std::vector<std::string> joints_alike(const Urdf& urdf, const FoundWheels& found,
                                      const std::vector<std::string>& held) {
  std::vector<std::string> names;
  for (const auto* joints : {&found.steering, &found.others}) {
    for (const std::string& name : *joints) {
      const solver::Joint& joint = urdf.find_joint(name)->joint;
      const bool turns = joint.type != solver::JointType::prismatic;
      if (turns && !contains(held, name) && !std::isfinite(joint.max_effort)) names.push_back(name);
    }
  }
  return names.size() > 1 ? names : std::vector<std::string>{};
}

}  // namespace

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool share_effort(const FoundWheels& found) {
  return std::none_of(found.wheels.begin(), found.wheels.end(),
                      [](const DraftWheel& wheel) { return wheel.effort.has_value(); });
}

std::string each_joint_entry(const Urdf& urdf, const FoundWheels& found, const std::vector<std::string>& held,
                             const std::string& effort) {
  if (joints_alike(urdf, found, held).empty()) return "";
  return "\n# each_joint: of every motor that turns no wheel, where neither its own entry nor the URDF says "
         "it.\n# effort: the largest torque, as `2 N m`.\neach_joint: {effort: " +
         effort + "}\n";
}

std::string actuated_entry(const Urdf& urdf, const FoundWheels& found, const std::vector<std::string>& held,
                           const std::vector<DraftBody>& bodies, const std::string& effort) {
  std::string text = "actuated:\n";
  const std::vector<std::string> shared = joints_alike(urdf, found, held);
  const auto line = [&](const std::string& name, const std::string& open, std::string more = "") {
    const solver::Joint& joint = urdf.find_joint(name)->joint;
    const bool is_known = std::isfinite(joint.max_effort) || contains(shared, name);
    if (!is_known) more = "effort: " + open + (more.empty() ? "" : ", ") + more;
    text += "  " + name + ": {" + more + "}\n";
  };
  for (const DraftWheel& wheel : found.wheels) {
    if (share_effort(found)) {
      text += "  " + wheel.joint + ": {}\n";
    } else {
      line(wheel.joint, effort);
    }
  }
  for (const std::string& name : found.steering)
    line(name, effort, steering_rotor(urdf, found, bodies, name));
  for (const std::string& name : found.others) {
    if (contains(held, name)) continue;
    const bool slides = urdf.find_joint(name)->joint.type == solver::JointType::prismatic;
    line(name, effort == fill_in ? fill_in : slides ? "1 N" : "1 N m");
    if (slides && text.ends_with(std::string(fill_in) + "}\n"))
      text.insert(text.size() - 1, "  # it slides: the largest force, as `20 N`");
  }
  return text;
}

std::vector<SinkingSlide> sinking_slides(const RobotDraft& draft, const Urdf& urdf) {
  std::vector<SinkingSlide> slides;
  if (draft.assumed.empty()) return slides;
  const Robot& robot = draft.assumed.front().robot;
  solver::JointLoads loads(robot.model);
  loads.weigh(start_state(robot));
  for (const solver::JointLoads::Load& load : loads.all()) {
    const solver::Joint& joint = robot.model.joint(load.joint);
    const bool is_slide = joint.type == solver::JointType::prismatic;
    const bool is_known = std::isfinite(urdf.find_joint(joint.name)->joint.max_effort);
    if (!is_slide || !is_known || solver::carries_wheel(robot.model, load.joint + 1)) continue;
    if (std::abs(load.weight) > joint.max_effort)
      slides.push_back({joint.name, std::abs(load.weight), joint.max_effort});
  }
  return slides;
}

}  // namespace zwang::lang
