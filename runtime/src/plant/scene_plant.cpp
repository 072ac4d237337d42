#include "zwang/runtime/scene_plant.hpp"

#include <Eigen/Geometry>
#include <stdexcept>

#include "injected_faults.hpp"
#include "scene_signals.hpp"

namespace zwang::runtime {

using lang::FaultKind;

namespace {

std::vector<lang::Fault> all_faults(const lang::Scene& scene, const std::vector<lang::Fault>& more) {
  std::vector<lang::Fault> faults = scene.faults;
  faults.insert(faults.end(), more.begin(), more.end());
  return faults;
}

const lang::Scene& scene_of(const lang::Program& program) {
  if (!program.scene) throw std::invalid_argument("plant: the program has no scene");
  return *program.scene;
}

}  // namespace

struct ScenePlant::Parts {
  Parts(const lang::Program& program, const ScenePlantOptions& options)
      : scene(scene_of(program)),
        simulation(program.robot, scene, options.simulation),
        signals(program, options.seed),
        faults(all_faults(scene, options.faults), program.robot.model),
        noise(options.seed ^ 0xD1B54A32D192ED03U),
        actual(program.robot.model),
        torque(Eigen::VectorXd::Zero(program.robot.model.joint_count())) {}

  /// Floor, payload and the simulation itself.
  void change_world(double time) noexcept {
    const lang::Fault* slip = faults.find(FaultKind::floor_friction, time);
    const double friction = slip != nullptr ? slip->value : scene.floor_friction;
    if (friction != present_friction) simulation.set_floor_friction(friction);
    present_friction = friction;
    const lang::Fault* payload = faults.find(FaultKind::payload, time);
    const double mass = payload != nullptr ? payload->value : 0.0;
    if (mass != present_payload) simulation.set_payload(mass);
    present_payload = mass;
    if (faults.active(FaultKind::plant_diverges, time)) simulation.diverge();
  }

  void add_noise(solver::State& state) noexcept {
    const lang::StateNoise& n = scene.state;
    if (n.position > 0.0) {
      state.base_pose.position.x() += n.position * noise.normal();
      state.base_pose.position.y() += n.position * noise.normal();
    }
    if (n.yaw > 0.0) {
      state.base_pose.rotation =
          Eigen::AngleAxisd(n.yaw * noise.normal(), solver::Vector3::UnitZ()) * state.base_pose.rotation;
    }
    if (n.velocity > 0.0) {
      state.base_twist.linear.x() += n.velocity * noise.normal();
      state.base_twist.linear.y() += n.velocity * noise.normal();
    }
    if (n.turn > 0.0) state.base_twist.angular.z() += n.turn * noise.normal();
  }

  lang::Scene scene;
  MujocoPlant simulation;
  SceneSignals signals;
  InjectedFaults faults;
  Noise noise;
  Sensed actual;
  Eigen::VectorXd torque;  ///< what the motors make of the command
  solver::Pose start;      ///< of the base
  double present_friction = scene.floor_friction;
  double present_payload = 0.0;
};

ScenePlant::ScenePlant(const lang::Program& program, const ScenePlantOptions& options)
    : parts_(std::make_unique<Parts>(program, options)) {
  static_cast<void>(parts_->simulation.sense(parts_->actual));
  parts_->start = parts_->actual.state.base_pose;
}

ScenePlant::~ScenePlant() = default;

PlantStatus ScenePlant::sense(Sensed& sensed) noexcept {
  Parts& p = *parts_;
  const PlantStatus status = p.simulation.sense(p.actual);
  if (status != PlantStatus::ok) return status;
  if (sensed.state.q.size() != p.actual.state.q.size()) return PlantStatus::unreachable;
  p.signals.measure(p.simulation.truth(), p.actual.state);
  if (p.faults.active(FaultKind::samples_lost, p.actual.time)) return PlantStatus::unreachable;
  sensed.time = p.actual.time;
  sensed.state = p.actual.state;
  sensed.base_measured = !p.scene.state.wheels_only;
  if (sensed.base_measured) {
    p.add_noise(sensed.state);
  } else {
    sensed.state.base_pose = p.start;
    sensed.state.base_twist = {};
  }
  p.signals.report(sensed.time, sensed.signals);
  p.faults.spoil(sensed);
  return PlantStatus::ok;
}

PlantStatus ScenePlant::apply(const Eigen::VectorXd& tau) noexcept {
  Parts& p = *parts_;
  const double time = p.simulation.truth().time;
  if (tau.size() != p.torque.size()) return PlantStatus::unreachable;
  p.torque = tau;
  p.faults.spoil(p.torque, time);
  p.change_world(time);
  return p.simulation.apply(p.torque);
}

const Truth& ScenePlant::truth() const noexcept {
  return parts_->simulation.truth();
}

const solver::State& ScenePlant::true_state() const noexcept {
  return parts_->actual.state;
}

}  // namespace zwang::runtime
