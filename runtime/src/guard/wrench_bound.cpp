#include "guard/wrench_bound.hpp"

#include <algorithm>
#include <cmath>

#include "zwang/solver/wheels.hpp"

namespace zwang::runtime {

namespace {

/// The frame hangs on the robot, not in the world or on what a signal sees.
bool is_on_robot(const lang::Program& program, int frame) {
  while (frame >= 0) {
    const lang::FrameDeclaration& f = program.frames[static_cast<std::size_t>(frame)];
    if (f.parent == lang::FrameParent::body) return true;
    if (f.parent != lang::FrameParent::frame) return false;
    frame = f.parent_index;
  }
  return false;
}

/// From the base's origin to where each body's joint is, at most. [m]
std::vector<double> distances(const solver::Model& model) {
  std::vector<double> all;
  for (const solver::Body& body : model.bodies()) {
    const double before = all.empty() ? 0.0 : all[static_cast<std::size_t>(body.parent)];
    all.push_back(all.empty() ? 0.0 : before + body.pose_in_parent.position.norm());
  }
  return all;
}

}  // namespace

WrenchBound::WrenchBound(const lang::Program& program, double period, int longest)
    : longest_(longest), keep_(std::exp(-period / memory)) {
  const lang::Robot& robot = program.robot;
  const solver::Model& model = robot.model;
  root_mass_ = std::sqrt(model.total_mass());
  steady_ = model.total_mass() * std::abs(model.gravity().z());
  for (const solver::Wheel& wheel : model.wheels()) {
    const solver::Joint& joint = model.joint(wheel.body - 1);
    if (joint.actuated) steady_ += joint.max_effort / wheel.radius;
  }
  const std::vector<double> reach = distances(model);
  for (const solver::Vector3& corner : robot.footprint) lever_ = std::max(lever_, corner.norm());
  lever_ = std::max(lever_, *std::max_element(reach.begin(), reach.end()));
  for (int j = 0; j < model.joint_count(); ++j) {
    if (solver::carries_wheel(model, j + 1)) continue;
    const solver::Joint& joint = model.joint(j);
    const bool slides = joint.type == solver::JointType::prismatic;
    joints_.push_back({j, slides ? 1.0 : lever_});
    if (slides && joint.actuated) steady_ += joint.max_effort;
  }
  for (const lang::Signal& signal : program.signals) {
    is_wrench_.push_back(signal.type == lang::SignalType::wrench);
    signal_on_robot_.push_back(is_on_robot(program, signal.in));
  }
}

double WrenchBound::force() const noexcept {
  return steady_ + hit * speed_ * std::sqrt(stiffness) * root_mass_;
}

double WrenchBound::moment() const noexcept {
  return force() * lever_;
}

/// |v| + |w| R + sum |qd| R: no point of the robot is faster.
void WrenchBound::follow(const solver::State& state) noexcept {
  double speed = state.base_twist.linear.norm() + state.base_twist.angular.norm() * lever_;
  for (const MovingJoint& moving : joints_) speed += std::abs(state.qd(moving.joint)) * moving.lever;
  speed_ = std::max(speed, keep_ * speed_);
}

/// The size of the wrench's impossible part, [N] or [N m]; 0 where it is possible.
double WrenchBound::excess(const solver::ForceVector& wrench, bool has_lever) const noexcept {
  const double size = wrench.linear.norm();
  if (!(size <= force())) return size;
  const double turn = wrench.angular.norm();
  return has_lever && !(turn <= moment()) ? turn : 0.0;
}

std::optional<Event> WrenchBound::look(solver::State& state, std::vector<SignalSample>& signals,
                                       double time) noexcept {
  follow(state);
  const auto joints = static_cast<int>(state.q.size());
  double largest = 0.0;
  int where = -1;
  const auto judge = [&](solver::ForceVector& wrench, bool has_lever, int signal) {
    const double refused = excess(wrench, has_lever);
    if (refused == 0.0) return;
    wrench = {};
    if (refused <= largest) return;
    largest = refused;
    where = signal;
  };
  for (std::size_t k = 0; k < state.f_ext.size(); ++k)
    judge(state.f_ext[k], true, event_signal::f_ext(joints, static_cast<int>(k)));
  for (std::size_t i = 0; i < std::min(signals.size(), is_wrench_.size()); ++i) {
    const solver::ForceVector& w = signals[i].wrench;
    if (is_wrench_[i] && signals[i].valid && w.linear.allFinite() && w.angular.allFinite())
      judge(signals[i].wrench, signal_on_robot_[i], event_signal::measured(joints, static_cast<int>(i)));
  }
  ticks_ = where < 0 ? 0 : ticks_ + 1;
  if (where < 0) return std::nullopt;
  const bool begins = !last_ || time - *last_ > pause;
  last_ = time;
  if (!begins && ticks_ != longest_) return std::nullopt;
  return Event{EventCode::wrench_impossible, time, where, largest};
}

}  // namespace zwang::runtime
