// The logs of a run as its user meets them: files, formats, parts, and what a log cannot do.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace zwang {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::read;
using test::Result;

const std::string shipped = std::string(ZWANG_SOURCE_DIR) + "/specs/";

/// Stands for 1.2 s, and rests for as long as every run does at its end.
constexpr const char* standing = R"(zwang: 1
robot: none.yaml
start: stand
tasks:
  stand:
    constraints: {still: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: {velocity: 0 rad/s}}}
    exits: [{when: elapsed > 1.2 s, goto: rest}]
    timeout: {after: 9 s, goto: failed}
  rest:
    constraints: {still: {move: base_link, in: base_link, x: {velocity: 0 m/s}, y: {velocity: 0 m/s}, rz: free}}
    timeout: {after: 1.2 s, goto: done}
)";

class Logs : public test::Program {
 protected:
  Result run(const std::string& folder, const std::vector<std::string>& more = {}) {
    write("task.yaml", standing);
    std::vector<std::string> words{"run",      "task.yaml",
                                   "--robot",  shipped + "robots/mecanum_base.yaml",
                                   "--scene",  shipped + "scenes/wall.yaml",
                                   "--log",    folder,
                                   "--format", "json"};
    words.insert(words.end(), more.begin(), more.end());
    return zwang(words);
  }
  json told(const std::vector<std::string>& words) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--format", "json"});
    return json::parse(zwang(all).out, nullptr, false);
  }
  static std::ptrdiff_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }
};

TEST_F(Logs, AreCsvOnRequestDuringTheRunOrAfterIt) {
  const Result made = run("a", {"--csv"});
  ASSERT_EQ(made.code, 0) << made.err;
  const std::string csv = read(folder_ / "a/log.csv");
  EXPECT_EQ(csv.substr(0, 14), "time [s],task,");
  EXPECT_GT(lines(csv), 2400);
  EXPECT_EQ(zwang({"log", "a"}).out, csv);
  EXPECT_EQ(zwang({"log", "a/log.mcap", "--csv", "-o", "b.csv"}).code, 0);
  EXPECT_EQ(read(folder_ / "b.csv"), csv);
  EXPECT_EQ(zwang({"log", "none"}).code, 2);
  // A run into the same folder leaves no CSV of another run.
  ASSERT_EQ(run("a").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "a/log.csv"));
}

/// zwang of before 2026-11-26 wrote both of them in one run.
TEST_F(Logs, OfJsonRecordsAreReadAsBefore) {
  const std::string logs = std::string(ZWANG_SOURCE_DIR) + "/tests/runtime/logs/";
  EXPECT_EQ(zwang({"log", logs + "before_blocks.mcap"}).out, read(logs + "before_blocks.csv"));
  const json info = told({"info", logs + "before_blocks.mcap"});
  EXPECT_EQ(info["records"], 23);
  EXPECT_EQ(info["tasks"].size(), 3u);
  EXPECT_EQ(info["tasks"][1]["task"], "hold");
}

TEST_F(Logs, InPartsOpenOneByOneAndTogether) {
  ASSERT_EQ(run("whole").code, 0);
  const Result made = run("parts", {"--log-rotate", "1 s"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(json::parse(made.out)["log"], "parts/log_0.mcap");
  std::uint64_t records = 0;
  for (const char* part : {"parts/log_0.mcap", "parts/log_1.mcap", "parts/log_2.mcap"}) {
    const json info = told({"info", part});
    EXPECT_TRUE(info["whole"]) << part;
    EXPECT_FALSE(info["files"].empty()) << part;
    EXPECT_LE(info["end"].get<double>() - info["begin"].get<double>(), 1.0) << part;
    records += info["records"].get<std::uint64_t>();
  }
  EXPECT_FALSE(fs::exists(folder_ / "parts/log_3.mcap"));
  const json whole = told({"info", "whole"}), together = told({"info", "parts"});
  EXPECT_EQ(whole["records"], records);
  for (const char* fact : {"whole", "records", "begin", "end", "outcome", "tasks", "files"})
    EXPECT_EQ(whole[fact], together[fact]) << fact;
  EXPECT_EQ(zwang({"log", "parts"}).out, zwang({"log", "whole"}).out);
  const json replayed = told({"replay", "parts"});
  EXPECT_EQ(replayed["records"], records);
  EXPECT_EQ(replayed["equal"], records);
  EXPECT_EQ(told({"replay", "parts/log_1.mcap"})["equal"], 2000) << "from the begin of the run on";
}

TEST_F(Logs, TellWhichPartIsMissing) {
  ASSERT_EQ(run("parts", {"--log-rotate", "1 s"}).code, 0);
  fs::rename(folder_ / "parts/log_1.mcap", folder_ / "log_1.mcap");
  const json info = told({"info", "parts"});
  EXPECT_FALSE(info["whole"]);
  EXPECT_EQ(info["damage"], json::array({"log_1.mcap is missing"}));
  const Result again = zwang({"replay", "parts"});
  EXPECT_EQ(again.code, 2);
  EXPECT_NE(again.err.find("parts/log_1.mcap, which is not there"), std::string::npos) << again.err;
}

/// Whatever the form, the folder holds the log of one run.
TEST_F(Logs, OfARunBeforeAreGone) {
  ASSERT_EQ(run("log", {"--log-rotate", "1 s"}).code, 0);
  ASSERT_TRUE(fs::exists(folder_ / "log/log_2.mcap"));
  const Result again = run("log");
  EXPECT_NE(again.err.find("written over"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "log/log_0.mcap"));
  ASSERT_EQ(run("log", {"--log-rotate", "2 s", "--log-rotate", "1 GB"}).code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "log/log.mcap"));
  EXPECT_TRUE(fs::exists(folder_ / "log/log_1.mcap"));
  EXPECT_FALSE(fs::exists(folder_ / "log/log_2.mcap"));
  EXPECT_TRUE(told({"info", "log"})["whole"]);
}

/// A result replaces neither a file that a user wrote nor one that took hours.
TEST_F(Logs, AndFilesThatAreReadAreNotWrittenOver) {
  ASSERT_EQ(run("a").code, 0);
  write("scenario.yaml", "zwang_scenario: 1\ntask: task.yaml\nexpect: [{outcome: done}]\n");
  const std::string log = read(folder_ / "a/log.mcap"), scenario = read(folder_ / "scenario.yaml");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"log", "a", "-o", "a/log.mcap"},
                                                {"report", "a", "-o", "a/log.mcap"},
                                                {"test", "scenario.yaml", "--junit", "scenario.yaml"},
                                                {"test", "scenario.yaml", "--report", "-o", "task.yaml"}}) {
    const Result refused = zwang(words);
    EXPECT_EQ(refused.code, 2) << refused.out;
    EXPECT_NE(refused.err.find("would be written over"), std::string::npos) << refused.err;
  }
  EXPECT_EQ(read(folder_ / "a/log.mcap"), log);
  EXPECT_EQ(read(folder_ / "scenario.yaml"), scenario);
  EXPECT_EQ(read(folder_ / "task.yaml"), standing);
  const Result early = zwang({"test", "scenario.yaml", "--junit", "absent/junit.xml"});
  EXPECT_EQ(early.code, 2);
  EXPECT_EQ(early.out, "");
}

