// How a run that does not reach `done` ends for its user: the exit code, the first line, and the reason.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli_fixture.hpp"

namespace zwang {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace test;

TEST_F(Cli, ATaskThatFailsEndsWithOne) {
  const Result r = run_task(std::string(stand) + "    timeout: {after: 0.2 s, goto: failed}\n");
  EXPECT_EQ(r.code, 1) << r.err;
  const json j = json::parse(r.out);
  EXPECT_EQ(j["outcome"], "failed");
  EXPECT_EQ(j["transitions"][1]["to"], "failed");
  EXPECT_EQ(j["transitions"][1]["why"], "timeout after 0.2 s (task.yaml:8)");
}

TEST_F(Cli, ATaskThatFailsSaysWhyInTheReportInJsonAndInTheLog) {
  const std::string task =
      std::string(stand) +
      "    exits:\n      - {when: moved(base_link) > 1 m and elapsed > 0.1 s, for: 0.1 s, "
      "goto: done}\n    timeout: {after: 0.2 s, goto: failed}\n";
  const std::string sentence =
      "`stand` waited 0.200 s, its timeout (task.yaml:10): `moved(base_link) > 1 m` is false (0.000 m all "
      "the time)";
  const Result r = run_task(task);
  const json why = json::parse(r.out)["why"];
  EXPECT_EQ(why["sentence"], sentence);
  EXPECT_EQ(why["cause"], "timeout");
  const json& exit = why["exits"][0];
  EXPECT_EQ(exit["column"], "stand.exit1.true_for");
  EXPECT_EQ(exit["line"], 9);
  EXPECT_EQ(exit["is"], "false");
  EXPECT_EQ(exit["terms"][0]["is"], "false");
  EXPECT_EQ(exit["terms"][0]["unit"], "m");
  EXPECT_EQ(exit["terms"][1]["is"], "true");
  EXPECT_NEAR(exit["terms"][1]["value"], 0.2, 1e-9);
  EXPECT_EQ(exit["terms"][1]["holds_back"], false);

  const Result told = run_task(task, {"--quiet", "--log", "log"});
  EXPECT_EQ(told.out.find("failed after 0.30"), 0u) << told.out;
  EXPECT_NE(told.out.substr(0, told.out.find('\n')).find(sentence), std::string::npos) << told.out;
  EXPECT_NE(told.out.find("waited for, in `stand`\n"), std::string::npos) << told.out;
  const json info = json::parse(zwang({"info", "log/log.mcap", "--format", "json"}).out);
  EXPECT_EQ(info["outcome"], "failed");
  EXPECT_NE(info["verdict"].get<std::string>().find(sentence), std::string::npos) << info["verdict"];
}

// The file allows 20 N. A base that meets 100 kN/m with 0.08 m/s presses with more than twice of it at first.
TEST_F(Cli, WhatIsHitStandsInTheFirstLineAndBrokenLimitsComeFirst) {
  const Result r = zwang({"run", wall_align, "--format", "json"});
  const json j = json::parse(r.out);
  const std::string verdict = j["verdict"];
  EXPECT_EQ(verdict.find("done after "), 0u);
  EXPECT_NE(verdict.find(", hit `wall` with "), std::string::npos) << verdict;
  EXPECT_NE(verdict.find(" where 20.00 N are allowed"), std::string::npos) << verdict;
  const json& wall = j["truth"]["wall"];
  EXPECT_TRUE(wall["hit"]);
  EXPECT_FALSE(wall["came"]) << "a wall that is fixed comes to nobody";
  EXPECT_EQ(wall["pushed_away"], 0.0);
  EXPECT_EQ(wall["peak_in"], "press");
  EXPECT_GT(wall["peak_force"].get<double>(), 2.0 * 20.0);
  EXPECT_NEAR(wall["allowed"].get<double>(), 20.0, 0.01);  // 20 N / cos of 1.7 deg askew at most
  EXPECT_GE(wall["peak_at"], wall["touched"]);
  bool was_whole = false;
  for (const json& l : j["limits"]) {
    const bool is_broken = l["broken"];
    EXPECT_EQ(is_broken, l["margin"].get<double>() < -1e-3 * std::abs(l["limit"].get<double>())) << l;
    EXPECT_FALSE(is_broken && was_whole) << l;
    was_whole = was_whole || !is_broken;
  }
}

// Each name of a limit is a column of the log.
TEST_F(Cli, LimitsAreNamedAsTheirColumns) {
  const Result r = zwang({"run", specs + "laws/fence.yaml", "--log", "log", "--format", "json"});
  const std::string log = zwang({"log", "log"}).out;
  const std::string header = "," + log.substr(0, log.find('\n')) + ",";
  const json limits = json::parse(r.out)["limits"];
  ASSERT_GT(limits.size(), 5u);
  for (const json& l : limits) {
    const std::string column = "," + l["row"].get<std::string>() + " [" + l["unit"].get<std::string>() + "],";
    EXPECT_NE(header.find(column), std::string::npos) << column;
  }
}

// Its mass goes 15 cm ahead, beyond its front wheels: it tips over on its nose before the task says `done`.
TEST_F(Cli, ABaseThatFallsEndsWithOneAndIsNeverDone) {
  const fs::path task = write("task.yaml", "zwang: 1\nrobot: none.yaml\n" + std::string(stand) +
                                               "    timeout: {after: 2 s, goto: done}\n");
  const fs::path scene = write("scene.yaml",
                               "zwang_scene: 1\nstart: {at: [0 m, 0 m]}\nfaults:\n"
                               "  - {at: 0.1 s, centre_of_mass: 15 cm}\n");
  const Result r = zwang({"run", task.string(), "--robot", specs + "robots/omni_base.yaml", "--scene",
                          scene.string(), "--format", "json"});
  EXPECT_EQ(r.code, 1) << r.err;
  const json j = json::parse(r.out);
  EXPECT_EQ(j["outcome"], "fallen");
  const std::string verdict = j["verdict"];
  EXPECT_NE(verdict.find(": the base tipped over its front, pitch "), std::string::npos) << verdict;
  EXPECT_TRUE(verdict.ends_with(" deg, in `stand`, after the scene's fault of 0.100 s")) << verdict;
  EXPECT_EQ(j["faults"], json::parse(R"([{"at": 0.1, "line": 4}])"));
  EXPECT_GT(j["truth"]["base"]["pitch"].get<double>(), 5.0 * std::numbers::pi / 180.0);
  EXPECT_GT(j["truth"]["base"]["fallen"].get<double>(), 0.1);
}

TEST_F(Cli, AFallNamesTheFaultOfItsCell) {
  const fs::path task = write("stand.yaml", "zwang: 1\nrobot: robots/omni_base.yaml\n" + std::string(stand) +
                                                "    timeout: {after: 2 s, goto: done}\n");
  fs::copy(specs + "robots", task.parent_path() / "robots", fs::copy_options::recursive);
  write("open.yaml", "zwang_scene: 1\nstart: {at: [0 m, 0 m]}\n");
  const fs::path scenario = write("ahead.yaml",
                                  "zwang_scenario: 1\ntask: stand.yaml\nscene: open.yaml\n"
                                  "matrix: {faults: [ahead]}\n"
                                  "faults: {ahead: [{at: 0.1 s, centre_of_mass: 15 cm}]}\n"
                                  "expect: [{outcome: fallen}]\n");
  const Result r = zwang({"run", scenario.string(), "--cell", "faults ahead", "--format", "json"});
  const json j = json::parse(r.out);
  const std::string verdict = j["verdict"];
  EXPECT_TRUE(verdict.ends_with(" deg, in `stand`, after the cell's fault of 0.100 s")) << verdict;
  EXPECT_EQ(j["faults"], json::parse(R"([{"at": 0.1}])"));
}

TEST_F(Cli, WhatWouldHaveSwitchedTooIsSaid) {
  const Result r = run_task(std::string(stand) +
                            "    exits:\n      - {when: elapsed > 0.1 s, goto: done}\n"
                            "      - {when: elapsed > 0.05 s and elapsed > 0.1 s, goto: failed}\n"
                            "    timeout: {after: 5 s, goto: failed}\n");
  EXPECT_EQ(r.code, 0) << r.err;
  const json j = json::parse(r.out);
  EXPECT_EQ(j["transitions"][0]["also_true"], json::array());
  EXPECT_EQ(j["transitions"][1]["also_true"], json::array({"elapsed > 0.05 s and elapsed > 0.1 s"}));
}

}  // namespace
}  // namespace zwang
