// The records of a run as messages: no record waits for the next one.
#include "live_sink.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "zwang/runtime/recorder.hpp"

namespace zwang::cli {
namespace {

const std::vector<runtime::Column> columns = {{"time", "s", {}}, {"base.x", "m", {}}};

int records_in(const std::string& message) {
  std::uint32_t size = 0;
  std::memcpy(&size, message.data(), sizeof size);
  return nlohmann::json::parse(message.substr(sizeof size, size)).at("records");
}

TEST(LiveSink, SendsAnUnfinishedMessageWhenNoRecordCameBetweenTwoLooks) {
  std::vector<std::string> sent;
  const auto sink = live_sink(1e9, [&](std::string message) { sent.push_back(std::move(message)); });
  ASSERT_EQ(sink->open(columns), "");
  for (int i = 0; i < 3; ++i) sink->write(std::vector{0.001 * i, 1.0});
  sink->flush();
  sink->flush();
  ASSERT_EQ(sent.size(), 1u);
  EXPECT_EQ(records_in(sent.front()), 3);
  sink->flush();
  EXPECT_EQ(sent.size(), 1u) << "a message without a record";
}

TEST(LiveSink, ARunThatStandsIsSeenUpToItsLastRecord) {
  std::mutex mutex;
  int seen = 0;
  std::vector<std::unique_ptr<runtime::LogSink>> sinks;
  sinks.push_back(live_sink(1e9, [&](const std::string& message) {
    const std::lock_guard lock(mutex);
    seen += records_in(message);
  }));
  runtime::Recorder recorder(std::move(sinks), columns);
  const auto is_seen = [&](int count) {
    for (int i = 0; i < 5000; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      const std::lock_guard lock(mutex);
      if (seen == count) return true;
    }
    return false;
  };
  for (int count = 1; count <= 3; ++count) {
    ASSERT_TRUE(recorder.record(std::vector{0.001 * count, 1.0}));
    EXPECT_TRUE(is_seen(count)) << "the record of tick " << count << " waits for the next one";
  }
}

}  // namespace
}  // namespace zwang::cli
