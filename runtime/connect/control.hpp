/// The services `~/start` and `~/stop` of `zwang drive`, and its topic `~/state`.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "dds.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::connect {

enum class Phase { waiting, ready, running, ended };

class Control {
 public:
  /// `is_alive`: whether samples of the robot come; called on a thread of its own. All of them outlive it.
  Control(const lang::Connection& connection, const lang::Program& program, Participant& participant,
          std::function<bool()> is_alive);
  ~Control();
  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

  bool wants_start() const noexcept { return wants_start_; }
  bool wants_stop() const noexcept { return wants_stop_; }

  void enter(Phase phase) noexcept { phase_ = phase; }
  /// Of the control thread: neither waits nor allocates.
  void note(int task, double elapsed) noexcept {
    task_.store(task, std::memory_order_relaxed);
    elapsed_.store(elapsed, std::memory_order_relaxed);
  }
  /// The last word: `done`, `failed` or `stopped`, and why.
  void end(const std::string& outcome, const std::string& reason);

 private:
  TriggerReply start();
  TriggerReply stop();
  void tell_changes();
  std::string state() const;

  const lang::Connection& connection_;
  const lang::Program& program_;
  Participant& participant_;
  std::function<bool()> is_alive_;
  std::unique_ptr<Writer> writer_;
  std::atomic<bool> wants_start_{false}, wants_stop_{false}, is_over_{false};
  std::atomic<Phase> phase_{Phase::waiting};
  std::atomic<int> task_{-1};
  std::atomic<double> elapsed_{0.0};  ///< [s]
  mutable std::mutex mutex_;
  std::string outcome_, reason_;
  std::thread thread_;
};

/// A text as JSON has it, with its quotes.
std::string quoted(const std::string& text);

}  // namespace zwang::connect
