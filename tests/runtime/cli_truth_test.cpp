// The report's entries about the plant: the allowed force in the direction of the press, and the limits that
// a blend passed, with their times.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "program.hpp"

namespace zwang {
namespace {

using nlohmann::json;

class Truth : public test::Program {
 protected:
  json run(const std::string& tasks, const std::string& scene) {
    const std::string task = write("task.yaml", "zwang: 2\nrobot: none.yaml\n" + tasks).string();
    const std::string world = write("scene.yaml", "zwang_scene: 1\n" + scene).string();
    const std::string robot = std::string(ZWANG_SOURCE_DIR) + "/specs/robots/mecanum_base.yaml";
    return json::parse(zwang({"run", task, "--robot", robot, "--scene", world, "--format", "json"}).out);
  }
};

constexpr const char* post =
    "objects: {post: {box: [0.2 m, 0.2 m, 1 m], at: [0 m, 0.6 m], stiffness: 10 kN/m}}\n";

/// The base slides sideways into a post. The force range ahead does not bound the force sideways.
std::string sideways(const std::string& force) {
  return R"(start: go
tasks:
  go:
    constraints:
      c: {move: base, in: base, x: {velocity: 0 m/s, force: +-200 N}, y: {velocity: 0.1 m/s, time_constant: 50 ms)" +
         force + R"(}, rz: {velocity: 0 rad/s}}
    timeout: {after: 3 s, goto: done}
)";
}

TEST_F(Truth, AForceRangeOfAnotherAxisAllowsNothing) {
  const json bounded = run(sideways(", force: +-20 N"), post)["truth"]["post"];
  EXPECT_NEAR(bounded["allowed"].get<double>(), 20.0, 0.1);  // the post's side stands across y
  EXPECT_GT(bounded["peak_force"].get<double>(), 40.0);
  EXPECT_TRUE(bounded["hit"].get<bool>());

  const json free = run(sideways(""), post)["truth"]["post"];
  EXPECT_TRUE(free["allowed"].is_null()) << free;
  EXPECT_TRUE(free["hit"].get<bool>());
}

/// A blend is longer than the task: the base leaves the task faster than its range, and entered it with 0.8
/// m/s.
TEST_F(Truth, ABlendHidesNoBrokenRange) {
  const json r = run(R"(start: fast
tasks:
  fast:
    constraints: {go: {move: base, in: world, x: {velocity: 0.8 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}
    exits: [{when: moved(base) > 1 m, goto: slow}]
  slow:
    enter: {blend: 1 s}
    constraints:
      go: {move: base, in: world, x: {velocity: 0.1 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}
      calm: {move: base, in: base, x: {velocity: +-0.15 m/s}}
    exits: [{when: elapsed > 0.9 s, goto: done}]
)",
                     "");
  bool found = false;
  for (const json& limit : r["limits"]) {
    if (limit["row"] != "slow.calm.x.velocity") continue;
    found = true;
    EXPECT_NEAR(limit["worst"].get<double>(), 0.8, 0.05);
    EXPECT_LT(limit["margin"].get<double>(), -0.6);
  }
  EXPECT_TRUE(found) << r["limits"];
}

/// No sample is good from 1 s on. The doubt is told as the run ends.
TEST_F(Truth, ADoubtedStopIsToldWhenItsTimeIsOver) {
  const json r = run(R"(start: go
tasks:
  go:
    constraints: {go: {move: base, in: world, x: {velocity: 0.2 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}
    timeout: {after: 5 s, goto: done}
)",
                     "faults: [{at: 1 s, samples: nan}]\n");
  double stopped = 0.0, doubted = 0.0;
  for (const json& event : r["events"]) {
    if (event["code"] == "bad_sample") stopped = event["time"].get<double>();
    if (event["code"] == "not_at_rest") doubted = event["time"].get<double>();
  }
  EXPECT_NEAR(stopped, 1.0, 0.01);
  EXPECT_NEAR(doubted, r["elapsed"].get<double>(), 0.01) << r["events"];
  EXPECT_GT(doubted, stopped);
}

}  // namespace
}  // namespace zwang
