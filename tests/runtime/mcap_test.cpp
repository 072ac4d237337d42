// The MCAP log: every number comes back bit by bit. If the file is damaged, the reader gets the whole parts
// and names the damaged ones.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <span>
#include <sstream>
#include <stdexcept>

#include "../is_long.hpp"
#include "../temporary_folder.hpp"
#include "constants.hpp"
#include "zwang/runtime/log_reader.hpp"
#include "zwang/runtime/recorder.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace zwang::runtime {
namespace {

constexpr std::size_t stride = 7;                 // [bytes], prime to the lengths of fields
constexpr std::uint64_t records_in_a_chunk = 75;  // 75 ms

struct Folder {
  zwang::test::TemporaryFolder temporary;
  std::filesystem::path path = temporary.path();
};

const std::vector<Column> columns = {
    {"time", "s", {}}, {"task", "", {"press", "hold"}}, {"a \"b\"", "N", {}, {0, {7, 1}, {7, 5}}}};

LogContext context() {
  return {{{"task.yaml", "zwang: 1\n"}, {"robot.urdf", "<robot/>"}}, {{"seed", "42"}}};
}

std::filesystem::path write_log(const Folder& folder, const std::vector<std::vector<double>>& records) {
  const std::filesystem::path path = folder.path / "log.mcap";
  std::vector<std::unique_ptr<LogSink>> sinks;
  sinks.push_back(mcap_sink(path, context()));
  Recorder recorder(std::move(sinks), columns, 64);
  for (const std::vector<double>& record : records) {
    recorder.wait_for_room();
    EXPECT_TRUE(recorder.record(record));
  }
  recorder.close();
  EXPECT_TRUE(recorder.status().complete()) << recorder.status().error;
  return path;
}

std::vector<std::vector<double>> ramp(int count) {
  std::vector<std::vector<double>> records;
  for (int i = 0; i < count; ++i) records.push_back({i * period, i < count / 2 ? 0.0 : 1.0, i * 0.1});
  return records;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put_bytes(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

LogContents read(const std::filesystem::path& path, std::vector<std::vector<double>>* records = nullptr) {
  return read_log(path, [records](double, std::span<const double> values) {
    if (records != nullptr) records->emplace_back(values.begin(), values.end());
  });
}

/// Each bit of a double may be any: a blank, an infinity and a zero with a sign come back as they were.
TEST(McapLog, NumbersComeBackBitByBit) {
  std::vector<double> awkward = {0.1,
                                 -0.0,
                                 5e-324,
                                 -std::numeric_limits<double>::max(),
                                 std::numeric_limits<double>::quiet_NaN(),
                                 -std::numeric_limits<double>::infinity(),
                                 std::nextafter(1.0, 2.0)};
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) awkward.push_back(std::bit_cast<double>(random()));
  std::vector<std::vector<double>> records;
  for (std::size_t i = 0; i < awkward.size(); ++i) records.push_back({double(i) * period, 0.0, awkward[i]});
  const Folder folder;
  std::vector<std::vector<double>> found;
  const LogContents log = read(write_log(folder, records), &found);
  ASSERT_EQ(found.size(), awkward.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_EQ(std::memcmp(found[i].data(), records[i].data(), 3 * sizeof(double)), 0) << i;
  EXPECT_TRUE(log.closed);
  EXPECT_TRUE(log.damage.empty());
  EXPECT_DOUBLE_EQ(log.end, double(awkward.size() - 1) * period);
}

TEST(McapLog, HoldsTheFilesTheFactsAndTheLinesThatColumnsComeFrom) {
  const Folder folder;
  const LogContents log = read(write_log(folder, ramp(10)));
  ASSERT_EQ(log.context.sources.size(), 2u);
  EXPECT_EQ(log.context.sources[0].path, "task.yaml");
  EXPECT_EQ(log.context.sources[0].text, "zwang: 1\n");
  EXPECT_EQ(log.context.sources[1].text, "<robot/>");
  EXPECT_EQ(log.context.facts, context().facts);
  EXPECT_NE(log.schema.find("[N] task.yaml:7"), std::string::npos) << log.schema;
}

TEST(McapLog, TellsOfItsColumnsWhatTheRecorderKnew) {
  const Folder folder;
  const LogContents log = read(write_log(folder, ramp(10)));
  ASSERT_EQ(log.columns.size(), columns.size());
  EXPECT_EQ(place_of(log.columns, "task"), 1u);
  EXPECT_EQ(place_of(log.columns, "none"), columns.size());
  EXPECT_EQ(log.columns[1].words, columns[1].words);
  EXPECT_EQ(log.columns[1].text(1.0), "hold");
  EXPECT_EQ(log.columns[1].text(2.0), "");
  EXPECT_EQ(log.columns[2].name, "a \"b\"");
  EXPECT_EQ(log.columns[2].unit, "N");
  EXPECT_EQ(log.columns[2].file, "task.yaml");
  EXPECT_EQ(log.columns[2].line, 7);
  EXPECT_EQ(log.columns[2].text(0.1), "0.1");
}

/// Before 2026-11-26 a record was a JSON message. The CSV that the same run wrote has nine digits of each
/// number.
TEST(McapLog, ReadsLogsWhoseRecordsAreJson) {
  const std::filesystem::path logs = ZWANG_SOURCE_DIR "/tests/runtime/logs";
  std::ifstream csv(logs / "before_blocks.csv");
  std::string line;
  std::getline(csv, line);
  std::vector<LoggedColumn> known;
  std::size_t lines = 0;
  const auto compare = [&](double, std::span<const double> values) {
    ASSERT_TRUE(std::getline(csv, line)) << lines;
    ++lines;
    std::istringstream cells(line);
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (known[i].is_input()) continue;
      std::string cell;
      std::getline(cells, cell, ',');
      char digits[32];
      std::snprintf(digits, sizeof digits, "%.9g", values[i] == 0.0 ? 0.0 : values[i]);
      const bool has_words = !known[i].words.empty();
      EXPECT_EQ(std::isnan(values[i]) ? ""
                : has_words           ? known[i].text(values[i])
                                      : digits,
                cell)
          << known[i].name << ", line " << lines;
    }
  };
  const LogContents log =
      read_log(logs / "before_blocks.mcap", compare, [&](const LogContents& head) { known = head.columns; });
  EXPECT_TRUE(log.closed && log.damage.empty());
  EXPECT_EQ(log.records, 23u);
  EXPECT_EQ(lines, log.records);
  EXPECT_GT(known.size(), 200u);
  EXPECT_EQ(log.context.facts.at("period [s]"), "0.01");
}

TEST(McapLog, TwoLogsOfTheSameNumbersAreTheSameBytes) {
  const Folder one, two;
  EXPECT_EQ(bytes_of(write_log(one, ramp(1000))), bytes_of(write_log(two, ramp(1000))));
}

TEST(McapLog, CutAtAnyByteLosesNoMoreThanAChunk) {
  const Folder folder;
  constexpr int count = 350;
  const std::string whole = bytes_of(write_log(folder, ramp(count)));
  const std::filesystem::path cut = folder.path / "cut.mcap";
  std::uint64_t most = 0;
  for (std::size_t size = 0; size < whole.size(); size += stride) {
    put_bytes(cut, std::string_view(whole).substr(0, size));
    if (size < 8) {
      EXPECT_THROW(read(cut), std::runtime_error) << size;
      continue;
    }
    const LogContents log = read(cut);
    EXPECT_FALSE(log.closed) << size;
    EXPECT_FALSE(log.damage.empty()) << size;
    // Records that were whole before the cut stay readable.
    EXPECT_GE(log.records, most) << size;
    most = std::max(most, log.records);
  }
  EXPECT_GE(most + records_in_a_chunk, static_cast<std::uint64_t>(count));
}

TEST(McapLog, AFlippedBitIsToldAndLosesNoMoreThanAChunk) {
  const Folder folder;
  constexpr std::uint64_t count = 350;
  const std::string whole = bytes_of(write_log(folder, ramp(static_cast<int>(count))));
  const std::filesystem::path flipped = folder.path / "flipped.mcap";
  constexpr std::string_view data_end_head("\x0F\4\0\0\0\0\0\0\0", 9);
  const std::size_t data_end = whole.rfind(data_end_head);
  ASSERT_NE(data_end, std::string::npos);
  // The heads of the first records byte by byte, the rest in strides that meet every field somewhere.
  for (std::size_t i = 8; i < whole.size(); i += i < 400 ? 1 : stride) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ (1 << (i % 8)));
    put_bytes(flipped, changed);
    const LogContents log = read(flipped);
    EXPECT_GE(log.records + records_in_a_chunk, count) << "byte " << i;
    // The sections behind the data only speed up a search, and are not read.
    if (i < data_end + data_end_head.size() + 4) {
      EXPECT_FALSE(log.damage.empty()) << "byte " << i;
    }
  }
}

