#include "injected_faults.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace zwang::runtime {

using lang::Fault;
using lang::FaultKind;

namespace {

constexpr double clock_jump = 0.01;  ///< [s] backwards
constexpr double clock_ahead = 0.2;  ///< [s] more than any step that a guard may take
constexpr double tick_rounding = 1e-9;
constexpr double huge = 1e300;

}  // namespace

InjectedFaults::InjectedFaults(const std::vector<Fault>& of_scene, const std::vector<Fault>& of_run,
                               const solver::Model& model)
    : kept_(model) {
  const auto add = [&](const Fault& fault, bool is_of_run) {
    Injected injected;
    injected.of_run = is_of_run;
    if (!fault.joint.empty()) {
      const auto joint = model.find_joint(fault.joint);
      if (!joint) throw std::invalid_argument("fault: the robot has no joint `" + fault.joint + "`");
      injected.joint = *joint;
    }
    injected.fault = fault;
    injected.after = fault.at;
    if (!fault.of.empty()) injected.fault.at = std::numeric_limits<double>::infinity();
    faults_.push_back(std::move(injected));
  };
  for (const Fault& fault : of_scene) add(fault, false);
  for (const Fault& fault : of_run) add(fault, true);
}

bool InjectedFaults::waits() const noexcept {
  return std::ranges::any_of(faults_, [](const Injected& one) { return std::isinf(one.fault.at); });
}

void InjectedFaults::come(const std::string& of, double time) noexcept {
  for (Injected& one : faults_) {
    if (std::isinf(one.fault.at) && one.fault.of == of) one.fault.at = time + one.after;
  }
}

double InjectedFaults::onset_of_run() const noexcept {
  double first = std::numeric_limits<double>::infinity();
  for (const Injected& one : faults_) {
    if (one.of_run) first = std::min(first, one.fault.at);
  }
  return first;
}

std::vector<Fault> InjectedFaults::all() const {
  std::vector<Fault> all;
  for (const Injected& one : faults_) {
    if (!one.by_hand) all.push_back(one.fault);
  }
  return all;
}

void InjectedFaults::put(const Fault& fault, Eigen::Index joint) {
  faults_.insert(faults_.begin(), {.fault = fault, .joint = joint, .by_hand = true});
}

void InjectedFaults::lift(FaultKind kind, Eigen::Index joint) {
  std::erase_if(faults_, [&](const Injected& one) {
    return one.by_hand && one.fault.kind == kind && one.joint == joint;
  });
}

bool InjectedFaults::in_force(const Fault& fault, double time) noexcept {
  return time >= fault.at - tick_rounding && time < fault.at + fault.duration - tick_rounding;
}

const Fault* InjectedFaults::find(FaultKind kind, double time, Eigen::Index joint) const noexcept {
  const Fault* latest = nullptr;
  for (const Injected& injected : faults_) {
    const Fault& fault = injected.fault;
    if (fault.kind != kind || injected.joint != joint || !in_force(fault, time)) continue;
    if (latest == nullptr || fault.at >= latest->at) latest = &fault;
  }
  return latest;
}

bool InjectedFaults::active(FaultKind kind, double time) const noexcept {
  return find(kind, time) != nullptr;
}

bool InjectedFaults::object_leaves(const std::string& object, double time) noexcept {
  for (Injected& one : faults_) {
    const bool is_of_it = one.fault.kind == FaultKind::object_leaves && one.fault.object == object;
    if (is_of_it && in_force(one.fault, time) && !std::exchange(one.has_begun, true)) return true;
  }
  return false;
}

void InjectedFaults::spoil(Sensed& sensed) noexcept {
  const double time = sensed.time;
  const bool is_dead = active(FaultKind::samples_dead, time);
  if (is_dead || active(FaultKind::samples_frozen, time)) {
    if (!is_frozen_) kept_ = sensed.state;
    is_frozen_ = true;
    if (is_dead) {
      sensed.state.q = kept_.q;
      sensed.state.qd.setZero();
    } else {
      sensed.state = kept_;
    }
  } else {
    is_frozen_ = false;
  }
  double& spoilt = sensed.state.base_twist.linear.x();
  if (active(FaultKind::samples_nan, time)) spoilt = std::numeric_limits<double>::quiet_NaN();
  if (active(FaultKind::samples_inf, time)) spoilt = -std::numeric_limits<double>::infinity();
  if (active(FaultKind::samples_huge, time)) spoilt = huge;
  if (const Fault* fault = find(FaultKind::clock_backwards, time)) sensed.time = fault->at - clock_jump;
  if (active(FaultKind::clock_ahead, time)) sensed.time += clock_ahead;
}

void InjectedFaults::spoil(Eigen::VectorXd& tau, double time) noexcept {
  for (Injected& injected : faults_) {
    const FaultKind kind = injected.fault.kind;
    if (injected.joint < 0 || injected.joint >= tau.size() || !in_force(injected.fault, time)) continue;
    double& torque = tau(injected.joint);
    if (!injected.has_begun) injected.kept = torque;
    injected.has_begun = true;
    if (kind == FaultKind::torque_lost) torque = 0.0;
    if (kind == FaultKind::torque_stuck) torque = injected.kept;
    if (kind == FaultKind::torque_flipped) torque = -torque;
  }
}

}  // namespace zwang::runtime
