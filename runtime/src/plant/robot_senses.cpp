#include "robot_senses.hpp"

#include <Eigen/Geometry>
#include <cmath>

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
      noise_(seed_of(seed, number) ^ 0xD1B54A32D192ED03U),
      drive_(program.robot.drive),
      last_sample_(program.robot.model) {
  last_sample_.time = -1.0;
  // A step of the simulation is no shorter than a quarter of a millisecond.
  const auto most_on_way = static_cast<std::size_t>(std::ceil(state_.delay / 0.25e-3)) + 2;
  if (state_.delay > 0.0) on_way_.assign(most_on_way, Sensed(program.robot.model));
  if (state_.fix) signals_.measure_base(*state_.fix, seed_of(seed, number) ^ 0xAEF17502108EF2D9U);
}

void RobotSenses::start_at(const Sensed& actual) {
  start_ = actual.state.base_pose;
  if (drive_.takes_velocity) drive_line_.emplace(1.0 / drive_.rate, 0.5 * drive_.delay, actual);
}

const Sensed& RobotSenses::arrived(const Sensed& actual) noexcept {
  if (on_way_.empty()) return actual;
  Sensed& place = on_way_[(oldest_ + waiting_) % on_way_.size()];
  place.time = actual.time;
  place.state = actual.state;
  if (waiting_ + 1 < on_way_.size()) ++waiting_;
  constexpr double rounding = 1e-9;  // [s]
  const auto next_is_there = [&] {
    return on_way_[(oldest_ + 1) % on_way_.size()].time <= actual.time - state_.delay + rounding;
  };
  while (waiting_ > 1 && next_is_there()) {
    oldest_ = (oldest_ + 1) % on_way_.size();
    --waiting_;
  }
  return on_way_[oldest_];
}

void RobotSenses::tell(const Sensed& now, Sensed& sensed) noexcept {
  const Sensed& actual = arrived(now);
  sensed.time = actual.time;
  sensed.base_measured = !state_.wheels_only;
  if (drive_line_) {
    tell_last_sample(actual, sensed);
  } else {
    sensed.state = actual.state;
    if (sensed.base_measured) add_noise(sensed.state);
  }
  if (!sensed.base_measured) {
    sensed.state.base_pose = start_;
    sensed.state.base_twist = {};
    if (const auto fix = signals_.base_fix(sensed.time)) sensed.base_fix = fix;
  }
  signals_.report(sensed.time, sensed.signals);
}

void RobotSenses::tell_last_sample(const Sensed& actual, Sensed& sensed) noexcept {
  const Sensed& sample = drive_line_->pass(actual, actual.time);
  if (sample.time != last_sample_.time) {
    last_sample_ = sample;
    if (sensed.base_measured) add_noise(last_sample_.state);
  }
  sensed.state = last_sample_.state;
  sensed.measured_at = last_sample_.time;
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