/// Where no samples arrive, time stands still: that a stop followed has to be on disk all the same.
TEST(McapLog, RecordsOfOneTimeAreOnDiskSoon) {
  const Folder folder;
  const std::filesystem::path path = folder.path / "log.mcap";
  const std::unique_ptr<LogSink> sink = mcap_sink(path, context());
  ASSERT_EQ(sink->open(columns), "");
  constexpr int count = 350;
  for (int i = 0; i < count; ++i) ASSERT_EQ(sink->write(std::vector{2.0, 0.0, i * 0.1}), "");
  EXPECT_GE(read(path).records, count - 100u) << "before it is closed";
}

/// Of a hundred thousand records four at a time find room: how many did not, and where, is in the log.
TEST(McapLog, DroppedRecordsAreMissingInTheLog) {
  const Folder folder;
  const std::filesystem::path path = folder.path / "log.mcap";
  std::vector<std::unique_ptr<LogSink>> sinks;
  sinks.push_back(mcap_sink(path, context()));
  Recorder recorder(std::move(sinks), columns, 4);
  constexpr int count = 100'000;
  for (int i = 0; i < count; ++i) recorder.record(std::vector{i * period, 0.0, 0.0});
  recorder.close();
  EXPECT_GT(recorder.status().dropped, 0u);
  const LogContents log = read(path);
  EXPECT_EQ(log.records, recorder.status().written);
  EXPECT_EQ(log.context.facts, context().facts);
  ASSERT_FALSE(log.damage.empty());
  std::uint64_t missing = 0;
  for (const std::string& what : log.damage) missing += std::stoull(what);
  EXPECT_EQ(missing, recorder.status().dropped);
  EXPECT_NE(log.damage.back().find("missing before the end"), std::string::npos) << log.damage.back();
}

