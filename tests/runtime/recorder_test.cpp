#include "zwang/runtime/recorder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <thread>

#include "../temporary_folder.hpp"
#include "log/blank.hpp"

namespace zwang::runtime {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

struct EmptyFolder {
  zwang::test::TemporaryFolder temporary;
  std::filesystem::path path = temporary.path();
};

const std::vector<Column> task_columns = {
    {"time", "s", {}}, {"task", "", {"press", "hold"}}, {"go.x.nu", "N", {}}};

TEST(Recorder, WritesNamesUnitsNumbersWordsAndBlanks) {
  EmptyFolder folder;
  Recorder recorder(folder.path / "log.csv", task_columns);
  EXPECT_TRUE(recorder.record(std::vector{0.001, 0.0, log_column::blank}));
  EXPECT_TRUE(recorder.record(std::vector{1.0 / 3.0, 1.0, -20.0}));
  EXPECT_TRUE(
      recorder.record(std::vector{-0.0, 7.0, 1.23456789012e-7}));  // a word that is not there is blank
  recorder.close();
  EXPECT_EQ(text_of(folder.path / "log.csv"),
            "time [s],task,go.x.nu [N]\n0.001,press,\n0.333333333,hold,-20\n0,,1.23456789e-07\n");
  EXPECT_TRUE(recorder.status().complete());
  EXPECT_EQ(recorder.status().written, 3u);
}

TEST(Recorder, KeepsEveryRecordWhenTheProducerWaits) {
  EmptyFolder folder;
  Recorder recorder(folder.path / "log.csv", task_columns, 16);
  const int count = 500;
  for (int i = 0; i < count; ++i) {
    recorder.wait_for_room();
    EXPECT_TRUE(recorder.record(std::vector{static_cast<double>(i), 0.0, log_column::blank}));
  }
  recorder.close();
  EXPECT_TRUE(recorder.status().complete());
  std::istringstream lines(text_of(folder.path / "log.csv"));
  std::string line;
  std::getline(lines, line);
  for (int i = 0; i < count; ++i) {
    ASSERT_TRUE(std::getline(lines, line));
    ASSERT_EQ(line, std::to_string(i) + ",press,");
  }
  EXPECT_FALSE(std::getline(lines, line));
}

std::string complaint_of(const std::filesystem::path& path) {
  Recorder recorder(path, task_columns);
  return recorder.status().error;
}

TEST(Recorder, WritesThroughNoLinkAndIntoNoPipe) {
  EmptyFolder folder;
  std::ofstream(folder.path / "kept") << "precious";
  std::filesystem::create_symlink(folder.path / "kept", folder.path / "link.csv");
  EXPECT_NE(complaint_of(folder.path / "link.csv").find("is a symbolic link"), std::string::npos);
  EXPECT_EQ(text_of(folder.path / "kept"), "precious");
  ASSERT_EQ(mkfifo((folder.path / "pipe.csv").c_str(), 0600), 0);
  EXPECT_NE(complaint_of(folder.path / "pipe.csv").find("is a pipe"), std::string::npos);
}

TEST(Recorder, LeavesALogToTheRunThatWritesIt) {
  EmptyFolder folder;
  {
    Recorder first(folder.path / "log.csv", task_columns);
    EXPECT_TRUE(first.record(std::vector{0.001, 0.0, 1.0}));
    EXPECT_NE(complaint_of(folder.path / "log.csv").find("another run writes this log"), std::string::npos);
    first.close();
    EXPECT_TRUE(first.status().complete());
  }
  EXPECT_NE(text_of(folder.path / "log.csv").find("0.001,press,1"), std::string::npos);
  EXPECT_EQ(complaint_of(folder.path / "log.csv"), "") << "a run that is over leaves it";
}

TEST(Recorder, AnOverflowDropsAndCountsAndNeverWaits) {
  EmptyFolder folder;
  Recorder recorder(folder.path / "log.csv", task_columns, 4);
  int accepted = 0;
  const int count = 100'000;
  for (int i = 0; i < count; ++i) {
    accepted += recorder.record(std::vector{static_cast<double>(i), 0.0, 0.0}) ? 1 : 0;
  }
  recorder.close();
  const RecorderStatus status = recorder.status();
  EXPECT_LT(accepted, count) << "four slots cannot hold what comes in five milliseconds";
  EXPECT_EQ(status.recorded, static_cast<std::uint64_t>(accepted));
  EXPECT_EQ(status.dropped, static_cast<std::uint64_t>(count - accepted));
  EXPECT_EQ(status.written, status.recorded);
  EXPECT_FALSE(status.complete());
  EXPECT_TRUE(status.error.empty());
}

TEST(Recorder, AFolderThatIsNotThereIsReportedAndStopsNothing) {
  Recorder recorder("/nonexistent/folder/log.csv", task_columns, 4);
  for (int i = 0; i < 100; ++i) {
    recorder.wait_for_room();
    EXPECT_TRUE(recorder.record(std::vector{0.0, 0.0, 0.0}));
  }
  recorder.close();
  EXPECT_NE(recorder.status().error.find("/nonexistent/folder/log.csv"), std::string::npos);
  EXPECT_EQ(recorder.status().written, 0u);
  EXPECT_FALSE(recorder.status().complete());
}

TEST(Recorder, AFullDiskIsReportedAndStopsNothing) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  Recorder recorder("/dev/full", task_columns, 4);
  for (int i = 0; i < 100; ++i) {
    recorder.wait_for_room();
    EXPECT_TRUE(recorder.record(std::vector{0.0, 0.0, 0.0}));
  }
  recorder.close();
  EXPECT_FALSE(recorder.status().error.empty());
  EXPECT_FALSE(recorder.status().complete());
}

TEST(Recorder, RefusesRecordsThatDoNotFitTheColumns) {
  EmptyFolder folder;
  Recorder recorder(folder.path / "log.csv", task_columns);
  EXPECT_FALSE(recorder.record(std::vector{1.0, 2.0}));
  EXPECT_EQ(recorder.status().dropped, 1u);
  EXPECT_THROW(Recorder(folder.path / "other.csv", {}), std::invalid_argument);
}

TEST(Recorder, RecordsAreOnDiskSoonSoThatAKilledRunKeepsThem) {
  EmptyFolder folder;
  Recorder recorder(folder.path / "log.csv", task_columns);
  recorder.record(std::vector{1.0, 0.0, 0.0});
  for (int i = 0; i < 200 && text_of(folder.path / "log.csv").find("1,press,0") == std::string::npos; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_NE(text_of(folder.path / "log.csv").find("1,press,0\n"), std::string::npos) << "before close";
}

}  // namespace
}  // namespace zwang::runtime
