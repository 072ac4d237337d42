#include "watched_run.hpp"

#include <algorithm>

#include "output.hpp"
#include "run_json.hpp"

namespace zwang::cli {

namespace {

using Clock = std::chrono::steady_clock;
using runtime::PlantStatus;

constexpr auto terminal_refresh = std::chrono::milliseconds(50);
constexpr auto longest_signal_stop = std::chrono::milliseconds(300);
constexpr double blocked_for = 0.19;  // [s] of real time without a tick: the thread is blocked

}  // namespace

Live::Live(bool shown) : shown_(shown), terminal_(stdout_can_be_written_over()) {}

void Live::show(const runtime::Runner& runner, double time) {
  if (!shown_) return;
  if (terminal_) {
    // The clock is read on few ticks only.
    if (++calls_ % 16 != 0) return;
    const auto now = Clock::now();
    if (now - last_ < terminal_refresh) return;
    last_ = now;
    print_over(live_line(runner, time));
  } else if (const auto& transition = runner.scheduler().transition()) {
    print(transition_line(runner.scheduler(), *transition) + "\n");
  }
}

void Live::end() {
  if (!shown_) return;
  terminal_ ? print_over("") : print("\n");
}

WatchedRun::WatchedRun(const Parts& parts, bool with_watchdog)
    : parts_(parts),
      true_values_(runtime::truth_columns(*parts.program.scene).size()),
      watch_(parts.plant.truth(), parts.program, runtime::SimulationSteps(parts.runner.period()).period()) {
  if (parts.view != nullptr) by_hand_.emplace(parts.program);
  truth_.resize(true_values_ + (by_hand_ ? by_hand_->columns().size() : 0));
  // The simulated robot waits between its steps, so the next step is soon enough to see the stop. The
  // watchdog is only on request: the pace of the machine must not decide how a simulated run ends.
  if (with_watchdog) watchdog_.emplace(blocked_for, nullptr);
}

void WatchedRun::run(double time_limit) {
  runtime::Sensed sensed(parts_.program);
  const PlantStatus status = runtime::run_simulated(parts_.plant, parts_.runner, sensed, time_limit, *this);
  conclude(status, sensed.time);
}

bool WatchedRun::goes_on() {
  if (parts_.interrupted && !give_up_) {
    give_up_ = Clock::now() + longest_signal_stop;
    parts_.runner.guard().stop(runtime::EventCode::requested);
  }
  if (watchdog_) {
    watchdog_->feed();
    if (watchdog_->expired()) parts_.runner.guard().stop(runtime::EventCode::watchdog);
  }
  // Partners write in the plant's steps.
  for (const auto& recorder : parts_.recorders) recorder->wait_for_room();
  return !give_up_ || Clock::now() <= *give_up_;
}

bool WatchedRun::tick(const runtime::Sensed& sensed) {
  runtime::Runner& runner = parts_.runner;
  LiveView* view = parts_.view;
  runtime::put_truth(parts_.plant.truth(), *parts_.program.scene, truth_);
  // After a request to end, the run does not wait for the pace of real time.
  if (parts_.reloads != nullptr && !give_up_) parts_.reloads->look(runner, sensed.time);
  if (view != nullptr && !give_up_)
    view->wait_for_tick(runner, parts_.plant.truth().time, parts_.interrupted);
  if (view != nullptr && view->is_restart_asked()) return false;
  if (view != nullptr) {
    parts_.plant.set_hand(view->hand());
    by_hand_->put(view->hand(), parts_.plant.truth(), std::span(truth_).subspan(true_values_));
  }
  runner.step(sensed, truth_);
  if (runner.state() == runtime::RunState::running && runner.scheduler().transition())
    parts_.report.asked = asked_forces(runner.scheduler());
  parts_.live.show(runner, sensed.time);
  return true;
}

void WatchedRun::look_before_step() {
  in_task_ = parts_.runner.state() == runtime::RunState::running;
}

void WatchedRun::look_after_step(const runtime::Sensed& /*sensed*/) {
  watch_.look(parts_.plant.truth(), parts_.runner.scheduler(), in_task_);
}

void WatchedRun::conclude(PlantStatus status, double elapsed) {
  const runtime::Runner& runner = parts_.runner;
  const runtime::Truth& truth = parts_.plant.truth();
  RunReport& report = parts_.report;
  report.outcome = to_string(runner.state());
  if (!runner.finished() && !give_up_ && status == PlantStatus::ok) report.outcome = "unfinished";
  if (runner.state() == runtime::RunState::stopped) report.because = describe(runner.guard().reason());
  report.ended_early = give_up_ && !runner.finished();
  report.may_still_move = runner.may_still_move();
  report.why = runner.why();
  if (status != PlantStatus::ok) {
    report.outcome = to_string(status);
    report.because = "the plant " + report.outcome;
    report.why.reset();
  }
  for (const lang::Fault& fault : parts_.plant.faults()) {
    if (fault.at < elapsed && !fault.is_drawn) report.faults.push_back({fault.at, fault.span});
  }
  const auto began = [](const FaultReport& a, const FaultReport& b) { return a.at < b.at; };
  std::stable_sort(report.faults.begin(), report.faults.end(), began);
  if (status == PlantStatus::ok && truth.base.fallen) {
    report.outcome = "fallen";
    report.because = describe_fall(truth.base);
    if (runner.state() == runtime::RunState::running)
      report.because += ", in `" + task_name(runner.scheduler(), runner.scheduler().task()) + "`";
    if (!report.faults.empty())
      report.because += ", after " + report.faults.back().whose() + "'s fault of " +
                        with_unit(report.faults.back().at, "s", 4);
    report.why.reset();
  }
  report.elapsed = elapsed;
  report.objects = watch_.objects(truth, runner.scheduler());
  report.hand = watch_.hand();
  const std::vector<runtime::ScenePartner>& partners = parts_.plant.partners();
  for (std::size_t i = 0; i < partners.size(); ++i)
    report.partners.push_back(partner_report(partners[i], truth.robots[i].base));
  report.x = truth.x;
  report.y = truth.y;
  report.yaw = truth.yaw;
  report.base = truth.base;
}

}  // namespace zwang::cli
