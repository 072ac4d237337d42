// Events from outside while the program runs a task, and the use of its log afterwards.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <vector>

#include "../times_count.hpp"
#include "program.hpp"

namespace zwang {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::read;
using test::Result;
using Clock = std::chrono::steady_clock;
using std::string_literals::operator""s;

const std::string specs = std::string(ZWANG_SOURCE_DIR) + "/specs/";

class FromOutside : public test::Program {
 protected:
  /// A task that never ends, under way.
  pid_t start_endless(const std::vector<std::string>& options = {}, const std::string& speed = "0 m/s") {
    write("task.yaml", R"(zwang: 1
robot: none.yaml
start: go
tasks:
  go:
    constraints: {go: {move: base_link, in: base_link, x: {velocity: )" +
                           speed + R"(}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}
    timeout: {after: 100000 s, goto: failed}
)");
    write("scene.yaml", wall);
    std::vector<std::string> words{"run",     (folder_ / "task.yaml").string(),
                                   "--robot", specs + "robots/mecanum_base.yaml",
                                   "--scene", (folder_ / "scene.yaml").string(),
                                   "--log",   "log",
                                   "--csv",   "--format",
                                   "json"};
    words.insert(words.end(), options.begin(), options.end());
    const pid_t child = start(words);
    for (int i = 0; i < 4000 && read(folder_ / "log/log.csv").size() < 100'000; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return child;
  }

  const std::string wall = read(specs + "scenes/wall.yaml");

  /// [s] of the last whole line that is on disk.
  double last_time_in_csv() const {
    const std::string text = read(folder_ / "log/log.csv");
    const std::size_t end = text.rfind('\n');
    const std::size_t begin = end == std::string::npos ? end : text.rfind('\n', end - 1);
    return begin == std::string::npos ? -1e9 : std::strtod(text.c_str() + begin + 1, nullptr);
  }
  /// A column of the log, one value a record.
  std::vector<double> column(const std::string& name) const {
    std::ifstream file(folder_ / "log/log.csv");
    std::string line;
    std::getline(file, line);
    const auto index = std::count(line.begin(), line.begin() + std::ptrdiff_t(line.find(name)), ',');
    std::vector<double> values;
    while (std::getline(file, line)) {
      std::stringstream cells(line);
      for (std::ptrdiff_t i = 0; i <= index; ++i) std::getline(cells, line, ',');
      values.push_back(std::stod(line));
    }
    return values;
  }
};

TEST_F(FromOutside, ASignalEndsTheRunWithinHalfASecond) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const pid_t child = start_endless();
    const auto begin = Clock::now();
    kill(child, signal);
    const Result r = finish(child);
    const double took = std::chrono::duration<double>(Clock::now() - begin).count();
    std::printf("signal %d: stopped, log closed and process gone after %.0f ms\n", signal, 1e3 * took);
    if (test::times_count) {
      EXPECT_LE(took, 0.5);
    }
    const json j = json::parse(r.out);
    EXPECT_EQ(j["outcome"], "stopped");
    EXPECT_TRUE(j["log_complete"]);
    ASSERT_EQ(j["events"].size(), 1u);
    EXPECT_EQ(j["events"][0]["code"], "requested");
    const Result info = zwang({"info", "log/log.mcap"});
    EXPECT_EQ(info.code, 0) << info.out;
    fs::remove_all(folder_ / "log");
  }
}

/// From 0.7 m/s with 1 m/s^2 a robot needs longer than somebody waits who has asked for the end.
TEST_F(FromOutside, ASignalBringsARobotToRestThatIsWatched) {
  const pid_t child = start_endless({"--watch"}, "-0.9 m/s");
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  const auto begin = Clock::now();
  kill(child, SIGINT);
  const Result r = finish(child);
  const double took = std::chrono::duration<double>(Clock::now() - begin).count();
  if (test::times_count) {
    EXPECT_LE(took, 0.5);
  }
  const json j = json::parse(r.out);
  EXPECT_EQ(j["events"][0]["code"], "requested");
  EXPECT_EQ(j["because"].get<std::string>().find("before the robot stood"), std::string::npos);
  const std::vector<double> ahead = column("base.vx [m/s]");
  ASSERT_FALSE(ahead.empty());
  const double fastest = -*std::min_element(ahead.begin(), ahead.end());
  std::printf("from %.2f m/s to %.4f m/s\n", fastest, -ahead.back());
  EXPECT_GT(fastest, 0.6) << "so that it has to brake for longer than anybody waits";
  EXPECT_NEAR(ahead.back(), 0.0, 0.02);
}

/// Saves from an editor: a file with a slip, then a change of the scene, which the plant has read before,
/// then the right file. The run goes on with the old file, then with the new one, and both of its logs
/// replay.
TEST_F(FromOutside, ATaskFileThatChangesIsReloadedAndReplays) {
  const pid_t child = start_endless({"--watch"});
  const std::string endless = read(folder_ / "task.yaml");
  const auto said = [&](const std::string& words) {
    for (int i = 0; i < 100; ++i) {
      if (read(folder_ / "err").find(words) != std::string::npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  };
  write("task.yaml", endless.substr(0, endless.size() / 2));
  EXPECT_TRUE(said("was not reloaded, the old program goes on: it has errors")) << read(folder_ / "err");
  write("scene.yaml", wall + "# looked at again\n");
  EXPECT_TRUE(said("scene.yaml has changed, which is read when a run starts")) << read(folder_ / "err");
  write("scene.yaml", wall);
  std::string other = endless;
  other.replace(other.find("x: {velocity: 0 m/s}"), 20, "x: {velocity: 0.05 m/s}");
  other.replace(other.find("100000 s, goto: failed"), 22, "0.5 s, goto: done");
  write("task.yaml", other);
  EXPECT_TRUE(said("reloaded at")) << read(folder_ / "err");
  const Result r = finish(child);
  EXPECT_EQ(r.code, 0) << r.out << r.err;
  const json report = json::parse(r.out);
  EXPECT_EQ(report["outcome"], "done");
  EXPECT_EQ(report["logs"], json({"log/log.mcap", "log/log-reload-1.mcap"}));
  ASSERT_EQ(report["before"].size(), 1u) << "what the first program did is told as well";
  EXPECT_EQ(report["before"][0]["transitions"][0]["to"], "go");
  EXPECT_EQ(report["transitions"].back()["to"], "done");
  EXPECT_EQ(report["transitions"][0]["time"], report["before"][0]["until"]) << "at the tick of the swap";
  EXPECT_FALSE(report["before"][0]["limits"].empty());
  json whole;
  for (const char* log : {"log/log.mcap", "log/log-reload-1.mcap"}) {
    const Result again = zwang({"replay", log, "--format", "json"});
    EXPECT_EQ(again.code, 0) << again.out << again.err;
    const json replayed = json::parse(again.out);
    EXPECT_EQ(replayed["equal"], replayed["records"]) << log;
    EXPECT_TRUE(whole.is_null() || replayed["records"] > whole["records"]) << "both of them";
    whole = replayed;
  }
  std::printf("reloaded: %d records of both logs, all equal\n", whole["records"].get<int>());
}

TEST_F(FromOutside, AThreadThatIsBlockedFor200MillisecondsStops) {
  const pid_t child = start_endless({"--watchdog"});
  kill(child, SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  kill(child, SIGCONT);
  const auto begin = Clock::now();
  const Result r = finish(child);
  std::printf("blocked for 200 ms: gone %.0f ms later\n",
              1e3 * std::chrono::duration<double>(Clock::now() - begin).count());
  EXPECT_EQ(r.code, 1);
  const json j = json::parse(r.out);
  EXPECT_EQ(j["outcome"], "stopped");
  EXPECT_EQ(j["because"], "the control thread was blocked");
  EXPECT_EQ(j["events"][0]["code"], "watchdog");
}

/// With --watch a run keeps to the wall clock: what time it is in the run is known from outside. Of three
/// kills the best, for a machine that is busy may be late on its own.
TEST_F(FromOutside, AKilledRunLosesAtMost100Milliseconds) {
  if (!test::times_count) GTEST_SKIP() << "a deadline in real time, which instrumented code need not meet";
  const auto seconds_now = [] {
    return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
  };
  double least_lost = 1e9;
  for (int i = 0; i < 3; ++i) {
    fs::remove_all(folder_ / "log");
    const pid_t child = start_endless({"--watch"});
    double ahead = -1e9;  // of the run's time on the clock's, by what was on disk soonest
    double now = seconds_now();
    for (const double until = now + 0.3 + 0.033 * i; now < until; now = seconds_now()) {
      ahead = std::max(ahead, last_time_in_csv() - now);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    now = seconds_now();
    kill(child, SIGKILL);
    finish(child);
    const Result info = zwang({"info", "log/log.mcap", "--format", "json"});
    EXPECT_EQ(info.code, 1);
    const double csv = last_time_in_csv(), mcap = json::parse(info.out)["end"];
    EXPECT_LE(csv - mcap, 0.09) << "one thread writes both; a chunk is late by its own length";
    const double lost = now + ahead - std::min(csv, mcap);
    std::printf("killed at %.3f s: csv ends at %.3f s, mcap at %.3f s\n", now + ahead, csv, mcap);
    least_lost = std::min(least_lost, lost);
  }
  EXPECT_LE(least_lost, 0.1);
}

TEST_F(FromOutside, AReplayComputesTheSameTorquesToTheLastBit) {
  for (const std::string scene : {"scenes/wall_far_measured.yaml", "scenes/wall_far.yaml"}) {
    fs::remove_all(folder_ / "log");
    ASSERT_EQ(zwang({"run", specs + "wall_align.yaml", "--scene", specs + scene, "-p", "push=25 N", "--log",
                     "log", "--quiet"})
                  .code,
              0);
    const Result again = zwang({"replay", "log/log.mcap", "--format", "json"});
    EXPECT_EQ(again.code, 0) << again.out << again.err;
    const json j = json::parse(again.out);
    EXPECT_GT(j["records"], 1000);
    EXPECT_EQ(j["records"], j["equal"]);
    EXPECT_TRUE(j["first_difference"].is_null()) << j["first_difference"];
  }
}

TEST_F(FromOutside, AReplayOfARunThatWasStoppedIsTheSame) {
  const pid_t child = start_endless();
  kill(child, SIGINT);
  finish(child);
  const Result again = zwang({"replay", "log/log.mcap"});
  EXPECT_EQ(again.code, 0) << again.out << again.err;
  EXPECT_NE(again.out.find("with the same torques to the last bit"), std::string::npos) << again.out;
}

TEST_F(FromOutside, AReplayTellsTheFirstDifference) {
  ASSERT_EQ(zwang({"run", specs + "wall_align.yaml", "--log", "log", "--quiet"}).code, 0);
  // The facts of the log stand in it as they are: another period of the same length.
  std::string bytes = read(folder_ / "log/log.mcap");
  const std::string key = "period [s]";
  const std::size_t at = bytes.find(key);
  ASSERT_NE(at, std::string::npos);
  const std::size_t value = bytes.find("0.001", at + key.size());
  ASSERT_LT(value, at + key.size() + 8);
  bytes.replace(value, 5, "0.002");
  std::ofstream(folder_ / "log/log.mcap", std::ios::binary) << bytes;
  const Result again = zwang({"replay", "log/log.mcap", "--format", "json"});
  EXPECT_EQ(again.code, 1) << again.err;
  const json j = json::parse(again.out);
  EXPECT_LT(j["equal"], j["records"]);
  ASSERT_TRUE(j["first_difference"].is_object());
  EXPECT_NE(j["first_difference"]["column"].get<std::string>().find(".tau"), std::string::npos);
}

/// The facts of a log stand in it as they are, and anybody may have written it.
TEST_F(FromOutside, WhatALogSaysDoesNotWriteToTheTerminal) {
  ASSERT_EQ(zwang({"run", specs + "wall_align.yaml", "--log", "log", "--quiet"}).code, 0);
  std::string bytes = read(folder_ / "log/log.mcap");
  const std::size_t value = bytes.find("0.001", bytes.find("period [s]"));
  ASSERT_NE(value, std::string::npos);
  bytes.replace(value, 5, "\x1b[31m");
  std::ofstream(folder_ / "log/log.mcap", std::ios::binary) << bytes;
  const Result info = zwang({"info", "log/log.mcap"});
  EXPECT_NE(info.out.find("period [s]          \\x1b[31m\n"), std::string::npos) << info.out;
  EXPECT_EQ(info.out.find('\x1b'), std::string::npos);
  EXPECT_EQ(info.code, 1) << "a CRC tells that it was changed";
  const Result replay = zwang({"replay", "log/log.mcap"});
  EXPECT_EQ(replay.code, 2);
  EXPECT_EQ(replay.err, "zwang: `\\x1b[31m` in the log is not a control period\n");
}

/// A file's name is anybody's, and a file's text need not be UTF-8.
TEST_F(FromOutside, WhatANameOrAFileSaysDoesNotWriteToTheTerminal) {
  const std::string evil = "t\x1b[31m\xc2\x9b\xff\xe2\x80\xae.yaml";  // ESC, CSI, no UTF-8, right to left
  const std::string shown = "t\\x1b[31m\\xc2\\x9b\\xff\\xe2\\x80\\xae.yaml";
  fs::copy(specs, folder_ / "specs", fs::copy_options::recursive);
  fs::copy_file(specs + "wall_align.yaml", folder_ / "specs" / evil);
  write("specs/bad.yaml", "zwang: 1\nrobot: \x1b\x9b\xff.yaml\n");
  write("specs/scenario.yaml", "zwang_scenario: 1\ntask: wall_align.yaml\nexpect: [{outcome: done}]\n");
  fs::rename(folder_ / "specs/scenario.yaml", folder_ / "specs" / ("s" + evil));
  const std::string named = "specs/" + evil;
  for (const std::vector<std::string>& verb :
       std::vector<std::vector<std::string>>{{"validate", named},
                                             {"validate", "specs/bad.yaml"},
                                             {"validate", named, "--format", "short"},
                                             {"plan", named},
                                             {"graph", "specs/bad.yaml"},
                                             {"fmt", "--check", named},
                                             {"run", named, "--log", "log\x1b\xff"},
                                             {"test", "specs/s" + evil},
                                             {"info", named},
                                             {"robot", "inspect", named}}) {
    const Result r = zwang(verb);
    for (const std::string& text : {r.out, r.err}) {
      for (const char* raw : {"\x1b", "\xc2\x9b", "\xff", "\xe2\x80\xae"})
        EXPECT_EQ(text.find(raw), std::string::npos) << verb[0] << ": " << text;
    }
    const bool is_named = verb.size() == 2 && verb[1] == named && verb[0] != "plan" && verb[0] != "run";
    if (is_named) {
      EXPECT_NE((r.out + r.err).find(shown), std::string::npos) << verb[0] << r.out << r.err;
    }
  }
}

/// However its path was typed, a file is the same file.
TEST_F(FromOutside, ALogDoesNotDependOnHowThePathIsTyped) {
  fs::copy(specs, folder_ / "specs", fs::copy_options::recursive);
  const std::string absolute = (folder_ / "specs/wall_align.yaml").string();
  int n = 0;
  for (const std::string& typed : {"specs/wall_align.yaml"s, "./specs//wall_align.yaml"s,
                                   "specs/robots/../wall_align.yaml"s, absolute}) {
    const std::string log = "log" + std::to_string(n++);
    const std::string robot = fs::path(typed).parent_path().string() + "/robots/omni_base.yaml";
    ASSERT_EQ(zwang({"run", typed, "--robot", robot, "--log", log, "--quiet"}).code, 0) << typed;
    EXPECT_TRUE(read(folder_ / log / "log.mcap") == read(folder_ / "log0/log.mcap")) << typed;
  }
  EXPECT_EQ(zwang({"replay", "log3/log.mcap"}).code, 0);
}

TEST_F(FromOutside, TwoRunsWithOneSeedWriteTheSameMcap) {
  for (const char* name : {"a", "b"}) {
    ASSERT_EQ(zwang({"run", specs + "docking.yaml", "--seed", "7", "--log", name, "--quiet"}).code, 0);
  }
  const std::string log = read(folder_ / "a/log.mcap");
  EXPECT_GT(log.size(), 100'000u);
  EXPECT_TRUE(log == read(folder_ / "b/log.mcap"));
}

/// A file that may not grow beyond 1 MiB is a disk that fills up under way. (The thread sanitizer writes
/// smaller ones for itself.)
TEST_F(FromOutside, AFullDiskLeavesTheRunAloneAndTheExitStatusSaysSo) {
  const std::string command = "cd " + folder_.string() +
                              " && ulimit -f 1024 && trap '' XFSZ && exec " ZWANG_PROGRAM + " run " + specs +
                              "wall_align.yaml --log log --format json > out 2> err";
  const int status = std::system(("exec bash -c \"" + command + "\"").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  const json j = json::parse(read(folder_ / "out"));
  EXPECT_EQ(j["outcome"], "done") << "control goes on";
  EXPECT_FALSE(j["log_complete"]);
  EXPECT_NE(read(folder_ / "err").find("the log is incomplete"), std::string::npos);
}

TEST_F(FromOutside, InfoReadsWellWithALongNameAndAParameter) {
  fs::copy(specs, folder_ / "specs", fs::copy_options::recursive);
  std::string task = read(folder_ / "specs/wall_align.yaml");
  for (std::size_t at; (at = task.find("push")) != std::string::npos;)
    task.replace(at, 4, "gentle_final_approach");
  write("specs/wall_align.yaml", task);
  ASSERT_EQ(
      zwang({"run", "specs/wall_align.yaml", "-p", "gentle_final_approach=21 N", "--log", "log", "--quiet"})
          .code,
      0);
  const std::string text = zwang({"info", "log/log.mcap"}).out;
  EXPECT_NE(text.find("\n  params.gentle_final_approach  21\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\n  task                          specs/wall_align.yaml\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("\n  command line                  -p gentle_final_approach=21 N\n"), std::string::npos)
      << text;
}

/// The log of the reloaded program cannot be opened: that is no reason to end the run.
TEST_F(FromOutside, AReloadWithoutAFolderForItsLogLeavesTheRunAlone) {
  const pid_t child = start_endless({"--watch"});
  fs::remove_all(folder_ / "log");
  std::string other = read(folder_ / "task.yaml");
  other.replace(other.find("100000 s, goto: failed"), 22, "0.2 s, goto: done");
  write("task.yaml", other);
  const Result r = finish(child);
  EXPECT_EQ(r.code, 2) << r.err;
  const json j = json::parse(r.out);
  EXPECT_EQ(j["outcome"], "done") << r.err;
  EXPECT_FALSE(j["log_complete"]);
  EXPECT_NE(r.err.find("the log is incomplete"), std::string::npos) << r.err;
}

/// Linux keeps a file that is open; its folder and its name are gone all the same, and so is the log.
TEST_F(FromOutside, AFolderThatIsRemovedLeavesTheRunAloneAndTheExitStatusSaysSo) {
  const pid_t child = start_endless();
  fs::remove_all(folder_ / "log");
  kill(child, SIGINT);
  const Result r = finish(child);
  EXPECT_EQ(r.code, 2);
  const json j = json::parse(r.out);
  EXPECT_EQ(j["outcome"], "stopped") << "by the signal: control went on";
  EXPECT_FALSE(j["log_complete"]);
  EXPECT_NE(r.err.find("the log is incomplete: the log is gone: log/log.mcap was removed"), std::string::npos)
      << r.err;
}

}  // namespace
}  // namespace zwang
