#include "scenario/true_facts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "zwang/lang/condition_function.hpp"

namespace zwang::runtime {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TrueFacts::TrueFacts(const lang::Program& program)
    : program_(program),
      frames_(program.frames, program.robot.model, program.signals.size()),
      values_(lang::truth_names(program).size(), unknown),
      onset_(std::numeric_limits<double>::infinity()) {
  values_[lang::truth_switch] = 0.0;
  if (program.scene) steady_.resize(program.scene->objects.size() + program.scene->robots.size());
  for (const lang::Region& region : program.regions) regions_.emplace_back(region, program.robot.footprint);
  entries_.resize(program.tasks.size());
}

void TrueFacts::follow(const lang::Condition& condition) {
  for (const lang::ExpressionNode& node : condition.nodes) {
    if (node.op == lang::Op::of_frame) frames_.follow(node);
  }
}

void TrueFacts::update(const Truth& truth, const solver::State& state, double torque_share) noexcept {
  frames_.update(program_.robot.model, state, truth.time - time_);
  if (time_ == 0.0) frames_.start_sums();
  time_ = truth.time;
  values_[lang::truth_x] = truth.x;
  values_[lang::truth_y] = truth.y;
  values_[lang::truth_yaw] = truth.yaw;
  values_[lang::truth_vx] = truth.velocity.x();
  values_[lang::truth_vy] = truth.velocity.y();
  values_[lang::truth_speed] = truth.velocity.head<2>().norm();
  values_[lang::truth_turn] = truth.velocity.z();
  values_[lang::truth_torque] = torque_share;
  values_[lang::truth_roll] = truth.base.roll;
  values_[lang::truth_pitch] = truth.base.pitch;
  values_[lang::truth_acceleration] = truth.base.acceleration;
  values_[lang::truth_push] = truth.base.push;
  values_[lang::truth_slip] = truth.base.slip;
  values_[lang::truth_hand] = truth.base.hand;
  values_[lang::truth_mass] = truth.base.mass;
  look_at_fault(truth);
  const std::size_t objects = truth.objects.size() - truth.robots.size();
  for (std::size_t k = 0; k < objects; ++k)
    put_object(k, truth, values_.data() + lang::truth_base_count + k * lang::truth_object_count);
  put_travels_and_wrenches(truth);
  look_at_regions();
}

void TrueFacts::look_at_fault(const Truth& truth) noexcept {
  if (truth.time >= onset_) {
    values_[lang::run_fault] = onset_;
  } else {
    x_ = truth.x;
    y_ = truth.y;
  }
  values_[lang::truth_drift] = std::hypot(truth.x - x_, truth.y - y_);
}

void TrueFacts::put_travels_and_wrenches(const Truth& truth) noexcept {
  if (!program_.scene) return;
  double* value = of_partner(truth.robots.size());
  for (std::size_t k = 0; k < program_.scene->objects.size(); ++k) {
    if (program_.scene->objects[k].guide) *value++ = truth.objects[k].travel;
  }
  for (std::size_t i = 0; i < program_.scene->signals.size(); ++i) {
    if (program_.scene->signals[i].kind != lang::SceneSignalKind::wrench) continue;
    const solver::ForceVector& felt = truth.wrenches[0][i];
    value = std::copy(felt.linear.data(), felt.linear.data() + 3, value);
    value = std::copy(felt.angular.data(), felt.angular.data() + 3, value);
  }
}

void TrueFacts::put_object(std::size_t number, const Truth& truth, double* values) noexcept {
  const ObjectTruth& object = truth.objects[number];
  steady_[number].look(object.force - object.pull, object.force > 0.0 || object.latched, truth.velocity,
                       truth.time);
  values[lang::truth_force] = object.force;
  values[lang::truth_peak] = object.peak_force;
  values[lang::truth_steady] = steady_[number].now().value_or(unknown);
  values[lang::truth_touched] = object.touched.value_or(unknown);
  values[lang::truth_object_x] = object.x;
  values[lang::truth_object_y] = object.y;
  values[lang::truth_object_yaw] = object.yaw;
  values[lang::truth_latched] = object.latched.value_or(unknown);
  values[lang::truth_pull] = object.pull;
  values[lang::truth_object_hand] = object.hand;
  const lang::Scene& scene = *program_.scene;
  values[lang::truth_stiffness] = number < scene.objects.size()
                                      ? scene.objects[number].stiffness
                                      : scene.robots[number - scene.objects.size()].stiffness;
}

void TrueFacts::look_at_regions() noexcept {
  if (program_.robot.footprint.empty()) return;
  const solver::FrameMotion base = frames_.motions().of(0);
  double* values = values_.data() + values_.size() - program_.tasks.size() - regions_.size();
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    const int parent = program_.regions[r].parent;
    if (frames_.signal_of(parent) >= 0) continue;
    RegionFence& fence = regions_[r];
    fence.update(base, frames_.motions().of(frames_.attached(parent)), 0.0);
    double least = std::numeric_limits<double>::infinity();
    fence.find_facing(least, least);
    for (const std::size_t pair : fence.facing()) least = std::min(least, fence.approach(pair).left);
    values[r] = least;
  }
}

