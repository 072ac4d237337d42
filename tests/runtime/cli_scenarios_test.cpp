// `zwang test`: which files it takes, what it says of those that it cannot run, and of those that it can.
#include <fcntl.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "program.hpp"

namespace zwang {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::read;
using test::Result;
using std::string_literals::operator""s;

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

TEST_F(Scenarios, AFailureSaysWhatTheTaskWaitedFor) {
  write("waits.yaml", R"(zwang: 1
robot: robots/mecanum_base.yaml
scene: scene.yaml
start: stand
tasks:
  stand:
    constraints: {still: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}
    exits: [{when: moved(base_link) > 1 m, goto: done}]
    timeout: {after: 0.1 s, goto: failed}
)");
  write("good.yaml", "zwang_scenario: 1\ntask: waits.yaml\nexpect: [{outcome: done}]\n");
  const std::string why =
      "`stand` waited 0.100 s, its timeout (waits.yaml:9): `moved(base_link) > 1 m` is false (0.000 m all "
      "the time)";
  const Result r = zwang({"test", "good.yaml", "--junit", "junit.xml"});
  EXPECT_NE(r.out.find("why: " + why + "\n"), std::string::npos) << r.out;
  EXPECT_NE(read(folder_ / "junit.xml").find("`stand` waited 0.100 s, its timeout (waits.yaml:9): "),
            std::string::npos);
  EXPECT_EQ(
      json::parse(zwang({"test", "good.yaml", "--format", "json"}).out)["scenarios"][0]["runs"][0]["why"],
      why);
}

/// The crate stands 3 m ahead, and less of a base that starts nearer.
TEST_F(Scenarios, TheTableHasTheLeastMarginOfAllRunsAndTheRunThatHasIt) {
  const std::string claim = "truth.crate.x - truth.base.x < 4 m";
  write("good.yaml",
        scenario("zwang_scenario", claim) + "matrix: {start_at: [[1 m, 0 m], [0 m, 0 m], [0.9 m, 0 m]]}\n");
  Result r = zwang({"test", "good.yaml"});
  EXPECT_EQ(r.code, 0) << r.out;
  EXPECT_NE(r.out.find("3/3  outcome: done\n"), std::string::npos) << r.out;
  const std::string row =
      "3/3  at end: " + claim + "   3.0000 m, least margin 25.0 % (start_at [0 m, 0 m])\n";
  EXPECT_NE(r.out.find(row), std::string::npos) << r.out;
  EXPECT_EQ(r.out.find('\r'), std::string::npos) << "a line that is written over is for terminals";
  write("good.yaml", scenario("zwang_scenario", "truth.crate.x - truth.base.x < 2.4 m") +
                         "matrix: {start_at: [[1 m, 0 m], [0 m, 0 m], [0.9 m, 0 m]]}\n");
  r = zwang({"test", "good.yaml"});
  EXPECT_EQ(r.code, 1) << r.out;
  EXPECT_NE(r.out.find("  FAIL  start_at [0 m, 0 m]"), std::string::npos) << r.out;
  EXPECT_NE(
      r.out.find(
          "missed: at end: truth.crate.x - truth.base.x < 2.4 m  [good.yaml:3] 3.0000 m, margin -25.0 % at "),
      std::string::npos)
      << r.out;
  EXPECT_NE(r.out.find("2/3  at end: truth.crate.x"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("\n2 of 3 runs as expected, in "), std::string::npos) << r.out;
}

TEST_F(Scenarios, JsonHasEveryRunWithWhatWasExpectedOfIt) {
  write("good.yaml", scenario("zwang_scenario", "truth.crate.x - truth.base.x < 2.4 m") +
                         "matrix: {start_at: [[1 m, 0 m], [0 m, 0 m]]}\n");
  write("bad.yaml", scenario("zwang_scenario", "truth.crat.force < 1 N"));
  const Result r = zwang({"test", "good.yaml", "bad.yaml", "--format", "json"});
  EXPECT_EQ(r.code, 1);
  const json j = json::parse(r.out);
  EXPECT_EQ(j["passed"], false);
  ASSERT_EQ(j["scenarios"].size(), 2u);
  const json& runs = j["scenarios"][0]["runs"];
  EXPECT_EQ(j["scenarios"][0]["file"], "good.yaml");
  EXPECT_EQ(j["scenarios"][0]["passed"], false);
  ASSERT_EQ(runs.size(), 2u);
  for (const std::size_t i : {0u, 1u}) {
    const double ahead = i == 0 ? 2.0 : 3.0;
    EXPECT_EQ(runs[i]["name"], i == 0 ? "start_at [1 m, 0 m]" : "start_at [0 m, 0 m]");
    EXPECT_EQ(runs[i]["outcome"], "done");
    EXPECT_EQ(runs[i]["passed"], i == 0);
    const json& that = runs[i]["expectations"][1];
    EXPECT_EQ(runs[i]["expectations"][0]["held"], true);
    EXPECT_EQ(that["text"], "at end: truth.crate.x - truth.base.x < 2.4 m");
    EXPECT_EQ(that["held"], i == 0);
    EXPECT_NEAR(that["value"], ahead, 1e-3);
    EXPECT_EQ(that["unit"], "m");
    EXPECT_NEAR(that["margin"], 1.0 - that["value"].get<double>() / 2.4, 1e-12);
  }
  EXPECT_EQ(j["scenarios"][1]["passed"], false);
  EXPECT_EQ(j["scenarios"][1]["diagnostics"][0]["code"], "E301") << r.out;
}

// With 0.2 m/s at its end the base needs v^2 / 2a to come to rest, a = 1 m/s^2 of the robot file.
TEST_F(Scenarios, TheEndIsBeforeTheBrakeAndAlwaysGoesOnBehindIt) {
  std::string task = read(folder_ / "task.yaml");
  task.replace(task.find("x: {velocity: 0 m/s}"), 20, "x: {velocity: 0.2 m/s, time_constant: 0.1 s}");
  task.replace(task.find("after: 0.1 s"), 12, "after: 1.5 s");
  write("task.yaml", task);
  write("good.yaml", R"(zwang_scenario: 1
task: task.yaml
expect:
  - {at: end, that: truth.base.x < 2 m}
  - {always: truth.base.x < 2 m}
  - {at: end, that: truth.base.speed > 0.19 m/s}
  - {within: 1 s, that: truth.base.speed > 0.19 m/s}
)");
  const Result r = zwang({"test", "good.yaml", "--format", "json"});
  EXPECT_EQ(r.code, 0) << r.out << r.err;
  const json expected = json::parse(r.out)["scenarios"][0]["runs"][0]["expectations"];
  const double way = expected[1]["value"].get<double>() - expected[0]["value"].get<double>();
  const double v = expected[2]["value"];
  EXPECT_GT(way, v * v / 2.0);
  EXPECT_LT(way, 3.0 * v * v / 2.0);
}

/// Runs of some seconds each, of which the first one is the last to end.
class ManyRuns : public Scenarios {
 protected:
  ManyRuns() {
    std::string task = read(folder_ / "task.yaml");
    task.replace(task.find("start: stand"), 0, "params: {wait: 4 s}\n");
    task.replace(task.find("after: 0.1 s"), 12, "after: $wait");
    write("task.yaml", task);
    write("good.yaml",
          scenario("zwang_scenario", "elapsed < 9 s") + "matrix: {params.wait: [8 s, 4 s, 2 s]}\n");
  }
};

TEST_F(ManyRuns, ShareTheThreadsThatAreAskedForAndKeepTheirOrder) {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  int alone = 0;
  for (const int jobs : {1, 3, 0}) {
    std::vector<std::string> arguments = {"test", "good.yaml", "--format", "json"};
    if (jobs > 0) arguments.insert(arguments.end(), {"--jobs", std::to_string(jobs)});
    const pid_t child = start(arguments);
    const std::string status = "/proc/" + std::to_string(child) + "/status";
    int most = 0;
    for (std::string text = read(status); text.find("State:\tZ") == std::string::npos; text = read(status)) {
      const std::size_t at = text.find("Threads:\t");
      if (at != std::string::npos) most = std::max(most, std::atoi(text.c_str() + at + 9));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const Result r = finish(child);
    EXPECT_EQ(r.code, 0) << r.out;
    if (jobs == 1) alone = most;
    EXPECT_EQ(most - alone + 1, jobs > 0 ? jobs : std::min(3, std::max(1, cores))) << jobs;
    const json whole = json::parse(r.out);
    std::vector<std::string> names;
    for (const json& run : whole["scenarios"][0]["runs"]) names.push_back(run["name"].get<std::string>());
    EXPECT_EQ(names, (std::vector<std::string>{"wait 8 s", "wait 4 s", "wait 2 s"})) << jobs;
  }
}

TEST_F(ManyRuns, AreCountedInOneLineOfTheTerminal) {
  write("good.yaml",
        scenario("zwang_scenario", "elapsed < 0.15 s") + "matrix: {params.wait: [0.1 s, 0.2 s]}\n");
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(terminal, 0);
  ASSERT_EQ(grantpt(terminal), 0);
  ASSERT_EQ(unlockpt(terminal), 0);
  const pid_t child = start({"test", "good.yaml", "--jobs", "1"}, ptsname(terminal));
  std::string shown;
  char piece[4096];
  for (ssize_t n = 0; (n = ::read(terminal, piece, sizeof piece)) > 0;)
    shown.append(piece, static_cast<std::size_t>(n));
  close(terminal);
  EXPECT_EQ(finish(child).code, 1);
  const std::string clear = "\033[K";
  EXPECT_EQ(
      shown.find("\r1 of 2 runs" + clear + "\r2 of 2 runs, 1 failed" + clear + "\r" + clear + "good.yaml"),
      0u)
      << shown;
}

/// The memory of a simulation is taken from the system once, not for each run. Otherwise 1000 runs cost four
/// times as much time in the system as in the program. A page is 4 kB.
TEST_F(ManyRuns, TakeTheirMemoryOnce) {
#ifdef ZWANG_SANITIZED
  GTEST_SKIP() << "a sanitizer owns malloc";
#endif
  const auto page_faults = [this](const std::string& waits) {
    write("good.yaml",
          scenario("zwang_scenario", "elapsed < 9 s") + "matrix: {params.wait: [" + waits + "]}\n");
    rusage before{}, after{};
    getrusage(RUSAGE_CHILDREN, &before);
    EXPECT_EQ(zwang({"test", "good.yaml", "--jobs", "1"}).code, 0);
    getrusage(RUSAGE_CHILDREN, &after);
    return after.ru_minflt - before.ru_minflt;
  };
  const long one = page_faults("0.1 s");
  std::string waits = "0.1 s";
  for (int i = 2; i <= 20; ++i) waits += ", 0.0" + std::to_string(10 + i) + " s";
  const long twenty = page_faults(waits);
  std::printf("%ld page faults of one run, %ld of twenty\n", one, twenty);
  EXPECT_LT(twenty, 3 * one);
}

/// A stopped `test` prints its results so far: the runs that are over, and the number of the others. The
/// others are neither good nor bad.
TEST_F(ManyRuns, AreReportedAsFarAsTheyCameWhenASignalStopsThem) {
  write("good.yaml", scenario("zwang_scenario", "elapsed < 9 s") +
                         "matrix: {params.wait: [0.1 s, 100000 s, 0.2 s]}\n" + "time_limit: 100000 s\n");
  for (const int signal : {SIGINT, SIGTERM}) {
    for (const char* format : {"human", "json"}) {
      fs::remove(folder_ / "junit.xml");
      const pid_t child =
          start({"test", "good.yaml", "--jobs", "1", "--format", format, "--junit", "junit.xml"});
      std::this_thread::sleep_for(std::chrono::milliseconds(1500));
      kill(child, signal);
      const Result r = finish(child);
      EXPECT_EQ(r.code, 2) << r.out << r.err;
      const std::string junit = read(folder_ / "junit.xml");
      EXPECT_EQ(times(junit, "<skipped"), 2u) << junit;
      EXPECT_EQ(times(junit, "<failure"), 0u) << junit;
      if (format == "json"s) {
        const json whole = json::parse(r.out);
        EXPECT_EQ(whole["passed"], false);
        EXPECT_EQ(whole["interrupted_before"], 2);
        ASSERT_EQ(whole["scenarios"][0]["runs"].size(), 1u);
        EXPECT_EQ(whole["scenarios"][0]["runs"][0]["outcome"], "done");
      } else {
        EXPECT_NE(r.out.find("  ok    wait 0.1 s"), std::string::npos) << r.out;
        EXPECT_NE(r.out.find("1 of 1 runs as expected, interrupted before 2 more runs, in "),
                  std::string::npos)
            << r.out;
      }
    }
  }
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

/// The force of the world, estimated from joints and torques, ends the task. The plant's own force is the
/// judge. With a push of 20 N the condition holds for 12 N, and never for 30 N.
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
