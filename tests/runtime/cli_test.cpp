// The program as its users meet it: a process with arguments, two streams and an exit code.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <thread>

#include "cli_fixture.hpp"
#include "program.hpp"

namespace zwang {
namespace {

using nlohmann::json;
using namespace test;

/// The number of the first line of the shipped task that contains the text.
int line_of(const std::string& text) {
  const std::string file = read(wall_align);
  const std::size_t at = file.find(text);
  EXPECT_NE(at, std::string::npos) << text;
  return static_cast<int>(std::count(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(at), '\n')) + 1;
}

TEST_F(Cli, AShippedConnectionIsFoundByItsName) {
  const Result misspelt = zwang({"drive", "wall_align", "--over", "mecanum_efort"});
  EXPECT_EQ(misspelt.code, 2);
  EXPECT_NE(misspelt.err.find("did you mean `mecanum_effort`"), std::string::npos) << misspelt.err;
}

TEST_F(Cli, ShippedRobotsAndScenesAreFoundByTheirNames) {
  const Result named = zwang({"plan", "wall_align", "--robot", "kelo_base", "--scene", "wall_far"});
  const Result whole = zwang({"plan", "wall_align", "--robot", specs + "robots/kelo_base.yaml", "--scene",
                              specs + "scenes/wall_far.yaml"});
  EXPECT_EQ(named.code, 0) << named.err;
  EXPECT_EQ(named.out, whole.out);
  EXPECT_EQ(zwang({"robot", "inspect", "kelo_base"}).code, 0);
  const Result robot = zwang({"validate", "wall_align", "--robot", "kelo_bas"});
  EXPECT_EQ(robot.code, 2);
  EXPECT_NE(robot.err.find("did you mean `kelo_base`"), std::string::npos) << robot.err;
  const Result scene = zwang({"run", "wall_align", "--scene", "wall_fra"});
  EXPECT_EQ(scene.code, 2);
  EXPECT_NE(scene.err.find("did you mean `wall_far`"), std::string::npos) << scene.err;
}

// An arm that starts inside of a block: only the plant knows where its tip is. A scene that `validate`
// accepts starts. A scene that `run` refuses is refused by `validate` in the same words.
TEST_F(Cli, ValidateRefusesWhatThePlantRefuses) {
  const std::string arm = specs + "robots/mecanum_arm_base.yaml";
  const fs::path task = write("stand.yaml", "zwang: 1\nrobot: none.yaml" + std::string(stand) +
                                                "    timeout: {after: 0.01 s, goto: done}\n");
  const auto scene_with_block = [&](const std::string& thickness) {
    return write("block.yaml",
                 "zwang_scene: 1\nstart: {at: [0 m, 0 m]}\nobjects:\n  block: {wall: {length: "
                 "2 m, thickness: " +
                     thickness + ", height: 3 m}, at: [0.41 m, 0 m]}\n")
        .string();
  };
  for (const bool is_inside : {true, false}) {
    const std::string scene = scene_with_block(is_inside ? "2 m" : "1 cm");
    const Result good = zwang({"validate", task.string(), "--robot", arm, "--scene", scene});
    const Result run = zwang({"run", task.string(), "--robot", arm, "--scene", scene, "--quiet"});
    EXPECT_EQ(good.code, is_inside ? 1 : 0) << good.out;
    EXPECT_EQ(run.code, is_inside ? 1 : 0) << run.err;
    if (!is_inside) continue;
    const std::string told = good.out.substr(0, good.out.rfind(task.string() + ": "));
    EXPECT_TRUE(run.err.starts_with(told)) << run.err;
    const std::string golden = std::string(ZWANG_SOURCE_DIR) + "/tests/conformance/cli_E915_tip.expected";
    const std::string name = folder_.string() + "/";
    std::string said = told;
    for (std::size_t at = said.find(name); at != std::string::npos; at = said.find(name))
      said.erase(at, name.size());
    if (std::getenv("ZWANG_WRITE_EXPECTED") != nullptr) std::ofstream(golden) << said;
    EXPECT_EQ(said, read(golden));
  }
}

TEST_F(Cli, RunsTheShippedTaskAndTellsTheStoryInJson) {
  const Result r = zwang({"run", wall_align, "--format", "json"});
  EXPECT_EQ(r.code, 0) << r.err;
  const json j = json::parse(r.out);
  EXPECT_EQ(j["outcome"], "done");
  ASSERT_EQ(j["transitions"].size(), 3u);
  EXPECT_EQ(j["transitions"][1]["from"], "press");
  EXPECT_EQ(j["transitions"][1]["to"], "hold");
  EXPECT_NE(j["transitions"][1]["why"].get<std::string>().find("moved(base) > 2 cm (wall_align.yaml:"),
            std::string::npos);
  EXPECT_GE(j["elapsed"], j["transitions"][2]["time"]);

  const json& wall = j["truth"]["wall"];
  EXPECT_GT(wall["touched"], 1.0);
  EXPECT_NEAR(wall["steady_force"], 20.0, 0.2);
  EXPECT_GE(wall["peak_force"], wall["steady_force"]);
  EXPECT_NEAR(j["truth"]["base"]["yaw"].get<double>(), 0.0, 0.1 * std::numbers::pi / 180.0);

  bool speed = false, torque = false;
  for (const json& l : j["limits"]) {
    ASSERT_TRUE(l.contains("row") && l.contains("line") && l.contains("limit") && l.contains("worst") &&
                l.contains("margin") && l.contains("unit"));
    if (l["row"] == "press.contact.x.velocity") {
      speed = true;
      EXPECT_EQ(l["unit"], "m/s");
      EXPECT_EQ(l["line"], line_of("x:  {force: $push"));
    }
    if (l["unit"] == "N m") {
      torque = true;
      EXPECT_GE(l["margin"].get<double>(), 0.0) << l["row"];
    }
  }
  EXPECT_TRUE(speed && torque);

  const std::string log = zwang({"log", "runs/wall_align-001", "--csv"}).out;
  EXPECT_EQ(log.substr(0, 14), "time [s],task,");
  EXPECT_EQ(log.back(), '\n');
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), std::lround(j["elapsed"].get<double>() / 1e-3) + 2)
      << "a header, and a record for each tick from 0 on";
}

