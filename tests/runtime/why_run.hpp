/// A run in a scene, to its end, and the reason that it gives.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene_program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"
#include "zwang/runtime/why.hpp"

namespace zwang::runtime::test {

inline const char* const open_floor = "start: {at: [0 m, 0 m]}\nfloor: {friction: 0.9}\n";

/// A wall square before the base, its face `ahead` of the base's origin [m].
inline std::string wall(const std::string& ahead, const std::string& more = "fixed: true") {
  return std::string(open_floor) + "objects:\n  door: {box: [0.1 m, 3 m, 1 m], at: [" + ahead +
         ", 0 m], stiffness: 100 kN/m, damping: 0.3, " + more + "}\n";
}

struct Ended {
  RunState state = RunState::running;
  std::optional<Why> why;
  std::string sentence() const { return why ? why->sentence : ""; }
};

/// `body` without its first two lines. Runs until it is over, or for so long.
inline Ended run(const std::string& body, const std::string& scene, double longest = 20.0) {
  const std::string task = "zwang: 1\nrobot: robots/mecanum_base.yaml\n" + body;
  const lang::Program program = zwang::test::program_in_scene(task.c_str(), scene);
  ScenePlant plant(program, {});
  Runner runner(program);
  Sensed sensed(program);
  while (!runner.finished() && plant.truth().time < longest) {
    plant.sense(sensed);
    if (plant.apply(runner.step(sensed)) != PlantStatus::ok) break;
  }
  return {runner.state(), runner.why()};
}

inline void expect_words(const Ended& ended, const std::vector<std::string>& words) {
  for (const std::string& one : words)
    EXPECT_NE(ended.sentence().find(one), std::string::npos) << one << "\nis not in: " << ended.sentence();
}

inline const char* const drive_ahead = R"(
start: go
tasks:
  go:
    constraints:
      go: {move: base_link, in: base_link, x: {velocity: 0.3 m/s, force: +-40 N}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
)";

}  // namespace zwang::runtime::test
