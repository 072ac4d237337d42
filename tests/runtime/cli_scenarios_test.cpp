// `zwang test`: which files it takes, and what it says of those that it cannot run.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace zwang {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::read;
using test::Result;

std::size_t times(const std::string& text, const std::string& words) {
  std::size_t found = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++found;
  return found;
}

/// A folder with a task that is done after 0.1 s, and a scenario of it.
class Scenarios : public test::Program {
 protected:
  Scenarios() {
    fs::copy(fs::path(ZWANG_SOURCE_DIR) / "specs/robots", folder_ / "robots", fs::copy_options::recursive);
    write("scene.yaml",
          "zwang_scene: 1\nobjects: {crate: {box: [1 m, 1 m, 1 m], at: [3 m, 0 m], mass: 20 kg}}\n");
    write("task.yaml", R"(zwang: 1
robot: robots/mecanum_base.yaml
scene: scene.yaml
start: stand
tasks:
  stand:
    constraints: {still: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}
    timeout: {after: 0.1 s, goto: done}
)");
    write("good.yaml", scenario("zwang_scenario", "truth.crate.force < 1 N"));
  }
  static std::string scenario(const std::string& key, const std::string& that) {
    return key + ": 1\ntask: task.yaml\nexpect: [{outcome: done}, {at: end, that: " + that + "}]\n";
  }
};

TEST_F(Scenarios, AFileThatCannotBeRunIsNoRunThatWentAsExpected) {
  write("bad.yaml", scenario("zwang_scenario", "truth.crat.force < 1 N"));
  const Result r = zwang({"test", "good.yaml", "bad.yaml", "--junit", "junit.xml"});
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.out.find("\n1 of 1 runs as expected, and 1 file with errors, in "), std::string::npos) << r.out;
  const std::string junit = read(folder_ / "junit.xml");
  EXPECT_EQ(times(junit, "<testcase "), 2u) << junit;
  EXPECT_EQ(times(junit, "<failure "), 1u) << junit;
  EXPECT_NE(junit.find("bad.yaml\" tests=\"1\" failures=\"1\""), std::string::npos) << junit;
  const Result alone = zwang({"test", "bad.yaml"});
  EXPECT_NE(alone.out.find("\n0 of 0 runs as expected, and 1 file with errors"), std::string::npos)
      << alone.out;
}

TEST_F(Scenarios, AFolderHidesNoBrokenScenario) {
  fs::create_directory(folder_ / "claims");
  const auto claim = [](std::string key) {
    std::string text = scenario(key, "truth.crate.force < 1 N");
    return text.replace(text.find("task.yaml"), 9, "../task.yaml");
  };
  write(".zwang-root", "");
  write("claims/good.yaml", claim("zwang_scenario"));
  const char* const broken[] = {"zwang_scenaro", "zwang_scenarios", "zwang-scenario", "\tzwang_scenario",
                                "zwang_scneario"};
  for (const char* key : broken) {
    write("claims/other.yml", claim(key));
    const Result r = zwang({"test", "claims"});
    EXPECT_EQ(r.code, 1) << key;
    EXPECT_NE(r.out.find("claims/other.yml:1:1: error E10"), std::string::npos) << key << "\n" << r.out;
    EXPECT_NE(r.out.find("1 of 1 runs as expected, and 1 file with errors"), std::string::npos) << r.out;
    EXPECT_EQ(zwang({"validate", "claims"}).code, 1) << key;
  }
  for (const char* key : {"\"zwang_scenario\"", "'zwang_scenario'"}) {
    write("claims/other.yml", claim(key));
    const Result r = zwang({"test", "claims"});
    EXPECT_EQ(r.code, 0) << key << r.out;
    EXPECT_NE(r.out.find("2 of 2 runs as expected, in "), std::string::npos) << r.out;
  }
}

