/// The server's side of the action `zwang_msgs/action/RunTask`, between payloads and the thread that drives:
/// goals are taken one at a time. It knows no DDS.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "service.hpp"

namespace zwang::connect {

using GoalId = std::array<std::uint8_t, 16>;  ///< unique_identifier_msgs/UUID

struct RunTaskGoal {
  GoalId id{};
  std::string task;  ///< a name of the connection's `tasks`; empty: the task of the command line
  std::vector<std::string> parameters;  ///< `push=30 N`
};

/// action_msgs/GoalStatus.
enum class GoalStatus : std::int8_t { unknown, accepted, executing, canceling, succeeded, canceled, aborted };

/// RunTask's constants.
enum class GoalOutcome : std::uint8_t { done, failed, stopped, canceled, refused };

struct RunTaskResult {
  GoalOutcome outcome = GoalOutcome::done;
  std::string reason;  ///< one sentence; empty for `done`
};

struct RunTaskFeedback {
  std::string task;        ///< the active one of the task file
  double elapsed = 0.0;    ///< [s] since the goal began
  double progress = -1.0;  ///< of the active task's timeout, 0 to 1; -1: it has none
  double force = 0.0;      ///< [N] that presses on the base, in its plane
};

/// Any thread may call it. The callbacks are called with nothing held that they could wait for.
class RunTaskServer {
 public:
  using Publish = std::function<void(const Bytes& payload)>;

  /// `is_ready`: whether a goal could begin now. `status` and `feedback` put payloads on the action's topics.
  RunTaskServer(std::function<bool()> is_ready, Publish status, Publish feedback);

  // The action's services.
  void send_goal(std::span<const std::uint8_t> fields, const Reply& reply);
  void cancel_goal(std::span<const std::uint8_t> fields, const Reply& reply);
  void get_result(std::span<const std::uint8_t> fields, const Reply& reply);

  // The side that drives.
  /// An accepted goal, which is `executing` from now on; it is to be finished.
  std::optional<RunTaskGoal> take_goal();
  /// A client has asked for the end of the goal that is driven. Neither locks nor waits.
  bool wants_cancel() const noexcept { return wants_cancel_; }
  /// `result.outcome` says which status the goal ends with.
  void finish(const RunTaskResult& result);
  void tell(const RunTaskFeedback& feedback);

  static constexpr std::size_t kept_goals = 16;  ///< whose results can be asked for

 private:
  struct Kept {
    GoalId id{};
    std::pair<std::int32_t, std::uint32_t> stamp;  ///< of its acceptance: seconds, nanoseconds
    GoalStatus status = GoalStatus::accepted;
    RunTaskResult result;
    std::vector<Reply> waiting;  ///< for the result
  };

  Kept* find(const GoalId& id);
  bool is_busy() const;
  void publish_status();

  std::function<bool()> is_ready_;
  Publish status_, feedback_;
  std::mutex publishing_;  ///< the status that is published last is the last one
  mutable std::mutex mutex_;
  std::deque<Kept> goals_;  ///< the newest last; all but the last are over
  std::optional<RunTaskGoal> accepted_;
  std::atomic<bool> wants_cancel_{false};
};

/// The names of the action's services and topics behind `NAME/_action/`, and the types of its services.
struct ActionService {
  const char* name;
  const char* type;
  void (RunTaskServer::*handle)(std::span<const std::uint8_t>, const Reply&);
};
inline constexpr ActionService run_task_services[] = {
    {"send_goal", "zwang_msgs/action/RunTask_SendGoal", &RunTaskServer::send_goal},
    {"cancel_goal", "action_msgs/srv/CancelGoal", &RunTaskServer::cancel_goal},
    {"get_result", "zwang_msgs/action/RunTask_GetResult", &RunTaskServer::get_result},
};
inline constexpr const char* run_task_feedback_type = "zwang_msgs/action/RunTask_FeedbackMessage";
inline constexpr const char* goal_status_type = "action_msgs/msg/GoalStatusArray";

}  // namespace zwang::connect
