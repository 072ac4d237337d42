#include "zwang/lang/configurations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "zwang/lang/program.hpp"
#include "zwang/solver/wheels.hpp"

namespace zwang::lang {

namespace {

constexpr int general_count = 4;
constexpr double farthest = 3.0;  // [m]

/// In [0, 1), the same on every machine: the standard fixes the generator, not its distributions.
double uniform(std::mt19937& generator) {
  return static_cast<double>(generator()) / 4294967296.0;
}

solver::State general_state(const solver::Model& model, std::mt19937& generator) {
  solver::State state(model);
  for (int j = 0; j < model.joint_count(); ++j) {
    const solver::Joint& joint = model.joint(j);
    const double low = std::isfinite(joint.lower) ? joint.lower : -std::numbers::pi;
    const double high = std::isfinite(joint.upper) ? joint.upper : std::numbers::pi;
    state.q(j) = low + (high - low) * uniform(generator);
  }
  if (!model.has_fixed_base()) {
    const double yaw = std::numbers::pi * (2.0 * uniform(generator) - 1.0);
    state.base_pose.rotation = solver::rotation_from_rpy(0.0, 0.0, yaw);
  }
  return state;
}

bool has_joints_beside_wheels(const solver::Model& model) {
  for (int j = 0; j < model.joint_count(); ++j) {
    if (!solver::turns_wheel(model, j + 1)) return true;
  }
  return false;
}

solver::State turned_alike(const solver::Model& model, const solver::State& start, double angle) {
  solver::State state = start;
  for (int j = 0; j < model.joint_count(); ++j) {
    if (solver::turns_wheel(model, j + 1)) continue;
    state.q(j) = std::clamp(start.q(j) + angle, model.joint(j).lower, model.joint(j).upper);
  }
  return state;
}

}  // namespace

std::vector<solver::State> general_states(const solver::Model& model) {
  std::mt19937 generator(20211);
  std::vector<solver::State> states;
  for (int i = 0; i < general_count; ++i) states.push_back(general_state(model, generator));
  if (model.has_fixed_base()) return states;
  for (solver::State& state : states) {
    state.base_pose.position.x() = farthest * (2.0 * uniform(generator) - 1.0);
    state.base_pose.position.y() = farthest * (2.0 * uniform(generator) - 1.0);
  }
  return states;
}

std::vector<solver::State> configurations(const Robot& robot, const std::optional<Scene>& scene) {
  const solver::Model& model = robot.model;
  std::vector<solver::State> states{start_state(robot, scene)};
  if (!has_joints_beside_wheels(model)) return states;
  for (const double part : {0.25, 0.5, 0.75}) {
    states.push_back(turned_alike(model, states.front(), part * std::numbers::pi));
  }
  std::vector<solver::State> general = general_states(model);
  general.pop_back();
  for (solver::State& state : general) {
    state.base_pose = states.front().base_pose;
    states.push_back(std::move(state));
  }
  return states;
}

std::string describe_configurations(const Robot& robot) {
  if (!has_joints_beside_wheels(robot.model)) return "the start pose alone: no joint but the wheels turns";
  return "the start pose, all joints but the wheels turned from there by 45, 90 and 135 deg, and three "
         "settings "
         "in no pattern";
}

solver::AxisAnalysis usable(solver::AxisAnalysis axis) {
  constexpr double held_below = 1e-3;  // of the axis
  if (axis.kappa < held_below) {
    axis.effective_mass = solver::infinity;
    axis.reachable = false;
  }
  axis.reachable = axis.reachable && axis.largest_force > 0.0;
  return axis;
}

}  // namespace zwang::lang
