#include "action.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "clock.hpp"

namespace zwang::connect {

namespace {

/// action_msgs/srv/CancelGoal's return codes.
enum class CancelCode : std::int8_t { none, rejected, unknown_goal, goal_terminated };

using Stamp = std::pair<std::int32_t, std::uint32_t>;

Stamp stamp_now() {
  const double time = now(), seconds = std::floor(time);
  return {static_cast<std::int32_t>(seconds), static_cast<std::uint32_t>((time - seconds) * 1e9)};
}

bool is_over(GoalStatus status) {
  return status >= GoalStatus::succeeded;
}

GoalStatus status_of(GoalOutcome outcome) {
  if (outcome == GoalOutcome::done) return GoalStatus::succeeded;
  return outcome == GoalOutcome::canceled ? GoalStatus::canceled : GoalStatus::aborted;
}

Bytes result_fields(GoalStatus status, const RunTaskResult& result) {
  Bytes fields;
  CdrWriter write(fields);
  write(static_cast<std::int8_t>(status));
  write(static_cast<std::uint8_t>(result.outcome));
  write(result.reason);
  return fields;
}

}  // namespace

RunTaskServer::RunTaskServer(std::function<bool()> is_ready, Publish status, Publish feedback)
    : is_ready_(std::move(is_ready)), status_(std::move(status)), feedback_(std::move(feedback)) {
  publish_status();
}

RunTaskServer::Kept* RunTaskServer::find(const GoalId& id) {
  const auto goal = std::find_if(goals_.begin(), goals_.end(), [&](const Kept& k) { return k.id == id; });
  return goal == goals_.end() ? nullptr : &*goal;
}

bool RunTaskServer::is_busy() const {
  return !goals_.empty() && !is_over(goals_.back().status);
}

void RunTaskServer::send_goal(std::span<const std::uint8_t> fields, const Reply& reply) {
  CdrReader read(fields);
  RunTaskGoal goal;
  read(goal.id), read(goal.task), read(goal.parameters);
  if (!read.is_at_end()) return;
  const bool is_ready = is_ready_();
  const Stamp stamp = stamp_now();
  bool is_accepted = false;
  {
    const std::lock_guard lock(mutex_);
    is_accepted = is_ready && !is_busy() && find(goal.id) == nullptr;
    if (is_accepted) {
      if (goals_.size() == kept_goals) goals_.pop_front();
      goals_.push_back({goal.id, stamp, GoalStatus::accepted, {}, {}});
      accepted_ = std::move(goal);
      wants_cancel_ = false;
    }
  }
  Bytes answer;
  CdrWriter write(answer);
  write(is_accepted), write(stamp.first), write(stamp.second);
  reply(answer);
  if (is_accepted) publish_status();
}

/// By ROS 2's rules: a goal of this id, or those accepted until this time, or all where both are zero.
void RunTaskServer::cancel_goal(std::span<const std::uint8_t> fields, const Reply& reply) {
  CdrReader read(fields);
  GoalId id{};
  Stamp until;
  read(id), read(until.first), read(until.second);
  if (!read.is_at_end()) return;
  const bool is_any_id = id == GoalId{}, is_any_time = until == Stamp{};
  CancelCode code = CancelCode::none;
  std::vector<std::pair<GoalId, Stamp>> canceling;
  {
    const std::lock_guard lock(mutex_);
    const Kept* named = find(id);
    if (!is_any_id && named == nullptr) code = CancelCode::unknown_goal;
    if (named != nullptr && is_over(named->status)) code = CancelCode::goal_terminated;
    if (is_busy()) {
      Kept& goal = goals_.back();
      const bool is_meant =
          goal.id == id || (is_any_id && is_any_time) || (!is_any_time && goal.stamp <= until);
      if (is_meant) {
        goal.status = GoalStatus::canceling;
        wants_cancel_ = true;
        canceling.emplace_back(goal.id, goal.stamp);
        code = CancelCode::none;
      }
    }
  }
  Bytes answer;
  CdrWriter write(answer);
  write(static_cast<std::int8_t>(code));
  write(static_cast<std::uint32_t>(canceling.size()));
  for (const auto& [goal, stamp] : canceling) write(goal), write(stamp.first), write(stamp.second);
  reply(answer);
  if (!canceling.empty()) publish_status();
}

void RunTaskServer::get_result(std::span<const std::uint8_t> fields, const Reply& reply) {
  CdrReader read(fields);
  GoalId id{};
  read(id);
  if (!read.is_at_end()) return;
  Bytes answer;
  {
    const std::lock_guard lock(mutex_);
    Kept* goal = find(id);
    if (goal != nullptr && !is_over(goal->status)) {
      // A client that asks again and again gets as many replies, and no more memory than that.
      if (goal->waiting.size() < kept_goals) goal->waiting.push_back(reply);
      return;
    }
    answer =
        goal == nullptr ? result_fields(GoalStatus::unknown, {}) : result_fields(goal->status, goal->result);
  }
  reply(answer);
}

std::optional<RunTaskGoal> RunTaskServer::take_goal() {
  std::optional<RunTaskGoal> goal;
  {
    const std::lock_guard lock(mutex_);
    if (!accepted_) return std::nullopt;
    goal = std::exchange(accepted_, std::nullopt);
    if (goals_.back().status == GoalStatus::accepted) goals_.back().status = GoalStatus::executing;
  }
  publish_status();
  return goal;
}

void RunTaskServer::finish(const RunTaskResult& result) {
  std::vector<Reply> waiting;
  Bytes answer;
  {
    const std::lock_guard lock(mutex_);
    if (!is_busy()) return;
    Kept& goal = goals_.back();
    goal.status = status_of(result.outcome);
    goal.result = result;
    waiting.swap(goal.waiting);
    answer = result_fields(goal.status, result);
    wants_cancel_ = false;
  }
  publish_status();
  for (const Reply& reply : waiting) reply(answer);
}

void RunTaskServer::tell(const RunTaskFeedback& feedback) {
  Bytes payload;
  CdrWriter write(payload);
  {
    const std::lock_guard lock(mutex_);
    if (!is_busy()) return;
    write(goals_.back().id);
  }
  write(feedback.task), write(feedback.elapsed), write(feedback.progress), write(feedback.force);
  feedback_(payload);
}

/// action_msgs/GoalStatusArray of all goals that are kept.
void RunTaskServer::publish_status() {
  const std::lock_guard in_order(publishing_);
  Bytes payload;
  CdrWriter write(payload);
  {
    const std::lock_guard lock(mutex_);
    write(static_cast<std::uint32_t>(goals_.size()));
    for (const Kept& goal : goals_)
      write(goal.id), write(goal.stamp.first), write(goal.stamp.second),
          write(static_cast<std::int8_t>(goal.status));
  }
  status_(payload);
}

}  // namespace zwang::connect
