// The action's server between payloads. The layouts are those of action_msgs and of rosidl's generated
// services. SendGoal is UUID and goal; its answer is accepted and a time. GetResult is UUID; its answer is
// status and result.
#include "action.hpp"

#include <gtest/gtest.h>

#include <random>

namespace zwang::connect {
namespace {

GoalId goal_id(std::uint8_t last) {
  GoalId id{};
  id.back() = last;
  return id;
}

Bytes goal_request(const GoalId& id, const std::string& task,
                   const std::vector<std::string>& parameters = {}) {
  Bytes bytes;
  CdrWriter write(bytes);
  write(id), write(task), write(parameters);
  return bytes;
}

Bytes cancel_request(const GoalId& id, std::int32_t seconds = 0) {
  Bytes bytes;
  CdrWriter write(bytes);
  write(id), write(seconds), write(std::uint32_t{0});
  return bytes;
}

Bytes result_request(const GoalId& id) {
  Bytes bytes;
  CdrWriter write(bytes);
  write(id);
  return bytes;
}

class RunTaskAction : public testing::Test {
 protected:
  struct Canceled {
    std::int8_t code = 127;
    std::uint32_t count = 0;
  };
  struct Result {
    std::int8_t status = 127;
    std::uint8_t outcome = 127;
    std::string reason;
  };

  bool send(const GoalId& id, const std::string& task = "align") {
    bool is_accepted = false, is_answered = false;
    server.send_goal(goal_request(id, task, {"push=30 N"}), [&](const Bytes& fields) {
      CdrReader read(fields);
      std::int32_t seconds = 0;
      std::uint32_t nanoseconds = 0;
      read(is_accepted), read(seconds), read(nanoseconds);
      EXPECT_TRUE(read.is_at_end());
      is_answered = true;
    });
    EXPECT_TRUE(is_answered);
    return is_accepted;
  }

  Canceled cancel(const GoalId& id, std::int32_t seconds = 0) {
    Canceled canceled;
    server.cancel_goal(cancel_request(id, seconds), [&](const Bytes& fields) {
      CdrReader read(fields);
      read(canceled.code), read(canceled.count);
      for (std::uint32_t i = 0; i < canceled.count; ++i) {
        GoalId goal{};
        std::int32_t s = 0;
        std::uint32_t ns = 0;
        read(goal), read(s), read(ns);
      }
      EXPECT_TRUE(read.is_at_end());
    });
    return canceled;
  }

  void ask_for_result(const GoalId& id) {
    server.get_result(result_request(id), [this](const Bytes& fields) {
      CdrReader read(fields);
      Result& result = results.emplace_back();
      read(result.status), read(result.outcome), read(result.reason);
      EXPECT_TRUE(read.is_at_end());
    });
  }

  /// Of each goal that the last status has: the last byte of its id, and its status.
  std::vector<std::pair<int, int>> last_status() const {
    CdrReader read(status);
    std::uint32_t count = 0;
    read(count);
    std::vector<std::pair<int, int>> goals;
    for (std::uint32_t i = 0; i < count; ++i) {
      GoalId id{};
      std::int32_t seconds = 0;
      std::uint32_t nanoseconds = 0;
      std::int8_t value = 0;
      read(id), read(seconds), read(nanoseconds), read(value);
      goals.emplace_back(id.back(), value);
    }
    EXPECT_TRUE(read.is_at_end());
    return goals;
  }

