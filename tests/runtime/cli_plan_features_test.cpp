// `zwang plan` of features and of masses that depend on how the base stands, as a process.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "cli_plan_fixture.hpp"

namespace zwang {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace test;

const char* const feature_task = R"(zwang: 1
robot: robots/mini.yaml
frames:
  wall: {parent: world, at: [2 m, 0 m]}
signals:
  partner: {type: pose, stale_after: 1 s}
features:
  slant: {direction: {move: base_link, in: base_link, x: 0.6, y: 0.8}}
  gap: {distance: [base_link, wall]}
  bearing: {angle: [base_link.x, wall.y]}
always:
  constraints:
    manners: {move: base_link, in: base_link, speed: {velocity: [0 m/s, 0.5 m/s]}}
start: go
tasks:
  go:
    constraints:
      own: {move: base_link, in: base_link, x: {velocity: +-1 m/s}, rz: {velocity: +-1 rad/s}}
      slanted: {feature: slant, velocity: +-1 m/s}
      near: {feature: gap, velocity: +-1 m/s}
      turned: {feature: bearing, velocity: +-1 rad/s}
      seen: {move: bumper, in: partner_frame, x: {velocity: 0.1 m/s}}
    timeout: {after: 9 s, goto: done}
)";

class CliPlanOfGoldenRobots : public CliPlan {
 protected:
  void SetUp() override {
    CliPlan::SetUp();
    const fs::path robots = fs::path(ZWANG_SOURCE_DIR) / "tests/conformance/robots";
    for (const char* name : {"mini.yaml", "mini.urdf", "casters.yaml", "casters.urdf"})
      fs::copy_file(robots / name, folder_ / "robots" / name);
  }
  static json axis(const json& task, const std::string& name) {
    for (const json& a : task.at("axes")) {
      if (a.at("axis") == name) return a;
    }
    ADD_FAILURE() << "no axis " << name << " in " << task.dump(1);
    return {};
  }
};

TEST_F(CliPlanOfGoldenRobots, a_feature_has_the_mass_of_what_it_moves) {
  std::string text = feature_task;
  text.insert(text.find("signals:"), "  partner_frame: {parent: partner}\n");
  write("features.yaml", text);
  const json task = zwang_json("plan features.yaml").at("tasks")[0];
  const auto mass = [&](const std::string& name) {
    return axis(task, name).at("effective_mass").get<double>();
  };
  // s = 0.6 x + 0.8 y with y held by the wheels: 1/m_s = 0.6^2 / m.
  EXPECT_NEAR(mass("slanted"), mass("own.x") / 0.36, 1e-9 * mass("slanted"));
  EXPECT_NEAR(mass("near"), mass("own.x"), 1e-9 * mass("own.x")) << "the wall is straight ahead";
  EXPECT_NEAR(mass("turned"), mass("own.rz"), 1e-9 * mass("own.rz"));
  const std::string human = zwang("plan features.yaml").out;
  for (const char* words : {"manners.speed: no row below 0.25 m/s (features.yaml:14)",
                            "not known at the start: `partner`", " kg m^2  "})
    EXPECT_NE(human.find(words), std::string::npos) << words << " in\n" << human;
  EXPECT_EQ(task.at("dormant")[0].at("row"), "manners.speed");
  EXPECT_EQ(task.at("unknown_signals"), json({"partner"}));
}

TEST_F(CliPlanOfGoldenRobots, masses_that_depend_on_swivels_are_told_from_least_to_most) {
  write("push.yaml",
        "zwang: 1\nrobot: robots/casters.yaml\nstart: go\ntasks:\n  go:\n    constraints:\n      go: {move: "
        "base_link, in: base_link, x: {velocity: 0.1 m/s}}\n    timeout: {after: 9 s, goto: done}\n");
  // As in tests/lang/physics_test.cpp: two units that trail, and two that stand across.
  const double R = 0.05, c = 0.02, half_span = 0.05, I = 0.6e-3;
  const double trailing = 20.0 + 2.0 * (1.0 + 2.0 * (0.5 + I / (R * R)));
  const double turning = 0.002 + 2.0 * (0.3e-3 + 0.5 * half_span * half_span);
  const double across = 20.0 + 2.0 * (1.0 + turning / (c * c) + 2.0 * I * std::pow(half_span / (c * R), 2));
  const json plan = zwang_json("plan push.yaml");
  EXPECT_GT(plan.at("configurations"), 3);
  const json x = axis(plan.at("tasks")[0], "go.x");
  EXPECT_NEAR(x.at("effective_mass").get<double>(), trailing, 1e-6);
  EXPECT_NEAR(x.at("effective_mass_range")[0].get<double>(), trailing, 1e-6);
  EXPECT_NEAR(x.at("effective_mass_range")[1].get<double>(), across, 1e-6);
  const std::string human = zwang("plan push.yaml").out;
  EXPECT_NE(human.find("24.96 kg (24.96 to 53.5)"), std::string::npos) << human;
}

}  // namespace
}  // namespace zwang
