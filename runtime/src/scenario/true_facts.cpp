#include "scenario/true_facts.hpp"

#include <cmath>
#include <limits>

namespace zwang::runtime {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

void put_object(const ObjectTruth& object, double* values) noexcept {
  values[lang::truth_force] = object.force;
  values[lang::truth_peak] = object.peak_force;
  values[lang::truth_touched] = object.touched.value_or(unknown);
  values[lang::truth_object_x] = object.x;
  values[lang::truth_object_y] = object.y;
  values[lang::truth_object_yaw] = object.yaw;
  values[lang::truth_latched] = object.latched.value_or(unknown);
  values[lang::truth_pull] = object.pull;
}

}  // namespace

TrueFacts::TrueFacts(const lang::Program& program)
    : program_(program),
      frames_(program.frames, program.robot.model, program.signals.size()),
      values_(lang::truth_names(program.scene.value_or(lang::Scene{})).size(), unknown) {
  for (std::size_t i = 0; i < program.frames.size(); ++i) frames_.follow(static_cast<int>(i));
}

void TrueFacts::update(const Truth& truth, const solver::State& state, double torque_share) noexcept {
  frames_.update(program_.robot.model, state);
  if (time_ == 0.0) frames_.start_paths();
  time_ = truth.time;
  values_[lang::truth_x] = truth.x;
  values_[lang::truth_y] = truth.y;
  values_[lang::truth_yaw] = truth.yaw;
  values_[lang::truth_vx] = truth.velocity.x();
  values_[lang::truth_vy] = truth.velocity.y();
  values_[lang::truth_speed] = truth.velocity.head<2>().norm();
  values_[lang::truth_turn] = truth.velocity.z();
  values_[lang::truth_torque] = torque_share;
  const std::size_t objects = truth.objects.size() - truth.robots.size();
  for (std::size_t k = 0; k < objects; ++k)
    put_object(truth.objects[k], values_.data() + lang::truth_base_count + k * lang::truth_object_count);
}

void TrueFacts::update_partner(std::size_t number, const Truth& truth, double torque_share) noexcept {
  double* values = of_partner(number);
  const RobotTruth& robot = truth.robots[number];
  put_object(truth.objects[truth.objects.size() - truth.robots.size() + number], values);
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

void TrueFacts::note_stop(double time) noexcept {
  values_[lang::run_stopped] = time;
}

void TrueFacts::note_slip(double time) noexcept {
  double& slipped = values_[lang::run_slipped];
  if (std::isnan(slipped)) slipped = time;
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
    case lang::Op::speed:
      return frames_.signal_of(node.index) >= 0 ? unknown : frames_.speed(node.index);
    case lang::Op::moved:
      return frames_.signal_of(node.index) >= 0 ? unknown : frames_.moved(node.index);
    default:
      return unknown;
  }
}

}  // namespace zwang::runtime