TEST_F(Cli, TellsThePersonAtTheTerminalTheSame) {
  const Result r = zwang({"run", wall_align});
  EXPECT_EQ(r.code, 0) << r.err;
  for (const char* words : {"  press -> hold  abs(contact.x.velocity) < 5 mm/s", "done after ", "transitions",
                            "press  -> hold", "limits", "worst", "margin", "truth, as the plant measured it",
                            "pressed with ", "hold.contact.x for 20.000 N", "runs/wall_align-001/log.mcap"}) {
    EXPECT_NE(r.out.find(words), std::string::npos) << words;
  }
  EXPECT_NE(r.out.find("(wall_align.yaml:" + std::to_string(line_of("abs(contact.x.velocity)")) + ")"),
            std::string::npos);
  const Result quiet = zwang({"run", wall_align, "--quiet"});
  EXPECT_EQ(quiet.out.find("done after "), 0u) << "no line before the report";
  EXPECT_TRUE(fs::exists(folder_ / "runs/wall_align-002/log.mcap"));
}

TEST_F(Cli, TwoRunsWithOneSeedWriteTheSameBytes) {
  for (const char* name : {"a", "b"}) {
    EXPECT_EQ(zwang({"run", wall_align, "--seed", "7", "--log", name, "--format", "json"}).code, 0);
  }
  const std::string log = read(folder_ / "a/log.mcap");
  EXPECT_GT(log.size(), 1'000'000u);
  EXPECT_TRUE(log == read(folder_ / "b/log.mcap"));
  EXPECT_FALSE(fs::exists(folder_ / "a/log.csv")) << "nobody asked for it";
}

TEST_F(Cli, ALogThatIsWrittenOverIsToldOf) {
  const std::vector<std::string> run = {"run", wall_align, "--quiet", "--log", "log"};
  const Result first = zwang(run), second = zwang(run);
  EXPECT_EQ(first.code, 0);
  EXPECT_TRUE(first.err.empty()) << first.err;
  EXPECT_EQ(second.code, 0) << "a script that runs again goes on";
  EXPECT_EQ(second.err, "zwang: log: the log that was here is written over\n");
}

TEST_F(Cli, ALogThatIsRefusedIsNotSaidToBeWrittenOver) {
  fs::create_directory(folder_ / "log");
  const fs::path target = write("target", "not a log");
  fs::create_symlink(target, folder_ / "log/log.mcap");
  const Result run = zwang({"run", wall_align, "--quiet", "--log", "log"});
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.err, "zwang: log/log.mcap: is a symbolic link\n");
  EXPECT_EQ(read(target), "not a log");
}

