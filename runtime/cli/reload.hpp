/// `zwang run --watch`: a task file that changes while it runs.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "run_log.hpp"
#include "run_report.hpp"

namespace zwang::cli {

/// Looks at the files of a run on a thread of its own. When one has changed, and then stayed unchanged for a
/// moment, all are loaded. With an error the diagnostics are printed and the old program goes on. Otherwise
/// the new one is swapped in between two ticks, at its start task, and a new log continues the last one. The
/// robot, the scene and the signals are those of the run's start. If another file than the task's has changed
/// since then, that is reported, and nothing is swapped in.
class Reloads {
 public:
  /// The referenced objects must outlive it.
  Reloads(const RunArguments& arguments, std::filesystem::path folder, const lang::Diagnostics& diagnostics,
          const runtime::RunnerSettings& settings, Recorders& recorders);
  ~Reloads();
  Reloads(const Reloads&) = delete;
  Reloads& operator=(const Reloads&) = delete;

  /// Looks no more.
  void end();
  /// Of the program that runs now.
  const lang::Diagnostics& diagnostics() const { return past_.empty() ? first_ : past_.back()->diagnostics; }
  /// The programs that ran before it.
  std::vector<Chapter> before() const;
  /// Its logs, beside the first.
  const std::vector<std::string>& logs() const { return logs_; }

  /// Between two ticks. Keeps the run at the pace of real time, too, so that a person can watch it.
  void look(runtime::Runner& runner, double time);

 private:
  struct Loaded {
    std::optional<lang::Program> program;
    lang::Diagnostics diagnostics;
    std::unique_ptr<runtime::Runner> runner;  ///< once swapped in, the one before it
    double at = 0.0;                          ///< [s] when it was
  };
  using Stamps = std::vector<std::filesystem::file_time_type>;

  Stamps stamps() const;
  void watch();
  void load();
  std::string changed_beside_the_task() const;
  void tell_refusal(const std::string& why) const;

  const RunArguments& arguments_;
  const std::filesystem::path folder_;
  const lang::Diagnostics& first_;
  const runtime::RunnerSettings& settings_;
  Recorders& recorders_;
  std::vector<std::string> files_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::string last_log_ = "log.mcap";
  std::vector<std::unique_ptr<Loaded>> past_;  ///< those that were swapped in
  std::vector<std::string> logs_;
  std::mutex mutex_;
  std::unique_ptr<Loaded> loaded_;  ///< by the watching thread, for the next tick
  std::atomic<bool> is_loaded_ = false, is_over_ = false;
  std::thread thread_;
};

/// The task file of a run as its arguments want it, from where they let it start.
std::optional<lang::Program> load(const RunArguments& arguments, lang::Diagnostics& diagnostics);

}  // namespace zwang::cli
