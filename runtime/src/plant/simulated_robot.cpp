#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "mjcf.hpp"
#include "outline.hpp"

namespace zwang::runtime {

using solver::Body;
using solver::Model;
using solver::Pose;
using solver::Vector3;

Pose pose_in_base(const Model& model, int body) {
  Pose pose;
  for (int i = body; i > 0; i = model.bodies()[static_cast<std::size_t>(i)].parent) {
    pose = model.bodies()[static_cast<std::size_t>(i)].pose_in_parent * pose;
  }
  return pose;
}

namespace {

constexpr double max_wheel_lift = 0.002;  ///< [m]

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("plant: " + what);
}

std::string in_millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", metres * 1e3);
  return text;
}

/// The ground as the wheels' lowest points have it, on the average; small differences are levelled out.
void level_wheels(const Model& model, SimulatedRobot& simulated) {
  std::vector<double> lowest;
  for (const solver::Wheel& wheel : model.wheels()) {
    if (!wheel.roller_angle && !wheel.holds_rolling) {
      refuse("a wheel that does not hold rolling cannot be simulated");
    }
    lowest.push_back(pose_in_base(model, wheel.body).position.z() - wheel.radius);
  }
  if (lowest.empty()) refuse("a base on the ground needs wheels");
  for (const double z : lowest) simulated.ground += z / static_cast<double>(lowest.size());
  for (const double z : lowest) simulated.wheel_lift.push_back(simulated.ground - z);
  const auto [low, high] = std::minmax_element(lowest.begin(), lowest.end());
  if (std::max(simulated.ground - *low, *high - simulated.ground) <= max_wheel_lift) return;
  const auto name = [&](std::vector<double>::const_iterator at) {
    const auto w = static_cast<std::size_t>(at - lowest.cbegin());
    return "`" + model.joint(model.wheels()[w].body - 1).name + "`";
  };
  refuse("the wheels do not stand on one level: " + name(high) + " ends " + in_millimetres(*high - *low) +
         " above " + name(low));
}

/// A support stands on the ground straight below its link's origin.
Vector3 point_below(const lang::Robot& robot, const std::string& support) {
  const auto frame = robot.model.find_frame(support);
  if (!frame) refuse("the model has no link `" + support + "` to support the base");
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
  if (real_rollers) {
    simulated.spheres.base = robot.model.bodies().front().inertia;
    for (const solver::Wheel& wheel : robot.model.wheels()) {
      simulated.rollers.push_back(wheel.roller_angle ? build_rollers(robot.model, wheel) : RollerWheel{});
    }
  } else {
    simulated.spheres = replace_wheels_by_spheres(robot.model);
  }
  simulated.outline = convex_hull(robot.footprint);
  if (robot.model.base_type() != solver::BaseType::ground) {
    simulated.wheel_lift.assign(robot.model.wheels().size(), 0.0);
    return simulated;
  }
  level_wheels(robot.model, simulated);
  for (const std::string& support : robot.supports) simulated.skids.push_back(point_below(robot, support));
  if (robot.supports.empty() && robot.model.wheels().size() < 3) {
    if (simulated.outline.empty()) refuse("a base on two wheels needs a footprint for its supports");
    simulated.skids = simulated.outline;
  }
  for (Vector3& skid : simulated.skids) skid.z() = simulated.ground;
  return simulated;
}

}  // namespace zwang::runtime
