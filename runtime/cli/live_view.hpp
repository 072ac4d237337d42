/// `zwang run --live`: the page of a run while it goes on.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <string>

#include "live_hand.hpp"
#include "live_server.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/recorder.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::cli {

/// Serves the page, keeps the run at the pace that the page asks for, and sets the parameters that it moves.
/// The control loop calls `wait_for_tick`. Nothing that a browser does, or does not do, makes it wait longer
/// than the pace says.
class LiveView {
 public:
  /// Listens, and tells where. Throws Impossible.
  explicit LiveView(int port);

  /// Starts a run. The returned sink records it; it lives no longer than the view.
  std::unique_ptr<runtime::LogSink> begin(const lang::Program& program, const lang::Diagnostics& diagnostics,
                                          const runtime::Runner& runner);
  bool has_begun() const { return has_begun_; }
  /// Until the first page is open, or somebody interrupts. The run makes its first tick, and goes on when
  /// that page is built, or 5 s later.
  void wait_for_page(const std::atomic<bool>& interrupted);

  /// Between two ticks. `time` [s] is that of the run.
  void wait_for_tick(runtime::Runner& runner, double time, const std::atomic<bool>& interrupted);
  /// The actions of a person on the simulated world by the page. Their push ends with the last page.
  const runtime::Hand& hand() const { return hand_.hand(); }
  /// The page wants the run from its begin.
  bool is_restart_asked() const { return restart_; }

  /// The run is over. `report` is the one that its log holds.
  void end(const std::string& report);
  /// Until the page wants another run. False: somebody interrupted.
  bool wait_for_restart(const std::atomic<bool>& interrupted);

 private:
  using Clock = std::chrono::steady_clock;
  void look(runtime::Runner* runner);
  void obey(const std::string& request, runtime::Runner* runner);
  void set(runtime::Runner& runner, const std::string& name, double value);
  void begin_pace(double time);
  void tell_state();

  LiveServer server_;
  std::vector<lang::Parameter> parameters_;
  bool has_begun_ = false, is_over_ = false, restart_ = false;
  bool paused_ = false;
  bool is_ready_ = false;       ///< the page is built
  Clock::time_point ready_by_;  ///< a page that is not built by then is not waited for
  LiveHand hand_;
  int ticks_ = 0;       ///< to make although it is paused
  double speed_ = 1.0;  ///< 1: real time
  double now_ = 0.0;    ///< [s] of the run
  double since_time_ = 0.0;
  Clock::time_point since_;
  std::string refused_;  ///< what the last request asked in vain
};

}  // namespace zwang::cli
