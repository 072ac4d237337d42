// A log as curves: however few the points, no extreme is lost.
#include "zwang/runtime/series.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "../temporary_folder.hpp"
#include "log/blank.hpp"
#include "log/extremes.hpp"
#include "zwang/runtime/recorder.hpp"

namespace zwang::runtime {
namespace {

TEST(Extremes, OfMergedBucketsAreThoseOfAllValuesInTheirOrder) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  for (int round = 0; round < 200; ++round) {
    const std::size_t count = 1 + random() % 64;
    std::vector<float> values;
    std::vector<Bucket> buckets;
    for (std::size_t i = 0; i < count; ++i) {
      values.push_back(random() % 4 == 0 ? std::numeric_limits<float>::quiet_NaN() : normal(random));
      Bucket& bucket = buckets.emplace_back();
      bucket.first = values.back();
      bucket.take(values.back());
    }
    while (buckets.size() > 1) merge_pairs(buckets);
    std::vector<float> known;
    std::ranges::copy_if(values, std::back_inserter(known), [](float v) { return !std::isnan(v); });
    const Bucket& all = buckets.front();
    EXPECT_EQ(std::isnan(all.first), std::isnan(values.front()));
    if (known.empty()) {
      EXPECT_TRUE(std::isnan(all.least));
      continue;
    }
    const auto [least, largest] = std::ranges::minmax_element(known);
    EXPECT_EQ(all.least, *least);
    EXPECT_EQ(all.largest, *largest);
    if (known.size() > 1) {
      EXPECT_EQ(all.least_came_first, least < largest) << round;
    }
  }
}

struct Log {
  explicit Log(int records) {
    std::vector<Column> columns{{"time", "s", {}},
                                {"task", "", {"go", "stop"}},
                                {"event", "", {"none", "slip"}},
                                {"event.signal", "", {"time"}},
                                {"event.value", "", {}},
                                {"speed", "m/s", {}}};
    columns.back().span = {0, {7, 3}, {7, 9}};
    for (int i = 0; i < 40; ++i) columns.push_back({"other" + std::to_string(i), "", {}});
    columns.push_back({"sensed.q", "", {}});
    LogContext context;
    context.sources.push_back({path.string() + "/task.yaml", "text"});
    std::vector<std::unique_ptr<LogSink>> sinks;
    sinks.push_back(mcap_sink(path / "log.mcap", context));
    Recorder recorder(std::move(sinks), columns);
    std::vector<double> values(columns.size(), 0.5);
    for (int i = 0; i < records; ++i) {
      values[0] = 1e-3 * i;
      values[1] = i < records / 4 ? 0 : 1;
      values[2] = values[3] = values[4] = log_column::blank;
      if (i == 700) std::ranges::copy(std::array{1.0, 0.0, 0.25}, values.begin() + 2);
      values[5] = i == 1234 ? 9.0 : i == 1235 ? -8.0 : std::sin(1e-3 * i);
      if (i % 10 == 3) values[5] = log_column::blank;
      recorder.wait_for_room();
      recorder.record(values);
    }
    recorder.conclude({{"outcome", "done"}});
    recorder.close();
  }
  test::TemporaryFolder folder;
  std::filesystem::path path = folder.path();
};

const Curve& curve(const Series& series, const std::string& name) {
  const auto found = std::ranges::find(series.curves, name, &Curve::name);
  EXPECT_NE(found, series.curves.end()) << name;
  return *found;
}

TEST(Series, HasEveryExtremeInFewPoints) {
  const Log log(20'000);
  const Series series = read_series(log.path / "log.mcap", 10'000);
  EXPECT_EQ(series.log.records, 20'000u);
  EXPECT_LE(series.times.size(), 512u);
  EXPECT_GE(series.times.size(), 256u);
  EXPECT_TRUE(std::ranges::is_sorted(series.times));
  const Curve& speed = curve(series, "speed");
  ASSERT_EQ(speed.points.size(), series.times.size());
  ASSERT_EQ(speed.samples.size(), series.sample_times.size());
  const auto largest = std::ranges::max_element(speed.points), least = std::ranges::min_element(speed.points);
  EXPECT_EQ(*largest, 9.0F);
  EXPECT_EQ(*least, -8.0F);
  EXPECT_EQ(least - largest, 1) << "the peak came first";
  const double bucket = 1e-3 * static_cast<double>(series.records_a_bucket);
  EXPECT_NEAR(series.times[static_cast<std::size_t>(largest - speed.points.begin())], 1.234, bucket);
  for (std::size_t i = 0; i < speed.samples.size(); ++i) {
    if (std::isnan(speed.samples[i])) continue;
    EXPECT_NEAR(speed.samples[i], std::sin(series.sample_times[i]), 1e-6) << "a sample is a record";
  }
}

TEST(Series, TellsTasksEventsUnitsAndLines) {
  const Log log(2'000);
  const Series series = read_series(log.path / "log.mcap", 1'000'000);
  EXPECT_EQ(series.records_a_bucket, 1u);
  EXPECT_EQ(series.times.size(), 2'000u);
  ASSERT_EQ(series.tasks.size(), 2u);
  EXPECT_EQ(series.tasks[0].word, "go");
  EXPECT_NEAR(series.tasks[0].end, 0.5, 1e-9);
  EXPECT_NEAR(series.tasks[1].begin, 0.5, 1e-9);
  EXPECT_NEAR(series.tasks[1].end, 1.999, 1e-9);
  ASSERT_EQ(series.events.size(), 1u);
  EXPECT_EQ(series.events[0].code, "slip");
  EXPECT_EQ(series.events[0].signal, "time");
  EXPECT_EQ(series.events[0].value, 0.25);
  EXPECT_NEAR(series.events[0].time, 0.7, 1e-9);
  const Curve& speed = curve(series, "speed");
  EXPECT_EQ(speed.unit, "m/s");
  EXPECT_EQ(speed.line, 7);
  EXPECT_TRUE(speed.file.ends_with("task.yaml")) << speed.file;
  EXPECT_TRUE(std::isnan(speed.points[3]));
  EXPECT_EQ(series.log.conclusion.at("outcome"), "done");
  EXPECT_EQ(std::ranges::count(series.curves, "sensed.q", &Curve::name), 0);
}

}  // namespace
}  // namespace zwang::runtime