TEST_F(Cli, TakesTheStartPoseFromTheCommandLine) {
  const Result r = run_task(std::string(stand) + "    exits: [{when: elapsed > 0.1 s, goto: done}]\n",
                            {"--format", "json", "--start-yaw", "-35 deg", "--start-at", "-1 m, 25 cm"});
  ASSERT_EQ(r.code, 0) << r.err << r.out;
  const json base = json::parse(r.out)["truth"]["base"];
  EXPECT_NEAR(base["x"], -1.0, 1e-3);
  EXPECT_NEAR(base["y"], 0.25, 1e-3);
  EXPECT_NEAR(base["yaw"].get<double>(), -35.0 * std::numbers::pi / 180.0, 1e-3);
  EXPECT_TRUE(json::parse(r.out)["truth"]["wall"]["touched"].is_null());
}

/// The face of the shipped wall is at x = 0.972 m.
TEST_F(Cli, AsksWhetherTheRobotStandsFreeWhereTheCommandLinePutsIt) {
  const std::string task = "zwang: 1\nrobot: none.yaml\n" + std::string(stand) +
                           "    exits: [{when: elapsed > 0.1 s, goto: done}]\n";
  const std::string file = write("task.yaml", task).string();
  const auto run_in = [&](const std::string& scene, const std::string& at) {
    return zwang({"run", file, "--quiet", "--robot", specs + "robots/mecanum_base.yaml", "--scene", scene,
                  "--start-at", at, "--log", (folder_ / "log").string()});
  };
  const std::string shipped = specs + "scenes/wall.yaml";
  const Result inside = run_in(shipped, "0.9 m, 0 m");
  EXPECT_EQ(inside.code, 1);
  EXPECT_NE(inside.err.find("E913"), std::string::npos) << inside.err;
  std::string blocked = read(shipped);
  const std::string start = "start: {at: [0 m";
  ASSERT_NE(blocked.find(start), std::string::npos);
  blocked.replace(blocked.find(start), start.size(), "start: {at: [0.9 m");
  const Result beside = run_in(write("scene.yaml", blocked).string(), "0 m, 0 m");
  EXPECT_EQ(beside.code, 0) << beside.err;
  const Result again = zwang({"replay", (folder_ / "log/log.mcap").string()});
  EXPECT_EQ(again.code, 0) << again.err;
}

TEST_F(Cli, AParameterFromTheCommandLineIsThePush) {
  const Result r = zwang({"run", wall_align, "-p", "push=30 N", "--format", "json"});
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_NEAR(json::parse(r.out)["truth"]["wall"]["steady_force"], 30.0, 0.3);
  EXPECT_EQ(json::parse(r.out)["asked"][0]["force"], 30.0);
}

TEST_F(Cli, AParameterOutsideItsRangeIsRefusedWithTheLineOfTheRange) {
  for (const std::vector<std::string>& format : {std::vector<std::string>{}, {"--format", "json"}}) {
    std::vector<std::string> arguments = {"run", wall_align, "-p", "push=200N"};
    arguments.insert(arguments.end(), format.begin(), format.end());
    const Result r = zwang(arguments);
    EXPECT_EQ(r.code, 1);
    EXPECT_NE((r.out + r.err).find("E204"), std::string::npos);
    if (format.empty()) {
      EXPECT_NE(r.err.find("wall_align.yaml:" + std::to_string(line_of("push:")) + ":"), std::string::npos)
          << r.err;
    } else {
      EXPECT_EQ(json::parse(r.out)["outcome"], "refused");
    }
  }
  EXPECT_FALSE(fs::exists(folder_ / "runs"));
}

