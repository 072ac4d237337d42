// Sends a goal of zwang_msgs/action/RunTask to /zwang/run, and prints what comes of it.
//
//   action_client DOMAIN SECONDS_UNTIL_CANCEL TASK [PARAMETER]...
//
// 0 s: it is not cancelled. The last line is `status S, outcome O: reason`, or `rejected`. Ends with 0 unless
// a reply stays away.
#include <array>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "raw_client.hpp"

namespace {

using namespace zwang::connect;
using GoalId = std::array<std::uint8_t, 16>;

const std::string action = "/zwang/run/_action/", types = "zwang_msgs::action::dds_::RunTask_";

Bytes goal_request(const GoalId& id, const std::string& task, const std::vector<std::string>& parameters) {
  Bytes bytes;
  CdrWriter write(bytes);
  write(id), write(task), write(parameters);
  return bytes;
}

Bytes request_of(const GoalId& id, bool has_stamp) {
  Bytes bytes;
  CdrWriter write(bytes);
  write(id);
  if (has_stamp) write(std::int32_t{0}), write(std::uint32_t{0});
  return bytes;
}

/// The status of the goal as the topic has it last, and how much feedback has come.
void print_topics(test::dds::DataReader& status, test::dds::DataReader& feedback, const GoalId& id) {
  test::dds::SampleInfo info;
  int last = -1, told = 0;
  while (const auto bytes = test::next_message(status, 0.3, info)) {
    CdrReader read(*bytes);
    std::uint32_t count = 0;
    read(count);
    for (std::uint32_t i = 0; i < count && read.is_good(); ++i) {
      GoalId goal{};
      std::int32_t seconds = 0;
      std::uint32_t nanoseconds = 0;
      std::int8_t value = 0;
      read(goal), read(seconds), read(nanoseconds), read(value);
      if (goal == id) last = value;
    }
  }
  std::string task;
  while (const auto bytes = test::next_message(feedback, 0.1, info)) {
    CdrReader read(*bytes);
    GoalId goal{};
    double elapsed = 0.0, progress = 0.0, force = 0.0;
    read(goal), read(task), read(elapsed), read(progress), read(force);
    if (read.is_at_end() && goal == id) ++told;
  }
  std::printf("topic says %d, feedback %s\n", last, told > 0 ? "came" : "did not come");
}

int run(int domain, double until_cancel, const std::string& task,
        const std::vector<std::string>& parameters) {
  test::Peer peer(domain);
  test::RawClient send(peer, action + "send_goal", types + "SendGoal_");
  test::RawClient cancel(peer, action + "cancel_goal", "action_msgs::srv::dds_::CancelGoal_");
  test::RawClient result(peer, action + "get_result", types + "GetResult_");
  auto& feedback = peer.reader("rt" + action + "feedback", types + "FeedbackMessage_");
  auto& status = peer.reader("rt" + action + "status", "action_msgs::msg::dds_::GoalStatusArray_", true);
  if (!send.wait_for_server() || !cancel.wait_for_server() || !result.wait_for_server()) return 2;
  GoalId id{};
  std::random_device random;
  for (auto& byte : id) byte = static_cast<std::uint8_t>(random());
  const auto sent = send.call(goal_request(id, task, parameters));
  if (!sent) return 2;
  bool is_accepted = false;
  CdrReader read_sent(*sent);
  read_sent(is_accepted);
  if (!is_accepted) {
    std::printf("rejected\n");
    return 0;
  }
  result.ask(request_of(id, false));
  if (until_cancel > 0.0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(until_cancel));
    const auto canceled = cancel.call(request_of(id, true));
    if (!canceled) return 2;
    std::int8_t code = 0;
    std::uint32_t count = 0;
    CdrReader read(*canceled);
    read(code), read(count);
    std::printf("cancel says %d of %u\n", code, count);
  }
  const auto ended = result.reply(60.0);
  if (!ended) return 2;
  print_topics(status, feedback, id);
  std::int8_t value = 0;
  std::uint8_t outcome = 0;
  std::string reason;
  CdrReader read(*ended);
  read(value), read(outcome), read(reason);
  std::printf("status %d, outcome %d: %s\n", value, outcome, reason.c_str());
  return read.is_at_end() ? 0 : 2;
}

}  // namespace

int main(int argc, char** argv) {
  return argc >= 4 ? run(std::atoi(argv[1]), std::atof(argv[2]), argv[3], {argv + 4, argv + argc}) : 2;
}
