#include "robot_senses.hpp"

#include <Eigen/Geometry>

namespace zwang::runtime {

namespace {

const lang::SceneRobot& partner(const lang::Scene& scene, int number) {
  return scene.robots[static_cast<std::size_t>(number - 1)];
}

std::vector<std::vector<solver::Vector3>> footprints_of(const lang::Scene& scene, const lang::Robot& first) {
  std::vector<std::vector<solver::Vector3>> footprints{first.footprint};
  for (const lang::SceneRobot& robot : scene.robots) footprints.push_back(robot.program->robot.footprint);
  return footprints;
}

/// Each robot has a chance of its own.
std::uint64_t seed_of(std::uint64_t seed, int number) {
  return seed + static_cast<std::uint64_t>(number) * 0x632BE59BD9B4E019U;
}

}  // namespace

RobotSenses::RobotSenses(const lang::Program& program, const lang::Scene& scene, int number,
                         const lang::Robot& first, std::uint64_t seed)
    : state_(number == 0 ? scene.state : partner(scene, number).state),
      signals_(program, scene, number == 0 ? scene.signals : partner(scene, number).signals,
               footprints_of(scene, first), seed_of(seed, number)),
      noise_(seed_of(seed, number) ^ 0xD1B54A32D192ED03U) {
  if (state_.fix) signals_.measure_base(*state_.fix, seed_of(seed, number) ^ 0xAEF17502108EF2D9U);
}

void RobotSenses::tell(const Sensed& actual, Sensed& sensed) noexcept {
  sensed.time = actual.time;
  sensed.state = actual.state;
  sensed.base_measured = !state_.wheels_only;
  if (sensed.base_measured) {
    add_noise(sensed.state);
  } else {
    sensed.state.base_pose = start_;
    sensed.state.base_twist = {};
    if (const auto fix = signals_.base_fix(sensed.time)) sensed.base_fix = fix;
  }
  signals_.report(sensed.time, sensed.signals);
}

void RobotSenses::add_noise(solver::State& state) noexcept {
  if (state_.position > 0.0) {
    state.base_pose.position.x() += state_.position * noise_.normal();
    state.base_pose.position.y() += state_.position * noise_.normal();
  }
  if (state_.yaw > 0.0) {
    state.base_pose.rotation =
        Eigen::AngleAxisd(state_.yaw * noise_.normal(), solver::Vector3::UnitZ()) * state.base_pose.rotation;
  }
  if (state_.velocity > 0.0) {
    state.base_twist.linear.x() += state_.velocity * noise_.normal();
    state.base_twist.linear.y() += state_.velocity * noise_.normal();
  }
  if (state_.turn > 0.0) state.base_twist.angular.z() += state_.turn * noise_.normal();
}

}  // namespace zwang::runtime
