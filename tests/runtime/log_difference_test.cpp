// Where two logs part: the first difference is found bit by bit, however long and how fast the logs are.
#include "zwang/runtime/log_difference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "../temporary_folder.hpp"
#include "log/blank.hpp"
#include "zwang/runtime/recorder.hpp"

namespace zwang::runtime {
namespace {

namespace fs = std::filesystem;

/// The values of a log at the time `t` [s] of its run.
struct Values {
  double speed = 0.0;    ///< computed
  double encoder = 0.0;  ///< sensed
  double task = 0.0;     ///< a word
  double extra = log_column::blank;
};

struct Made {
  double period = 1e-3, begin = 0.0;  ///< [s]
  int records = 1000;
  std::string extra_name = "extra";
  std::function<Values(double)> at = [](double t) { return Values{std::sin(t), std::cos(t)}; };
};

class Logs : public testing::Test {
 protected:
  fs::path log(const std::string& name, const Made& made) {
    const std::vector<Column> columns{{"time", "s", {}},       {"task", "", {"go", "stop"}},
                                      {"speed", "m/s", {}},    {made.extra_name, "N", {}},
                                      {"sensed.time", "", {}}, {"sensed.wheel.q", "", {}}};
    LogContext context;
    context.facts["period [s]"] = std::to_string(made.period);
    std::vector<std::unique_ptr<LogSink>> sinks;
    sinks.push_back(mcap_sink(folder_.path() / name, context));
    Recorder recorder(std::move(sinks), columns);
    for (int i = 0; i < made.records; ++i) {
      const double t = made.period * i;
      const Values v = made.at(t);
      recorder.wait_for_room();
      recorder.record(std::vector{made.begin + t, v.task, v.speed, v.extra, made.begin + t, v.encoder});
    }
    recorder.close();
    return folder_.path() / name;
  }
  test::TemporaryFolder folder_;
};

TEST_F(Logs, OfTheSameRunHaveNoDifference) {
  const LogDifference same = difference(log("a", {}), log("b", {}));
  EXPECT_EQ(same.compared, 1000u);
  EXPECT_NEAR(same.until, 0.999, 1e-9);
  EXPECT_TRUE(same.columns.empty());
  EXPECT_TRUE(same.only_first.empty());
}

TEST_F(Logs, PartAtTheFirstBitThatDiffers) {
  Made other;
  other.at = [](double t) {
    Values v{std::sin(t), std::cos(t)};
    if (t > 0.4995) v.encoder = std::nextafter(v.encoder, 2.0);
    if (t > 0.4995) v.speed += 1e-3 * (t - 0.4);
    if (t > 0.8995) v.task = 1.0;
    return v;
  };
  const LogDifference found = difference(log("a", {}), log("b", other));
  ASSERT_EQ(found.columns.size(), 3u);
  // In one record the input comes first: what is computed follows from it.
  EXPECT_EQ(found.columns[0].name, "sensed.wheel.q");
  EXPECT_TRUE(found.columns[0].is_input);
  EXPECT_NEAR(found.columns[0].time, 0.5, 1e-9);
  EXPECT_NE(found.columns[0].first, found.columns[0].second) << "every digit is told";
  EXPECT_EQ(std::stod(found.columns[0].second), std::nextafter(std::stod(found.columns[0].first), 2.0));
  EXPECT_EQ(found.columns[0].records, 500u);
  EXPECT_EQ(found.columns[1].name, "speed");
  EXPECT_EQ(found.columns[1].unit, "m/s");
  EXPECT_FALSE(found.columns[1].is_input);
  ASSERT_TRUE(found.columns[1].largest);
  EXPECT_NEAR(*found.columns[1].largest, 1e-3 * 0.599, 1e-12);
  EXPECT_NEAR(found.columns[1].largest_time, 0.999, 1e-9);
  EXPECT_EQ(found.columns[2].name, "task");
  EXPECT_NEAR(found.columns[2].time, 0.9, 1e-9);
  EXPECT_EQ(found.columns[2].first, "go");
  EXPECT_EQ(found.columns[2].second, "stop");
  EXPECT_FALSE(found.columns[2].largest) << "words have no distance";
}

TEST_F(Logs, OfUnlikeLengthsAndRatesAreComparedWhereBothHaveARecord) {
  Made slow;
  slow.period = 4e-3;
  slow.records = 100;
  const LogDifference same = difference(log("a", {}), log("b", slow));
  EXPECT_EQ(same.compared, 100u);
  EXPECT_NEAR(same.until, 0.396, 1e-9);
  EXPECT_TRUE(same.columns.empty()) << same.columns.front().name;
  // 1 ms and 1.5 ms meet every 3 ms; between them records lie half a period apart and are no pairs.
  Made odd;
  odd.period = 1.5e-3;
  odd.records = 600;
  EXPECT_EQ(difference(log("a", {}), log("c", odd)).compared, 300u);
}

TEST_F(Logs, ClocksCountFromTheBeginOfTheirRun) {
  Made later;
  later.begin = 1024.0;  // exact in binary, as are the differences to a nanosecond
  const LogDifference same = difference(log("a", {}), log("b", later));
  EXPECT_EQ(same.compared, 1000u);
  EXPECT_TRUE(same.columns.empty()) << same.columns.front().name;
}

TEST_F(Logs, ABlankDiffersFromANumberAndColumnsOfOneLogAreTold) {
  Made other;
  other.at = [](double t) {
    return Values{std::sin(t), std::cos(t), 0.0, t > 0.1995 ? 0.0 : log_column::blank};
  };
  const LogDifference found = difference(log("a", {}), log("b", other));
  ASSERT_EQ(found.columns.size(), 1u);
  EXPECT_EQ(found.columns[0].name, "extra");
  EXPECT_NEAR(found.columns[0].time, 0.2, 1e-9);
  EXPECT_EQ(found.columns[0].first, "");
  EXPECT_EQ(found.columns[0].second, "0");
  Made renamed;
  renamed.extra_name = "other";
  const LogDifference unlike = difference(log("a", {}), log("c", renamed));
  EXPECT_EQ(unlike.only_first, std::vector<std::string>{"extra"});
  EXPECT_EQ(unlike.only_second, std::vector<std::string>{"other"});
}

TEST_F(Logs, ThatAreCutAreComparedAsFarAsTheyGo) {
  Made many;
  many.records = 60'000;  // more than one chunk of the file
  const fs::path whole = log("a", many), cut = log("b", many);
  fs::resize_file(cut, fs::file_size(cut) / 2);
  const LogDifference found = difference(whole, cut);
  EXPECT_TRUE(found.columns.empty());
  EXPECT_FALSE(found.second.damage.empty());
  EXPECT_EQ(found.compared, found.second.records);
  EXPECT_GT(found.compared, 0u);
  EXPECT_LT(found.compared, 60'000u);
}

TEST(Happenings, DifferInTimeInKindAndInNumber) {
  const std::vector<Happening> all{{0.0, "start -> press"}, {2.0, "press -> hold"}, {4.0, "hold -> done"}};
  std::vector<Happening> other = all;
  EXPECT_FALSE(first_difference(all, other, 1e-3));
  other[1].time += 0.5e-3;
  EXPECT_FALSE(first_difference(all, other, 1e-3));
  other[1].time += 1e-3;
  EXPECT_EQ(first_difference(all, other, 1e-3), 1u);
  other = all;
  other[2].what = "hold -> failed";
  EXPECT_EQ(first_difference(all, other, 1e-3), 2u);
  other.pop_back();
  EXPECT_EQ(first_difference(all, other, 1e-3), 2u);
  EXPECT_EQ(first_difference({}, all, 1e-3), 0u);
}

}  // namespace
}  // namespace zwang::runtime