TEST_F(Cli, ASignalStopsTheRunAndClosesTheLog) {
  for (const int signal : {SIGINT, SIGTERM}) {
    write("task.yaml", "zwang: 1\nrobot: none.yaml\n" + std::string(stand) +
                           "    timeout: {after: 100000 s, goto: failed}\n");
    const pid_t child =
        start({"run", (folder_ / "task.yaml").string(), "--robot", specs + "robots/mecanum_base.yaml",
               "--scene", specs + "scenes/wall.yaml", "--log", "log", "--format", "json"});
    for (int i = 0; i < 2000 && read(folder_ / "log/log.mcap").size() < 50'000; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    kill(child, signal);
    const Result r = finish(child);
    EXPECT_EQ(r.code, 1);
    const json j = json::parse(r.out);
    EXPECT_EQ(j["outcome"], "stopped");
    EXPECT_EQ(j["because"], "requested");
    EXPECT_TRUE(j["log_complete"]);
    EXPECT_EQ(zwang({"info", "log"}).code, 0) << "whole";
    fs::remove_all(folder_ / "log");
  }
}

TEST_F(Cli, ValidateTellsGoodFilesFromBadOnes) {
  const std::vector<std::string> good = {wall_align, specs + "robots/mecanum_base.yaml",
                                         specs + "scenes/wall.yaml"};
  Result r = zwang({"validate", good[0], good[1], good[2]});
  EXPECT_EQ(r.code, 0) << r.out << r.err;
  r = zwang({"validate", good[0], good[1], good[2], "--format", "json"});
  EXPECT_EQ(r.code, 0);
  json j = json::parse(r.out);
  EXPECT_EQ(j["ok"], true);
  EXPECT_EQ(j["files"][0]["kind"], "task");
  EXPECT_EQ(j["files"][1]["kind"], "robot");
  EXPECT_EQ(j["files"][2]["kind"], "scene");

  const std::string bad = write("bad.yaml", "zwang_scene: 1\nstart: {at: [0 m, 0 m], yaw: 20}\n").string();
  r = zwang({"validate", good[0], bad});
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.out.find("bad.yaml:2:"), std::string::npos) << r.out;
  r = zwang({"validate", good[0], bad, "--format", "json"});
  EXPECT_EQ(r.code, 1);
  j = json::parse(r.out);
  EXPECT_EQ(j["ok"], false);
  EXPECT_EQ(j["files"][0]["ok"], true);
  EXPECT_EQ(j["files"][1]["ok"], false);
  EXPECT_GE(j["diagnostics"].size(), 1u);
}

TEST_F(Cli, WhatCannotBeDoneEndsWithTwoAndSaysWhyOnStderr) {
  write("a_file", "");
  mkfifo((folder_ / "fifo").c_str(), 0600);
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{}, "subcommand"},
      {{"dance"}, ""},
      {{"run"}, "file"},
      {{"validate"}, "files"},
      {{"run", wall_align, "--fast"}, "--fast"},
      {{"run", wall_align, "--format", "xml"}, "--format"},
      {{"run", wall_align, "--seed", "-1"}, "--seed"},
      {{"run", wall_align, "--seed", "1.5"}, "--seed"},
      {{"run", "no_such.yaml"}, "no_such.yaml: no such file"},
      {{"validate", wall_align, "no_such.yaml"}, "no_such.yaml: no such file"},
      {{"validate", "."}, "no task, robot or scene file"},
      {{"validate", "fifo"}, "not a regular file"},
      {{"run", wall_align, "--robot", "no_robot.yaml"}, "no_robot.yaml: no such file"},
      {{"run", wall_align, "--scene", "no_scene.yaml"}, "no_scene.yaml: no such file"},
      {{"run", wall_align, "--start-yaw", "20"}, "20 deg"},
      {{"run", wall_align, "--start-yaw", "20 m"}, "not an angle"},
      {{"run", wall_align, "--start-at", "1 m"}, "not a point"},
      {{"run", wall_align, "-p", "push"}, "name=20 N"},
      {{"run", wall_align, "-p", "push=20 N", "-p", "push=30 N"}, "`push` is set twice"},
      {{"run", wall_align, "--log", "a_file/below"}, "a_file/below"},
  };
  for (const auto& [arguments, words] : cases) {
    const Result r = zwang(arguments);
    const std::string said = ::testing::PrintToString(arguments) + " said " + r.err;
    EXPECT_EQ(r.code, 2) << said;
    EXPECT_NE(r.err.find(words), std::string::npos) << said;
    EXPECT_EQ(r.err.find("zwang: "), 0u) << said;
    EXPECT_TRUE(r.out.empty()) << said;
  }
}

TEST_F(Cli, AStdoutThatIsClosedOrFullIsAnError) {
  const std::vector<std::vector<std::string>> all = {{"validate", wall_align},
                                                     {"--version"},
                                                     {"--help"},
                                                     {"run", wall_align, "--log", "log", "--format", "json"}};
  for (const auto& arguments : all) {
    EXPECT_EQ(finish(start(arguments, "out", true)).code, 2) << arguments[0] << " closed";
    if (fs::exists("/dev/full")) {
      EXPECT_EQ(finish(start(arguments, "/dev/full")).code, 2) << arguments[0] << " full";
    }
  }
}

TEST_F(Cli, AnswersQuestionsAboutItself) {
  Result r = zwang({"--version"});
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.out.find("zwang "), 0u);
  r = zwang({"run", "--help"});
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.out.find("--start-yaw"), std::string::npos);
}

}  // namespace
}  // namespace zwang
