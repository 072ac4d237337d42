// W615 on driven casters: a bounded push, a fillet, and how far the base comes off the path. The figure of
// the message is a closed form of one wheel on a swivel (lang/src/physics/swivel_lag.cpp). The plant has four
// pairs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <sstream>

#include "../is_long.hpp"
#include "../temporary_folder.hpp"
#include "shipped_program.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::runtime {
namespace {

namespace fs = std::filesystem;

struct Rounded {
  double told = 0.0;  ///< [m] by W615; 0: it says nothing
  double off = 0.0;   ///< [m] of the plant
};

/// [m] from two lines that a circle of 0.3 m around (0.7, 0.3) joins.
double off_the_corner(double x, double y) {
  if (x < 0.7) return std::abs(y);
  if (y > 0.3) return std::abs(x - 1.0);
  return std::abs(std::hypot(x - 0.7, y - 0.3) - 0.3);
}

Rounded rounded(const std::string& pace) {
  const zwang::test::TemporaryFolder folder;
  const fs::path file = folder.path() / "task.yaml", scene = folder.path() / "scene.yaml";
  std::ofstream(scene) << "zwang_scene: 1\nstate: perfect\n";
  std::ofstream(file) << "zwang: 2\nrobot: " << zwang::test::specs("robots/kelo_base.yaml") << R"(
paths: {way: {through: [[0 m, 0 m], [1 m, 0 m], [1 m, 0.8 m]], fillet: 0.3 m}}
start: go
tasks:
  go:
    constraints:
      go: {move: base, in: way, x: {velocity: )"
                      << pace << R"(}, y: {position: 0 m}, rz: {position: 0 deg, level: 2}}
      calm: {move: base, in: base, plane: {force: [0 N, 25 N]}}
    exits: [{when: go.x.position > length(way), for: 20 ms, goto: done}]
    timeout: {after: 20 s, goto: failed}
)";
  lang::Diagnostics diagnostics;
  lang::LoadOptions options;
  options.scene = scene;
  options.root = "/";
  const auto program = lang::load(file, options, diagnostics);
  std::ostringstream words;
  lang::render_human(diagnostics, words);
  if (!program) throw std::runtime_error(words.str());
  Rounded result;
  const std::string text = words.str(), by = "off the path by some ";
  if (text.find("W615") != std::string::npos) result.told = std::stod(text.substr(text.find(by) + by.size()));
  ScenePlant plant(*program);
  Runner runner(*program);
  Sensed sensed(program->robot.model, program->signals.size());
  while (runner.state() == RunState::running || plant.truth().time == 0.0) {
    if (plant.sense(sensed) != PlantStatus::ok || plant.apply(runner.step(sensed)) != PlantStatus::ok) break;
    result.off = std::max(result.off, off_the_corner(plant.truth().x, plant.truth().y));
  }
  std::printf("%s: told %.2f mm, off by %.2f mm\n", pace.c_str(), 1e3 * result.told, 1e3 * result.off);
  return result;
}

TEST(SwivelLag, IsToldWhereTheBaseComesOffThePathByMoreThanAMillimetre) {
  const Rounded slow = rounded("0.15 m/s");
  EXPECT_EQ(slow.told, 0.0);
  EXPECT_LT(slow.off, 1e-3);
  std::vector<const char*> paces{"0.2 m/s"};
  if (zwang::test::is_long()) paces.push_back("0.3 m/s");
  for (const char* pace : paces) {
    const Rounded fast = rounded(pace);
    EXPECT_GT(fast.told, 0.5 * fast.off);
    EXPECT_LT(fast.told, 2.5 * fast.off) << "the one wheel turns by more than those beside the turn";
  }
}

}  // namespace
}  // namespace zwang::runtime
