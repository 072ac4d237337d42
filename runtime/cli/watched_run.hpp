/// The work of `zwang run` beside the simulated robot: stops on request, live view, reloads, report.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <span>
#include <vector>

#include "live_hand.hpp"
#include "live_view.hpp"
#include "reload.hpp"
#include "run_log.hpp"
#include "run_report.hpp"
#include "truth_watch.hpp"
#include "zwang/runtime/simulated_run.hpp"
#include "zwang/runtime/watchdog.hpp"

namespace zwang::cli {

/// One line that is written over itself on a terminal; elsewhere a line for each transition.
class Live {
 public:
  explicit Live(bool shown);
  void show(const runtime::Runner& runner, double time);
  void end();

 private:
  bool shown_;
  bool terminal_;
  unsigned calls_ = 0;
  std::chrono::steady_clock::time_point last_;
};

class WatchedRun final : public runtime::SimulatedRunHost {
 public:
  struct Parts {
    runtime::ScenePlant& plant;
    runtime::Runner& runner;
    const Recorders& recorders;
    const lang::Program& program;
    Reloads* reloads;  ///< null: the task file is not watched
    LiveView* view;    ///< null: no page is served
    const std::atomic<bool>& interrupted;
    Live& live;
    RunReport& report;
  };
  WatchedRun(const Parts& parts, bool with_watchdog);

  /// The run itself, and what it leaves in the report.
  void run(double time_limit);

  bool goes_on() override;
  bool tick(const runtime::Sensed& sensed) override;
  void look_before_step() override;
  void look_after_step(const runtime::Sensed& sensed) override;

 private:
  void conclude(runtime::PlantStatus status, double elapsed);

  Parts parts_;
  std::size_t true_values_;
  std::optional<runtime::HandColumns> by_hand_;
  std::vector<double> truth_;
  TruthWatch watch_;
  std::optional<std::chrono::steady_clock::time_point> give_up_;
  std::optional<runtime::Watchdog> watchdog_;
  bool in_task_ = false;
};

}  // namespace zwang::cli