/// A chunk every 75 ms, and 118 bytes of each in the index: that is read back from the file at the end. Ten
/// hours with ZWANG_LONG in the environment.
TEST(McapLog, MemoryStaysFlatHoweverLongItGets) {
#if defined(ZWANG_SANITIZED) || !defined(__GLIBC__)
  GTEST_SKIP() << "somebody else owns malloc";
#else
  const int chunks = test::is_long() ? 720'000 : 4'000;
  const Folder folder;
  const std::unique_ptr<LogSink> sink = mcap_sink(folder.path / "log.mcap", context());
  ASSERT_EQ(sink->open(columns), "");
  std::size_t warm = 0;
  for (int i = 0; i < chunks; ++i) {
    ASSERT_EQ(sink->write(std::vector<double>{i * 0.075, 0.0, i * 0.1}), "");
    if (i == chunks / 10) warm = mallinfo2().uordblks;
  }
  const std::size_t end = mallinfo2().uordblks;
  std::printf("%d chunks: %zu bytes more on the heap than after a tenth\n", chunks,
              end > warm ? end - warm : 0);
  EXPECT_LT(end, warm + 16'384);
  EXPECT_EQ(sink->close(), "");
  const LogContents log = read(folder.path / "log.mcap");
  EXPECT_TRUE(log.closed && log.damage.empty());
  EXPECT_EQ(log.records, static_cast<std::uint64_t>(chunks));
#endif
}

TEST(McapLog, OtherFilesAreRefused) {
  const Folder folder;
  put_bytes(folder.path / "text", "time [s],task\n0,press\n");
  EXPECT_THROW(read(folder.path / "text"), std::runtime_error);
  EXPECT_THROW(read(folder.path / "nothing"), std::runtime_error);
  EXPECT_THROW(read(folder.path), std::runtime_error);
}

TEST(McapLog, AFullDiskIsReported) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  std::vector<std::unique_ptr<LogSink>> sinks;
  sinks.push_back(mcap_sink("/dev/full", context()));
  Recorder recorder(std::move(sinks), columns, 64);
  for (const std::vector<double>& record : ramp(1000)) {
    recorder.wait_for_room();
    recorder.record(record);
  }
  recorder.close();
  EXPECT_NE(recorder.status().error.find("/dev/full"), std::string::npos);
}

/// A sink of an embedding program that does not know better.
class ThrowingSink : public LogSink {
 public:
  std::string open(const std::vector<Column>&) override { return ""; }
  std::string write(std::span<const double>) override { throw std::runtime_error("no signal"); }
  std::string flush() override { return ""; }
  std::string close() override { return ""; }
};

TEST(McapLog, ASinkThatThrowsIsReportedAndTheOthersGoOn) {
  const Folder folder;
  std::vector<std::unique_ptr<LogSink>> sinks;
  sinks.push_back(std::make_unique<ThrowingSink>());
  sinks.push_back(mcap_sink(folder.path / "log.mcap", context()));
  Recorder recorder(std::move(sinks), columns, 64);
  for (const std::vector<double>& record : ramp(10)) recorder.record(record);
  recorder.close();
  EXPECT_NE(recorder.status().error.find("no signal"), std::string::npos);
  EXPECT_FALSE(recorder.status().complete());
  EXPECT_EQ(read(folder.path / "log.mcap").records, 10u);
}

}  // namespace
}  // namespace zwang::runtime