TEST_F(Logs, WithARateHaveFewRecordsAndEverySwitch) {
  ASSERT_EQ(run("whole").code, 0);
  ASSERT_EQ(run("few", {"--log-rate", "50"}).code, 0);
  const json whole = told({"info", "whole"}), few = told({"info", "few"});
  EXPECT_TRUE(few["whole"]);
  EXPECT_EQ(whole["tasks"], few["tasks"]) << "to the tick";
  EXPECT_EQ(whole["end"], few["end"]) << "the last record is there";
  const double most = 50.0 * few["end"].get<double>() + 1.0 + 4.0;  // the first one; switches and the end
  EXPECT_LE(few["records"].get<double>(), most);
  EXPECT_GE(few["records"].get<double>(), most - 5.0);
  const Result again = zwang({"replay", "few"});
  EXPECT_EQ(again.code, 2);
  EXPECT_NE(again.err.find("--log-rate 50, and a replay needs the record of each tick"), std::string::npos)
      << again.err;
}

TEST_F(Logs, OnAFullDiskACsvIsNotLeftHalf) {
  ASSERT_EQ(run("a").code, 0);
  write("kept.csv", "as it was");
  for (const char* file : {"new.csv", "kept.csv"}) {
    const test::FullDisk full(4096);
    const Result refused = zwang({"log", "a", "-o", file});
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("cannot be written: "), std::string::npos) << refused.err;
  }
  EXPECT_FALSE(fs::exists(folder_ / "new.csv"));
  EXPECT_EQ(read(folder_ / "kept.csv"), "as it was");
  EXPECT_FALSE(fs::exists(folder_ / "new.csv.part"));
}

// The records of a run whose samples stay away repeat the time of the last one.
TEST_F(Logs, InfoTellsEventsAtTheTimesOfTheReport) {
  write("scene.yaml", "zwang_scene: 1\nfaults: [{at: 0.5 s, samples: lost}]\n");
  write("task.yaml", standing);
  const Result stopped = zwang({"run", "task.yaml", "--robot", shipped + "robots/mecanum_base.yaml",
                                "--scene", "scene.yaml", "--log", "a", "--format", "json"});
  EXPECT_EQ(stopped.code, 1) << stopped.err;
  const json report = json::parse(stopped.out, nullptr, false), log = told({"info", "a"});
  ASSERT_GT(report["events"].size(), 1u);
  ASSERT_EQ(log["events"].size(), report["events"].size());
  for (std::size_t i = 0; i < report["events"].size(); ++i) {
    EXPECT_EQ(log["events"][i]["time"], report["events"][i]["time"]);
    EXPECT_EQ(log["events"][i]["code"], report["events"][i]["code"]);
  }
  EXPECT_GT(log["events"].back()["time"], log["end"]);
}

TEST_F(Logs, RefuseLimitsThatAreNone) {
  for (const char* limit : {"soon", "5", "0.5 s", "10 kB", "1 GB/s", "nan s"}) {
    const Result refused = run("log", {"--log-rotate", limit});
    EXPECT_EQ(refused.code, 2) << limit;
    EXPECT_NE(refused.err.find("write it as `500 MB` or `10 min`"), std::string::npos) << refused.err;
  }
  EXPECT_EQ(run("log", {"--log-rate", "0"}).code, 2);
  EXPECT_FALSE(fs::exists(folder_ / "log"));
}

}  // namespace
}  // namespace zwang
