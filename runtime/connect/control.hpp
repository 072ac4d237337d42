/// How people and programs control `zwang drive`: the services `~/start`, `~/stop` and `~/reset`, the action
/// `~/run`, the parameter services, and the topic `~/state`.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "action.hpp"
#include "base_teller.hpp"
#include "dds.hpp"
#include "message.hpp"
#include "parameters.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::connect {

enum class Phase {
  waiting,  ///< for the robot
  ready,    ///< for a start or a goal
  running,
  latched,  ///< a run ended with the protective stop: for `~/reset`
  ended,
};

class Control {
 public:
  /// `is_alive`: whether samples of the robot come; called on threads of its own. All of them outlive it.
  Control(const lang::Connection& connection, const lang::Program& program, Participant& participant,
          std::function<bool()> is_alive);
  ~Control();
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

  /// Somebody has called `~/start` since the last call of this.
  bool take_start() noexcept { return wants_start_.exchange(false); }
  bool wants_stop() const noexcept { return wants_stop_; }
  /// A client has cancelled the goal that is driven.
  bool wants_cancel() const noexcept { return goals_ != nullptr && goals_->wants_cancel(); }

  /// `~/state` tells it at once.
  void enter(Phase phase) noexcept;
  bool is_latched() const noexcept { return phase_ == Phase::latched; }
  /// The program that `note` speaks of from now on; it lives until the next one is named.
  void speak_of(const lang::Program& program);
  /// Of the control thread: neither waits nor allocates. `task` is an index of the program's tasks, beyond
  /// them of those that brake; `elapsed` [s] since the run began, `progress` and `force` as in
  /// RunTaskFeedback.
  void note(int task, double elapsed, double progress, double force) noexcept {
    task_.store(task, std::memory_order_relaxed);
    elapsed_.store(elapsed, std::memory_order_relaxed);
    progress_.store(progress, std::memory_order_relaxed);
    force_.store(force, std::memory_order_relaxed);
  }
  /// Notes the state of the base at `stamp` [s], for `publish` of the connection file. Of the control thread:
  /// neither waits nor allocates.
  void note_base(double stamp, const solver::State& state) noexcept {
    if (base_teller_) base_teller_->note(stamp, state);
  }
  /// Control cycles that were skipped since the run began.
  void note_skipped(std::uint64_t cycles) noexcept { skipped_.store(cycles, std::memory_order_relaxed); }
  /// The last word: `done`, `failed` or `stopped`, and why.
  void end(const std::string& outcome, const std::string& reason);

  /// Of the task file's parameters, those that somebody has set; see ParameterServer.
  std::optional<ParameterServer::Change> take_change() noexcept { return parameters_.take_change(); }

  /// With `start: goals` only.
  RunTaskServer& goals() noexcept { return *goals_; }

 private:
  void serve(const std::string& name, TriggerReply (Control::*answer)());
  void serve_goals();
  TriggerReply start();
  TriggerReply stop();
  TriggerReply reset();
  void tell_changes();
  std::string task_name() const;
  std::string state() const;
  DiagnosticArray health(std::uint64_t skipped) const;

  const lang::Connection& connection_;
  Participant& participant_;
  std::function<bool()> is_alive_;
  std::unique_ptr<Writer> writer_, health_writer_, status_writer_, feedback_writer_;
  std::unique_ptr<RunTaskServer> goals_;
  ParameterServer parameters_;
  std::unique_ptr<BaseTeller> base_teller_;
  std::atomic<bool> wants_start_{false}, wants_stop_{false}, is_over_{false};
  std::atomic<Phase> phase_{Phase::waiting};
  std::atomic<int> task_{-1};
  std::atomic<std::uint64_t> skipped_{0};
  std::atomic<double> elapsed_{0.0}, progress_{-1.0}, force_{0.0};  ///< [s], share, [N]
  std::mutex changing_;  ///< of the phase, for whoever waits for another one
  std::condition_variable changed_;
  mutable std::mutex mutex_;  ///< of those below
  const lang::Program* program_;
  std::string outcome_, reason_;
  std::thread thread_;
};

}  // namespace zwang::connect
