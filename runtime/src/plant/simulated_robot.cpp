#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mjcf.hpp"
#include "refuse.hpp"
#include "zwang/lang/footing.hpp"
#include "zwang/lang/plane.hpp"
#include "zwang/lang/wheel_level.hpp"

namespace zwang::runtime {

using solver::Body;
using solver::Model;
using solver::Vector3;

namespace {

std::string in_millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", metres * 1e3);
  return text;
}

/// The ground as the wheels' lowest points have it, on the average; small differences are levelled out.
void level_wheels(const Model& model, SimulatedRobot& simulated) {
  for (const solver::Wheel& wheel : model.wheels()) {
    if (wheel.held_directions() == 0) refuse("a wheel that holds no direction cannot be simulated");
  }
  if (model.wheels().empty()) refuse("a base on the ground needs wheels");
  const lang::WheelLevel level = lang::wheel_level(model);
  simulated.ground = level.mean;
  for (const double z : level.ends) simulated.wheel_lift.push_back(level.mean - z);
  if (level.is_level()) return;
  const auto name = [&](std::size_t w) { return "`" + model.joint(model.wheels()[w].body - 1).name + "`"; };
  refuse("the wheels do not stand on one level: " + name(level.highest) + " ends " +
         in_millimetres(level.spread()) + " above " + name(level.lowest));
}

/// A support stands on the ground straight below its frame.
Vector3 point_below(const lang::Robot& robot, const std::string& support) {
  const auto frame = robot.model.find_frame(support);
  if (!frame) refuse("the model has no frame `" + support + "` to support the base");
  const solver::Frame& link = robot.model.frames()[static_cast<std::size_t>(*frame)];
  if (link.body != 0) refuse("the support `" + support + "` is not fixed to the base");
  return link.pose_in_body.position;
}

/// Of each last link of an arm the frame that lies farthest out.
std::vector<solver::Frame> find_tips(const Model& model) {
  std::vector<solver::Frame> tips;
  for (int b = 1; b < model.body_count(); ++b) {
    const auto hangs_on_it = [b](const Body& body) { return body.parent == b; };
    const auto rolls = [b](const solver::Wheel& wheel) { return wheel.body == b; };
    if (!model.joint(b - 1).actuated ||
        std::any_of(model.bodies().begin() + 1, model.bodies().end(), hangs_on_it) ||
        std::any_of(model.wheels().begin(), model.wheels().end(), rolls))
      continue;
    const solver::Frame* farthest = nullptr;
    for (const solver::Frame& frame : model.frames()) {
      if (frame.body != b) continue;
      if (farthest == nullptr || frame.pose_in_body.position.norm() > farthest->pose_in_body.position.norm())
        farthest = &frame;
    }
    if (farthest != nullptr) tips.push_back(*farthest);
  }
  return tips;
}

/// A pad touches with its corners, in the place of its link's tip.
void spread_pads(const lang::Robot& robot, std::vector<solver::Frame>& tips) {
  std::vector<solver::Frame> corners;
  for (const lang::Pad& pad : robot.pads) {
    const auto number = robot.model.find_frame(pad.frame);
    if (!number) refuse("the robot has no frame `" + pad.frame + "` for a pad");
    solver::Frame corner = robot.model.frames()[static_cast<std::size_t>(*number)];
    std::erase_if(tips, [&corner](const solver::Frame& tip) { return tip.body == corner.body; });
    const solver::Pose middle = corner.pose_in_body;
    for (const double y : {-0.5 * pad.width, 0.5 * pad.width}) {
      for (const double z : {-0.5 * pad.height, 0.5 * pad.height}) {
        corner.pose_in_body.position = middle * Vector3(0.0, y, z);
        corners.push_back(corner);
      }
    }
  }
  tips.insert(tips.end(), corners.begin(), corners.end());
}

}  // namespace

const solver::Frame& hook_of(const Model& model, const lang::Dock& dock, const std::string& owner) {
  const auto frame = model.find_frame(dock.hook);
  if (!frame) refuse("the robot has no frame `" + dock.hook + "` to latch in `" + owner + "`");
  return model.frames()[static_cast<std::size_t>(*frame)];
}

SimulatedRobot prepare_robot(const lang::Robot& robot, bool real_rollers, int number) {
  SimulatedRobot simulated;
  simulated.robot = robot;
  if (number > 0) {
    simulated.prefix = "partner_";
    simulated.prefix += std::to_string(number) + "_";
  }
  simulated.tips = find_tips(robot.model);
  spread_pads(robot, simulated.tips);
  const auto spheres = real_rollers ? std::nullopt : replace_wheels_by_spheres(robot.model);
  simulated.spheres = spheres.value_or(SphereBase{{}, robot.model.bodies().front().inertia});
  for (const solver::Wheel& wheel : robot.model.wheels()) {
    if (!real_rollers) break;
    const auto built = wheel.roller_angle ? build_rollers(robot.model, wheel) : std::nullopt;
    simulated.rollers.push_back(built.value_or(RollerWheel{}));
  }
  simulated.outline = lang::plane::convex_hull(robot.footprint);
  if (robot.model.base_type() != solver::BaseType::ground) {
    simulated.wheel_lift.assign(robot.model.wheels().size(), 0.0);
    return simulated;
  }
  level_wheels(robot.model, simulated);
  // As high as an even body with this centre of mass.
  constexpr double least_body = 0.05;  // [m]
  const std::optional<lang::Footing> footing = lang::footing_of(robot);
  simulated.top = std::max(2.0 * (footing ? footing->height : 0.0), robot.bumper_height + least_body);
  for (const std::string& support : robot.supports) simulated.skids.push_back(point_below(robot, support));
  if (robot.supports.empty() && robot.model.wheels().size() < 3) {
    if (simulated.outline.empty()) refuse("a base on two wheels needs a footprint for its supports");
    simulated.skids = simulated.outline;
  }
  for (Vector3& skid : simulated.skids) skid.z() = simulated.ground;
  return simulated;
}

}  // namespace zwang::runtime
