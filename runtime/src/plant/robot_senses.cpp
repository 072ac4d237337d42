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
               footprints_of(scene, first), seed_of(seed, number), number),
      noise_(seed_of(seed, number) ^ 0xD1B54A32D192ED03U),
      drive_(program.robot.drive),
      last_sample_(program.robot.model),
      number_(number),
      effort_(Eigen::VectorXd::Zero(program.robot.model.joint_count())) {
  if (const auto frame = program.robot.model.find_frame(drive_.feels.frame))
    sensor_ = program.robot.model.frames()[static_cast<std::size_t>(*frame)].pose_in_body;
  last_sample_.time = -1.0;
  // A step of the simulation is no shorter than a quarter of a millisecond.
  const auto most_on_way = static_cast<std::size_t>(std::ceil(state_.delay / 0.25e-3)) + 2;
  if (state_.delay > 0.0) on_way_.assign(most_on_way, Sensed(program.robot.model));
  if (state_.fix) signals_.measure_base(*state_.fix, seed_of(seed, number) ^ 0xAEF17502108EF2D9U);
}

void RobotSenses::start_at(const Sensed& actual) {
  start_ = actual.state.base_pose;
  if (!drive_.takes_velocity) return;
  Sensed first = actual;
  if (drive_.feels.by == lang::Feels::By::wrench) first.contact_wrench.emplace();
  if (drive_.feels.by == lang::Feels::By::effort) first.effort = effort_;
  drive_line_.emplace(1.0 / drive_.rate, 0.5 * drive_.delay, first);
  last_sample_ = first;
  last_sample_.time = -1.0;
  for (Sensed& place : on_way_) place = first;
}

void RobotSenses::measure(const Truth& truth, const Eigen::VectorXd& torque, Sensed& actual) noexcept {
  signals_.measure(truth, actual.state);
  feel(truth, torque, actual);
}

void RobotSenses::feel(const Truth& truth, const Eigen::VectorXd& torque, Sensed& actual) noexcept {
  const lang::Feels& feels = drive_.feels;
  const double since = truth.time - felt_at_;
  const double part = feels.filter > 0.0 ? -std::expm1(-since / feels.filter) : 1.0;
  felt_at_ = truth.time;
  if (feels.by == lang::Feels::By::effort) {
    effort_ += part * (torque - effort_);
    actual.effort = effort_;
  } else if (feels.by == lang::Feels::By::wrench) {
    const BaseTruth& base =
        number_ == 0 ? truth.base : truth.robots[static_cast<std::size_t>(number_ - 1)].base;
    felt_ += part * (base.contact - felt_);
    const solver::Vector3 force(felt_.x(), felt_.y(), 0.0);
    const solver::Vector3 moment = solver::Vector3(0.0, 0.0, felt_.z()) - sensor_.position.cross(force);
    actual.contact_wrench =
        solver::ForceVector{sensor_.rotation.transpose() * moment, sensor_.rotation.transpose() * force};
  }
}

const Sensed& RobotSenses::arrived(const Sensed& actual) noexcept {
  if (on_way_.empty()) return actual;
  Sensed& place = on_way_[(oldest_ + waiting_) % on_way_.size()];
  place.time = actual.time;
  place.state = actual.state;
  place.contact_wrench = actual.contact_wrench;
  place.effort = actual.effort;
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
    add_felt_noise(last_sample_);
  }
  sensed.state = last_sample_.state;
  sensed.contact_wrench = last_sample_.contact_wrench;
  sensed.effort = last_sample_.effort;
  sensed.measured_at = last_sample_.time;
}

void RobotSenses::add_felt_noise(Sensed& sample) noexcept {
  const lang::Feels& feels = drive_.feels;
  if (sample.contact_wrench && feels.noise > 0.0) {
    for (int k = 0; k < 3; ++k) sample.contact_wrench->linear(k) += feels.noise * noise_.normal();
    for (int k = 0; k < 3; ++k)
      sample.contact_wrench->angular(k) += feels.noise * lang::Feels::moment_arm * noise_.normal();
  }
  for (Eigen::Index j = 0; j < sample.effort.size(); ++j) {
    double& effort = sample.effort(j);
    if (feels.noise > 0.0) effort += feels.noise * noise_.normal();
    if (feels.resolution > 0.0) effort = feels.resolution * std::round(effort / feels.resolution);
  }
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
