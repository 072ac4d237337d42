// What a run writes into its log: one record a tick, each row's wish and what it misses.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "../temporary_folder.hpp"
#include "runner_loop.hpp"

namespace zwang::runtime {
namespace {

using namespace test;

std::string log_of_a_run(const std::filesystem::path& path) {
  RunnerSettings settings;
  settings.extra_columns = {{"truth.x", "m", {}}};
  Loop loop(errand(), settings);
  {
    Recorder recorder(path, loop.runner.columns());
    loop.runner.record_to(&recorder);
    while (!loop.runner.finished() && loop.base.time < 20) {
      recorder.wait_for_room();
      loop.base.sense(loop.sensed);
      const double truth[] = {loop.base.pose.x()};
      loop.base.step(loop.runner.step(loop.sensed, truth));
    }
    recorder.close();
    EXPECT_TRUE(recorder.status().complete());
  }
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::stringstream in(line + ",");
  for (std::string cell; std::getline(in, cell, ',');) out.push_back(cell);
  return out;
}

TEST(Runner, TwoRunsHaveTheSameLogToTheByte) {
  const zwang::test::TemporaryFolder folder;
  const std::string first = log_of_a_run(folder.path() / "a.csv");
  EXPECT_GT(first.size(), 100'000u);
  EXPECT_EQ(first, log_of_a_run(folder.path() / "b.csv"));
}

TEST(Runner, TheLogHasOneRecordATickAndBlanksWhatIsNotInForce) {
  const zwang::test::TemporaryFolder folder;
  std::istringstream log(log_of_a_run(folder.path() / "run.csv"));
  std::string line;
  std::getline(log, line);
  const std::vector<std::string> names = cells(line);
  const auto column = [&names](const std::string& name) {
    const auto it = std::find(names.begin(), names.end(), name);
    EXPECT_NE(it, names.end()) << name;
    return static_cast<std::size_t>(it - names.begin());
  };
  const std::size_t time = column("time [s]"), task_name = column("task"), x = column("base.x [m]"),
                    go = column("go.go.x.nu [N]"), push = column("push.go.x.nu [N]"),
                    timer = column("go.exit1.true_for [s]"), truth = column("truth.x [m]");
  column("front_left_wheel.tau [N m]");
  column("go.go.x.b [m/s^2]");
  column("push.go.x.f [N]");
  column("stop.rz.alpha");
  int records = 0, switched = -1;
  double largest_timer = 0.0;
  while (std::getline(log, line)) {
    const std::vector<std::string> record = cells(line);
    ASSERT_EQ(record.size(), names.size());
    EXPECT_NEAR(std::stod(record[time]), records * period, 1e-8);
    EXPECT_EQ(record[x], record[truth]);
    if (record[task_name] == "go") {
      EXPECT_TRUE(record[push].empty());
      EXPECT_FALSE(record[go].empty());
      largest_timer = std::max(largest_timer, std::stod(record[timer]));
    } else if (switched < 0) {
      switched = records;
    } else if (record[task_name] == "push" && records > switched + 100) {
      EXPECT_TRUE(record[go].empty()) << "it has faded";
      EXPECT_NEAR(std::stod(record[push]), 10.0, 1e-6);
    }
    ++records;
  }
  EXPECT_NEAR(largest_timer, 0.009, 1e-9) << "ten ticks, the tenth of which switches";
  EXPECT_GT(records, 1000);
}

// The demand of `go.x` is cut to 0.5 m/s^2 until its speed is near the range's end. While its set has the
// share alpha, the share 1 - alpha of b is missing.
TEST(Runner, TheLogHasWhatARowAsksForAndWhatItMisses) {
  const zwang::test::TemporaryFolder folder;
  std::istringstream log(log_of_a_run(folder.path() / "run.csv"));
  std::string line;
  std::getline(log, line);
  const std::vector<std::string> names = cells(line);
  const auto column = [&names](const std::string& name) {
    const auto it = std::find(names.begin(), names.end(), name);
    EXPECT_NE(it, names.end()) << name;
    return static_cast<std::size_t>(it - names.begin());
  };
  const std::size_t speed = column("base.vx [m/s]"), alpha = column("go.go.x.alpha"),
                    asked = column("go.go.x.b [m/s^2]"), missed = column("go.go.x.residual [m/s^2]");
  int records = 0;
  for (; records < 300 && std::getline(log, line); ++records) {
    const std::vector<std::string> record = cells(line);
    if (std::stod(record[speed]) > 0.19) break;
    const double share = std::min(1.0, (records + 1) * period / 0.1);
    EXPECT_NEAR(std::stod(record[alpha]), share, 1e-7) << records;
    EXPECT_NEAR(std::stod(record[asked]), 0.5, 1e-9) << records;
    EXPECT_NEAR(std::stod(record[missed]), -(1.0 - share) * 0.5, 1e-7) << records;
  }
  EXPECT_GT(records, 200);
}

/// The records of a run, each by the names of its columns.
std::vector<std::map<std::string, std::string>> records_of(const lang::Program& program, double longest) {
  const zwang::test::TemporaryFolder folder;
  const auto path = folder.path() / "run.csv";
  Loop loop(program);
  Recorder recorder(path, loop.runner.columns());
  loop.runner.record_to(&recorder);
  loop.run(longest);
  recorder.close();
  EXPECT_TRUE(recorder.status().complete());
  std::ifstream log(path);
  std::string line;
  std::getline(log, line);
  const std::vector<std::string> names = cells(line);
  std::vector<std::map<std::string, std::string>> records;
  while (std::getline(log, line)) {
    const std::vector<std::string> values = cells(line);
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (i == 0) records.emplace_back();
      records.back()[names[i]] = values.at(i);
    }
  }
  return records;
}

TEST(Runner, TheLogHasWhatSwitchedWhatElseWasTrueAndWhoRefused) {
  lang::Task a = task("a", {drive("go.x", Axis::x, Quantity::velocity, 0.0)}), b = a;
  b.name = "b";
  a.exits = {exit(after(0.003), to_done), exit(after(0.003), to_failed)};
  a.timeout = lang::Timeout{{.constant = 0.003}, to_failed, {}};
  const lang::Condition never = when(apply(Op::less, number(1.0), number(0.0)));
  b.require = never;
  lang::Program p = program({a, b});
  p.always.exits = {exit(never, to_failed), exit(after(0.002), to_task(1), 0.002),
                    exit(after(0.003), to_failed)};
  auto records = records_of(p, 0.0045);
  ASSERT_EQ(records.size(), 5u);
  EXPECT_EQ(records[0]["switch"], "start");
  EXPECT_EQ(records[0]["switch.refusal"], "none");
  EXPECT_TRUE(records[0]["switch.exit"].empty());
  EXPECT_TRUE(records[2]["switch"].empty());
  EXPECT_EQ(std::stod(records[2]["always.exit2.true_for [s]"]), 0.001);
  EXPECT_EQ(records[3]["switch"], "always");
  EXPECT_EQ(records[3]["switch.exit"], "2");
  EXPECT_EQ(std::stod(records[3]["switch.also_true.always"]), 0b100);
  EXPECT_EQ(std::stod(records[3]["switch.also_true"]), 0b111) << "both exits, and above them the timeout";
  EXPECT_EQ(records[3]["switch.refusal"], "require");
  EXPECT_EQ(records[3]["task"], "failed");
  EXPECT_EQ(std::stod(records[3]["always.exit2.true_for [s]"]), 0.002);
  EXPECT_TRUE(records[4]["switch"].empty());
}

// Two limits of 0.4 m/s^2, at two frames of one line, against a driver of 1 m/s^2.
TEST(Runner, TheLogNamesEveryRowThatHoldsAnotherOneBack) {
  lang::Program p = program({task("go", {drive("go.x", Axis::x, Quantity::acceleration, 1.0)})});
  for (const int frame : {base_link, bumper}) {
    AxisStatements slow = free_axis(frame == bumper ? "ahead.x" : "manners.x", Axis::x);
    slow.acceleration = between(-0.4, 0.4);
    slow.level = 0;
    p.always.groups.push_back(task("", {slow}, frame).groups[0]);
  }
  auto records = records_of(p, 0.0035);
  ASSERT_EQ(records.size(), 4u);
  for (auto& record : records) {
    EXPECT_EQ(record["missed"], "go.go.x");
    EXPECT_NEAR(std::stod(record["missed.by"]), 0.4 - 1.0, 1e-9);
    EXPECT_NEAR(std::stod(record["go.go.x.residual [m/s^2]"]), 0.4 - 1.0, 1e-9);
    const std::set<std::string> holders{record["missed.held_back_by"], record["missed.held_back_by.2"]};
    EXPECT_EQ(holders, (std::set<std::string>{"always.ahead.x", "always.manners.x"}));
    EXPECT_TRUE(record["missed.held_back_by.3"].empty());
  }
}

}  // namespace
}  // namespace zwang::runtime
