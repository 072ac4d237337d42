#include "zwang/lang/configurations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "zwang/lang/program.hpp"

namespace zwang::lang {

namespace {

constexpr int general_count = 4;
constexpr double farthest = 3.0;  // [m]

/// In [0, 1), the same on every machine: the standard fixes the generator, not its distributions.
double uniform(std::mt19937& generator) {
  return static_cast<double>(generator()) / 4294967296.0;
}

bool is_wheel(const solver::Model& model, int joint) {
  return std::any_of(model.wheels().begin(), model.wheels().end(),
                     [&](const solver::Wheel& wheel) { return wheel.body == joint + 1; });
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

solver::State turned_alike(const solver::Model& model, const solver::State& start, double angle) {
  solver::State state = start;
  for (int j = 0; j < model.joint_count(); ++j) {
    if (is_wheel(model, j)) continue;
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
  bool has_other_joints = false;
  for (int j = 0; j < model.joint_count(); ++j) has_other_joints = has_other_joints || !is_wheel(model, j);
  if (!has_other_joints) return states;
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

}  // namespace zwang::lang
