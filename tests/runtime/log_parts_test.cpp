// Logs of tasks that never end: fewer records and files of a bounded size, without a loss of what matters.
#include "zwang/runtime/log_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "../temporary_folder.hpp"
#include "log/blank.hpp"
#include "zwang/runtime/log_reader.hpp"

namespace zwang::runtime {
namespace {

namespace fs = std::filesystem;

const std::vector<Column> columns_with_events = {
    {"time", "s", {}}, {"task", "", {"go", "stay"}}, {"event", "", {"none", "slip"}}, {"noise", "", {}}};

std::unique_ptr<LogSink> rotating(const fs::path& folder, const LogRotation& rotation) {
  return rotating_sink(folder, "log", rotation,
                       [](const fs::path& path, const std::map<std::string, std::string>& facts) {
                         return mcap_sink(path, {{}, facts});
                       });
}

/// Bits that no packing makes fewer.
double noise_at(int i) {
  return std::fmod(std::sin(12.9898 * i) * 43758.5453, 1.0);
}

void write_ticks(LogSink& sink, int begin, int end) {
  for (int i = begin; i < end; ++i)
    ASSERT_EQ(sink.write(std::vector{1e-3 * i, 0.0, log_column::blank, noise_at(i)}), "");
}

TEST(LogParts, HoldEveryRecordOnce) {
  const test::TemporaryFolder folder;
  const auto sink = rotating(folder.path(), {.seconds = 1.0, .bytes = {}});
  ASSERT_EQ(sink->open(columns_with_events), "");
  write_ticks(*sink, 0, 3500);
  EXPECT_EQ(sink->conclude({{"outcome", "done"}}), "");
  EXPECT_EQ(sink->close(), "");
  EXPECT_EQ(log_files(folder.path()).size(), 4u);
  int next = 0;
  const LogContents log = read_log(folder.path(), [&](double time, std::span<const double> values) {
    EXPECT_EQ(time, 1e-3 * next);
    EXPECT_EQ(values[3], noise_at(next));
    ++next;
  });
  EXPECT_EQ(log.records, 3500u);
  EXPECT_TRUE(log.closed && log.damage.empty());
  EXPECT_EQ(log.conclusion.at("outcome"), "done");
  const LogContents second = read_log(folder.path() / "log_1.mcap", [](double, std::span<const double>) {});
  EXPECT_EQ(second.records, 1000u);
  EXPECT_EQ(second.begin, 1.0);
  EXPECT_EQ(second.context.facts.at(continues_fact), "log_0.mcap");
  EXPECT_EQ(second.context.facts.at(part_fact), "1");
}

TEST(LogParts, EndAtTheirSize) {
  const test::TemporaryFolder folder;
  constexpr std::uint64_t most = 50'000;
  const auto sink = rotating(folder.path(), {.seconds = {}, .bytes = most});
  ASSERT_EQ(sink->open(columns_with_events), "");
  write_ticks(*sink, 0, 40'000);
  ASSERT_EQ(sink->close(), "");
  const std::vector<fs::path> parts = log_files(folder.path());
  ASSERT_GT(parts.size(), 4u);
  std::uint64_t on_disk = 0;
  for (const fs::path& part : parts) {
    on_disk += fs::file_size(part);
    // The chunk that goes beyond it, and the summary with an index of each chunk.
    EXPECT_LT(fs::file_size(part), most * 5 / 4) << part;
    if (part != parts.back()) {
      EXPECT_GE(fs::file_size(part), most) << part;
    }
  }
  EXPECT_EQ(sink->size(), on_disk);
  EXPECT_EQ(read_log(folder.path(), [](double, std::span<const double>) {}).records, 40'000u);
}

/// A robot is switched off: what was closed before is whole, the last file to its last chunk.
TEST(LogParts, AreReadWhereTheLastOneWasCut) {
  const test::TemporaryFolder folder;
  const auto sink = rotating(folder.path(), {.seconds = 1.0, .bytes = {}});
  ASSERT_EQ(sink->open(columns_with_events), "");
  write_ticks(*sink, 0, 2600);
  const LogContents log = read_log(folder.path(), [](double, std::span<const double>) {});
  EXPECT_GE(log.records, 2500u);
  EXPECT_FALSE(log.closed);
  ASSERT_EQ(log.damage.size(), 1u);
  EXPECT_EQ(log.damage[0].find("log_2.mcap: "), 0u) << log.damage[0];
  ASSERT_EQ(sink->close(), "");
}

TEST(LogParts, TellOfAFolderThatIsGone) {
  const test::TemporaryFolder folder;
  const fs::path inside = folder.path() / "inside";
  fs::create_directory(inside);
  const auto sink = rotating(inside, {.seconds = 1.0, .bytes = {}});
  ASSERT_EQ(sink->open(columns_with_events), "");
  write_ticks(*sink, 0, 1000);
  fs::remove_all(inside);
  const std::string error = sink->write(std::vector{1.0, 0.0, log_column::blank, 0.0});
  EXPECT_NE(error.find("log_0.mcap was removed while it was written"), std::string::npos) << error;
  sink->close();
}

TEST(LogParts, OfARunThatIsUnderWayStay) {
  const test::TemporaryFolder folder;
  const auto sink = mcap_sink(folder.path() / "log.mcap", {});
  ASSERT_EQ(sink->open(columns_with_events), "");
  EXPECT_NE(remove_log(folder.path(), "log").find("another run writes this log"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder.path() / "log.mcap"));
  ASSERT_EQ(sink->close(), "");
  std::ofstream(folder.path() / "log_final.mcap") << "of somebody else";
  EXPECT_EQ(remove_log(folder.path(), "log"), "");
  EXPECT_FALSE(fs::exists(folder.path() / "log.mcap"));
  EXPECT_TRUE(fs::exists(folder.path() / "log_final.mcap"));
}

/// The first parts of a run that still writes have no lock any more.
TEST(LogParts, OfARunThatWritesItsLastOneStay) {
  const test::TemporaryFolder folder;
  const auto sink = rotating(folder.path(), {.seconds = 1.0, .bytes = {}});
  ASSERT_EQ(sink->open(columns_with_events), "");
  write_ticks(*sink, 0, 2500);
  EXPECT_NE(remove_log(folder.path(), "log").find("another run writes this log"), std::string::npos);
  EXPECT_EQ(log_files(folder.path()).size(), 3u);
  EXPECT_EQ(sink->close(), "");
}

TEST(LogParts, AreNotWrittenOverWhatIsNoLog) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "log.mcap") << "zwang: 1\n";
  const auto sink = mcap_sink(folder.path() / "log.mcap", {});
  EXPECT_NE(sink->open(columns_with_events).find("is no log, and would be lost"), std::string::npos);
  EXPECT_EQ(fs::file_size(folder.path() / "log.mcap"), 9u);
}

TEST(LogRate, KeepsSwitchesEventsAndTheEnd) {
  const test::TemporaryFolder folder;
  const auto sink = thinned_sink(mcap_sink(folder.path() / "log.mcap", {}), 10.0);
  ASSERT_EQ(sink->open(columns_with_events), "");
  for (int i = 0; i < 1000; ++i)
    ASSERT_EQ(
        sink->write(std::vector{1e-3 * i, i < 333 ? 0.0 : 1.0, i == 777 ? 1.0 : log_column::blank, 0.0}), "");
  ASSERT_EQ(sink->close(), "");
  std::vector<int> kept;
  const LogContents log = read_log(folder.path() / "log.mcap", [&](double time, std::span<const double>) {
    kept.push_back(static_cast<int>(std::lround(1e3 * time)));
  });
  EXPECT_EQ(kept, (std::vector{0, 100, 200, 300, 333, 400, 500, 600, 700, 777, 800, 900, 999}));
  EXPECT_TRUE(log.damage.empty()) << "nothing was dropped";
}

TEST(LogRotation, IsReadWithItsUnit) {
  LogRotation rotation;
  EXPECT_TRUE(read_rotation("2 GB", rotation));
  EXPECT_TRUE(read_rotation("1.5min", rotation));
  EXPECT_EQ(rotation.bytes, 2'000'000'000u);
  EXPECT_EQ(rotation.seconds, 90.0);
  for (const char* none : {"", "GB", "2", "2 gb", "2 GB ", "1e99 h", "inf s"})
    EXPECT_FALSE(read_rotation(none, rotation)) << none;
}

}  // namespace
}  // namespace zwang::runtime