TEST_F(Scenarios, WhatIsPassedOverInAFolderIsNamed) {
  write("compose.yaml", "services: {}\n");
  const Result r = zwang({"test", "."});
  EXPECT_EQ(r.code, 0) << r.out;
  EXPECT_NE(r.err.find("compose.yaml is passed over"), std::string::npos) << r.err;
  EXPECT_EQ(times(r.err, "\n"), 1u) << "the task, the scene and the robots are no surprise: " << r.err;
}

TEST_F(Scenarios, JUnitNamesWhatWasMissed) {
  write("good.yaml", scenario("zwang_scenario", "truth.crate.x < 2 m"));
  EXPECT_EQ(zwang({"test", "good.yaml", "--junit", "junit.xml"}).code, 1);
  const std::string junit = read(folder_ / "junit.xml");
  EXPECT_NE(junit.find("<failure message=\"missed: at end: truth.crate.x &lt; 2 m (the run ended: done)\">"),
            std::string::npos)
      << junit;
}

/// The crate stands 3 m away: 3 m more than 0 m, and by which share is not to be said.
TEST_F(Scenarios, NothingIsAShareOfZero) {
  write("good.yaml", scenario("zwang_scenario", "truth.crate.x > 0 m"));
  Result r = zwang({"test", "good.yaml"});
  EXPECT_EQ(r.code, 0) << r.out;
  EXPECT_EQ(r.out.find("margin"), std::string::npos) << r.out;
  write("good.yaml", scenario("zwang_scenario", "truth.crate.x > 0 m and truth.crate.x < 4 m"));
  r = zwang({"test", "good.yaml"});
  EXPECT_NE(r.out.find("least margin 25.0 %"), std::string::npos) << r.out;
  write("good.yaml", scenario("zwang_scenario", "truth.crate.x < 0 m"));
  r = zwang({"test", "good.yaml"});
  EXPECT_EQ(r.code, 1) << r.out;
  EXPECT_EQ(r.out.find("margin"), std::string::npos) << r.out;
}

/// What the world presses with, as joints and torques tell it, ends the task; the plant's own force is the
/// judge. At 20 N of push 12 N come and 30 N never do.
TEST_F(Scenarios, AConditionOnTheEstimatedForceFiresWhereTheForceIs) {
  fs::create_directory(folder_ / "scenes");
  fs::copy(fs::path(ZWANG_SOURCE_DIR) / "specs/scenes/wall_far.yaml", folder_ / "scenes/wall.yaml");
  std::string arm = read(folder_ / "robots/mecanum_arm_base.yaml");
  arm.replace(arm.find("posture: {"), 10, "posture: {arm_1: 180 deg, ");  // away from the wall
  write("robots/mecanum_arm_base.yaml", arm);
  write("press.yaml", R"(zwang: 1
robot: robots/mecanum_base.yaml
scene: scenes/wall.yaml
params: {least: 12 N}
start: press
tasks:
  press:
    constraints:
      go: {move: base_link, in: base_link, x: {force: 20 N, velocity: +-0.15 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
    exits: [{when: estimated.force.x < -$least, for: 0.5 s, goto: done}]
    timeout: {after: 12 s, goto: failed}
)");
  const std::string head = R"(zwang_scenario: 1
task: press.yaml
matrix:
  robot: [robots/mecanum_base.yaml, robots/diff_base.yaml, robots/kelo_base.yaml, robots/kelo_two_base.yaml, robots/mecanum_arm_base.yaml]
  start_yaw: [0 deg]
)";
  write("fires.yaml", head + R"(expect:
  - outcome: done
  - {at: end, that: abs(truth.wall.force - 20 N) < 2 N}
)");
  write("never.yaml", head + "params: {least: 30 N}\n" + R"(expect:
  - outcome: failed
  - {at: end, that: abs(truth.wall.force - 20 N) < 0.5 N}
)");
  const Result r = zwang({"test", "fires.yaml", "never.yaml"});
  EXPECT_EQ(r.code, 0) << r.out << r.err;
  EXPECT_NE(r.out.find("10 of 10 runs as expected"), std::string::npos) << r.out;
}

}  // namespace
}  // namespace zwang