  bool is_ready = true;
  Bytes status, feedback;
  std::vector<Result> results;
  RunTaskServer server{[this] { return is_ready; }, [this](const Bytes& b) { status = b; },
                       [this](const Bytes& b) { feedback = b; }};
};
using Statuses = std::vector<std::pair<int, int>>;

TEST_F(RunTaskAction, GoesFromAGoalToItsResult) {
  EXPECT_EQ(last_status(), Statuses{});
  ASSERT_TRUE(send(goal_id(1)));
  EXPECT_EQ(last_status(), (Statuses{{1, 1}}));
  ask_for_result(goal_id(1));
  const auto goal = server.take_goal();
  ASSERT_TRUE(goal);
  EXPECT_EQ(goal->task, "align");
  EXPECT_EQ(goal->parameters, std::vector<std::string>{"push=30 N"});
  EXPECT_EQ(last_status(), (Statuses{{1, 2}}));
  EXPECT_FALSE(server.take_goal());
  EXPECT_TRUE(results.empty());
  server.finish({GoalOutcome::failed, "`align` waited 30 s"});
  EXPECT_EQ(last_status(), (Statuses{{1, 6}}));
  ask_for_result(goal_id(1));
  ASSERT_EQ(results.size(), 2U);  // the one that has waited, and the one that came later
  for (const Result& result : results) {
    EXPECT_EQ(result.status, 6);
    EXPECT_EQ(result.outcome, 1);
    EXPECT_EQ(result.reason, "`align` waited 30 s");
  }
}

// XCDR1 by hand: accepted, then the time at the next multiple of four.
TEST_F(RunTaskAction, AnswersInTheLayoutOfItsTypes) {
  Bytes answer;
  server.send_goal(goal_request(goal_id(1), ""), [&](const Bytes& fields) { answer = fields; });
  ASSERT_EQ(answer.size(), 4U + 4U + 8U);
  EXPECT_EQ(Bytes(answer.begin(), answer.begin() + 8), (Bytes{0, 1, 0, 0, 1, 0, 0, 0}));
  server.finish({GoalOutcome::refused, "no"});
  server.get_result(result_request(goal_id(1)), [&](const Bytes& fields) { answer = fields; });
  // status 6, outcome 4, two bytes of padding, three characters with the zero.
  EXPECT_EQ(answer, (Bytes{0, 1, 0, 0, 6, 4, 0, 0, 3, 0, 0, 0, 'n', 'o', 0}));
}

TEST_F(RunTaskAction, TakesOneGoalAtATime) {
  is_ready = false;
  EXPECT_FALSE(send(goal_id(1)));
  is_ready = true;
  EXPECT_TRUE(send(goal_id(2)));
  EXPECT_FALSE(send(goal_id(3)));
  server.take_goal();
  EXPECT_FALSE(send(goal_id(3)));
  server.finish({GoalOutcome::done, ""});
  EXPECT_EQ(last_status(), (Statuses{{2, 4}}));
  EXPECT_FALSE(send(goal_id(2)));  // the id of a goal that is known
  EXPECT_TRUE(send(goal_id(3)));
}

TEST_F(RunTaskAction, IsCancelled) {
  send(goal_id(1));
  server.take_goal();
  EXPECT_EQ(cancel(goal_id(9)).code, 2);
  EXPECT_FALSE(server.wants_cancel());
  const Canceled canceled = cancel(goal_id(1));
  EXPECT_EQ(canceled.code, 0);
  EXPECT_EQ(canceled.count, 1U);
  EXPECT_TRUE(server.wants_cancel());
  EXPECT_EQ(last_status(), (Statuses{{1, 3}}));
  server.finish({GoalOutcome::canceled, "requested"});
  EXPECT_EQ(last_status(), (Statuses{{1, 5}}));
  EXPECT_FALSE(server.wants_cancel());
  EXPECT_EQ(cancel(goal_id(1)).code, 3);
}

TEST_F(RunTaskAction, IsCancelledWithAllGoalsOrAllUntilATime) {
  send(goal_id(1));
  EXPECT_EQ(cancel(GoalId{}, 1).count, 0U);  // accepted after 1970
  EXPECT_FALSE(server.wants_cancel());
  EXPECT_EQ(cancel(GoalId{}, 2'000'000'000).count, 1U);
  server.finish({GoalOutcome::canceled, ""});
  send(goal_id(2));
  EXPECT_EQ(cancel(GoalId{}).count, 1U);
  EXPECT_TRUE(server.wants_cancel());
}

TEST_F(RunTaskAction, OfAGoalThatIsCancelledBeforeItIsTakenStaysCancelling) {
  send(goal_id(1));
  cancel(goal_id(1));
  ASSERT_TRUE(server.take_goal());
  EXPECT_EQ(last_status(), (Statuses{{1, 3}}));
  EXPECT_TRUE(server.wants_cancel());
}

TEST_F(RunTaskAction, DoesNotKnowAResultOfAnotherGoal) {
  ask_for_result(goal_id(7));
  ASSERT_EQ(results.size(), 1U);
  EXPECT_EQ(results[0].status, 0);
}

TEST_F(RunTaskAction, KeepsTheLastGoalsOnly) {
  for (std::uint8_t i = 1; i <= 40; ++i) {
    ASSERT_TRUE(send(goal_id(i)));
    server.take_goal();
    server.finish({GoalOutcome::done, ""});
  }
  EXPECT_EQ(last_status().size(), RunTaskServer::kept_goals);
  EXPECT_EQ(last_status().back(), (std::pair{40, 4}));
}

TEST_F(RunTaskAction, TellsOfTheGoalThatIsDriven) {
  server.tell({"press", 1.5, 0.25, 20.5});
  EXPECT_TRUE(feedback.empty());
  send(goal_id(1));
  server.tell({"press", 1.5, 0.25, 20.5});
  CdrReader read(feedback);
  GoalId id{};
  RunTaskFeedback told;
  read(id), read(told.task), read(told.elapsed), read(told.progress), read(told.force);
  EXPECT_TRUE(read.is_at_end());
  EXPECT_EQ(id, goal_id(1));
  EXPECT_EQ(told.task, "press");
  EXPECT_EQ(told.elapsed, 1.5);
  EXPECT_EQ(told.progress, 0.25);
  EXPECT_EQ(told.force, 20.5);
}

TEST_F(RunTaskAction, SurvivesAnyBytes) {
  std::mt19937 random(24);
  const std::vector<Bytes> seeds{goal_request(goal_id(1), "align", {"a=1", "b=2"}),
                                 cancel_request(goal_id(1)), result_request(goal_id(1))};
  for (int i = 0; i < 20'000; ++i) {
    Bytes bytes = seeds[random() % seeds.size()];
    for (unsigned changes = random() % 8; changes > 0; --changes)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    bytes.resize(random() % (bytes.size() + 1));
    const Reply ignore = [](const Bytes&) {};
    for (const ActionService& service : run_task_services) (server.*service.handle)(bytes, ignore);
    if (i % 7 == 0 && server.take_goal()) server.finish({GoalOutcome::done, ""});
  }
  EXPECT_LE(last_status().size(), RunTaskServer::kept_goals);
}

}  // namespace
}  // namespace zwang::connect
