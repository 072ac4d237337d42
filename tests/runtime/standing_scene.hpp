/// A robot that stands in a scene, and what it senses.
#pragma once

#include <cmath>
#include <string>

#include "constants.hpp"
#include "scene_program.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime::test {

inline const char* const task_text = R"(zwang: 1
robot: robots/mecanum_base.yaml
signals:
  partner: {type: pose, in: hook, stale_after: 1 s}
  near: {type: number, unit: m, stale_after: 1 s}
  latch: {type: bool, stale_after: 1 s}
  loaded: {type: bool, stale_after: 1 s}
  felt: {type: number, unit: N, stale_after: 1 s}
start: stand
tasks:
  stand:
    constraints:
      stand: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits:
      - {when: elapsed > 1 s, goto: done}
)";

inline lang::Program program_with(const std::string& scene) {
  return zwang::test::program_in_scene(task_text, scene);
}

/// Steps the plant without torque, or with `tau`, and calls `look` with each sample.
template <typename Look>
inline void follow(ScenePlant& plant, const lang::Program& program, double seconds,
                   const Eigen::VectorXd& tau, const Look& look) {
  Sensed sensed(program.robot.model, program.signals.size());
  const int ticks = static_cast<int>(std::lround(seconds / period));
  for (int i = 0; i < ticks; ++i) {
    const PlantStatus status = plant.sense(sensed);
    look(sensed, status);
    if (plant.apply(tau) != PlantStatus::ok) return;
  }
}

inline const Eigen::VectorXd idle = Eigen::VectorXd::Zero(4);

inline const char* const cart = R"(objects:
  cart:
    box: [0.6 m, 0.4 m, 0.5 m]
    at: [-2 m, 0.3 m]
    motion: [{time: 0.5 s, at: [-2 m, 0.3 m]}, {time: 1.5 s, at: [-3 m, 0.8 m], yaw: 90 deg}]
)";

}  // namespace zwang::runtime::test