void TrueFacts::update_partner(std::size_t number, const Truth& truth, double torque_share) noexcept {
  double* values = of_partner(number);
  const RobotTruth& robot = truth.robots[number];
  put_object(truth.objects.size() - truth.robots.size() + number, truth, values);
  values[lang::truth_robot_speed] = robot.velocity.head<2>().norm();
  values[lang::truth_robot_turn] = robot.velocity.z();
  values[lang::truth_robot_torque] = torque_share;
}

double* TrueFacts::of_partner(std::size_t number) noexcept {
  const std::size_t objects = program_.scene->objects.size();
  return values_.data() + lang::truth_base_count + objects * lang::truth_object_count +
         number * lang::truth_robot_count;
}

void TrueFacts::note_partner_stop(std::size_t number, double time) noexcept {
  of_partner(number)[lang::truth_robot_stopped] = time;
}

/// They stand before the regions and the tasks.
void TrueFacts::note_outputs(std::span<const double> outputs) noexcept {
  std::ranges::copy(outputs, values_.end() - static_cast<std::ptrdiff_t>(program_.tasks.size() +
                                                                         regions_.size() + outputs.size()));
}

void TrueFacts::note_pose(const solver::State& estimated, const solver::State& state) noexcept {
  const auto place = [](const solver::Pose& base, const solver::Vector3& point) -> Eigen::Vector2d {
    return (base.position + base.rotation * point).head<2>();
  };
  const auto off = [&](const solver::Vector3& point) {
    return (place(state.base_pose, point) - place(estimated.base_pose, point)).norm();
  };
  double most = off(solver::Vector3::Zero());
  for (const solver::Vector3& corner : program_.robot.footprint) most = std::max(most, off(corner));
  values_[lang::truth_astray] = most;
}

void TrueFacts::note_stop(double time) noexcept {
  values_[lang::run_stopped] = time;
  values_[lang::run_done] = unknown;
}

void TrueFacts::note_slip(double time) noexcept {
  double& slipped = values_[lang::run_slipped];
  if (std::isnan(slipped)) slipped = time;
}

void TrueFacts::note_torque(const Eigen::VectorXd& tau, bool is_switch) noexcept {
  double& most = values_[lang::truth_switch];
  if ((is_switch || was_switch_) && last_torque_)
    most = std::max(most, (tau - *last_torque_).cwiseAbs().maxCoeff());
  last_torque_ = tau;
  was_switch_ = is_switch;
}

void TrueFacts::note_entry(int task, double time) noexcept {
  TaskEntries& of = entries_[static_cast<std::size_t>(task)];
  ++of.count;
  of.last = time;
  double& entered = values_[values_.size() - program_.tasks.size() + static_cast<std::size_t>(task)];
  if (std::isnan(entered)) entered = time;
}

double TrueFacts::look_up(const lang::ExpressionNode& node) const noexcept {
  const auto index = static_cast<std::size_t>(node.index);
  switch (node.op) {
    case lang::Op::parameter:
      return program_.parameters[index].value;
    case lang::Op::elapsed:
      return time_;
    case lang::Op::signal:
      return values_[index];
    case lang::Op::of_frame:
      return frames_.signal_of(node.index) >= 0 ? unknown : frames_.measured(node);
    case lang::Op::of_task: {
      const TaskEntries& of = entries_[index];
      lang::TaskEntries entries{of.count, std::nullopt};
      if (of.count > 0) entries.since_last = time_ - of.last;
      return lang::function_of(node).count(entries);
    }
    default:
      return unknown;
  }
}

}  // namespace zwang::runtime
