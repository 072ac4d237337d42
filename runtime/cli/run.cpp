#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>

#include "colour.hpp"
#include "interruption.hpp"
#include "live_view.hpp"
#include "output.hpp"
#include "plant_start.hpp"
#include "reload.hpp"
#include "report_page.hpp"
#include "run_log.hpp"
#include "run_report.hpp"
#include "scenario_choice.hpp"
#include "verbs.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"
#include "zwang/runtime/watchdog.hpp"

namespace zwang::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using runtime::PlantStatus;

constexpr auto terminal_refresh = std::chrono::milliseconds(50);
constexpr auto longest_signal_stop = std::chrono::milliseconds(300);
constexpr double blocked_for = 0.19;  // [s] of real time without a tick: the thread is blocked

void report_diagnostics(const lang::Diagnostics& diagnostics, bool refused, Format format) {
  if (refused && format == Format::json) {
    const nlohmann::ordered_json whole = {
        {"outcome", "refused"},
        {"diagnostics", nlohmann::ordered_json::parse(lang::render_json(diagnostics))}};
    print_data(whole.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    return;
  }
  print_error(rendered(diagnostics));
}

/// One line that is written over itself on a terminal; elsewhere a line for each transition.
class Live {
 public:
  explicit Live(bool shown) : shown_(shown), terminal_(stdout_can_be_written_over()) {}
  void show(const runtime::Runner& runner, double time) {
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
  void end() {
    if (!shown_) return;
    terminal_ ? print_over("") : print("\n");
  }

 private:
  bool shown_;
  bool terminal_;
  unsigned calls_ = 0;
  Clock::time_point last_;
};

/// The run itself; what it leaves is in the arguments and in the report.
void control(runtime::ScenePlant& plant, runtime::Runner& runner, const Recorders& recorders,
             const lang::Program& program, bool with_watchdog, double time_limit, Reloads* reloads,
             LiveView* view, const std::atomic<bool>& interrupted, Live& live, RunReport& report) {
  runtime::Sensed sensed(program);
  const std::size_t true_values = runtime::truth_columns(*program.scene).size();
  std::optional<runtime::HandColumns> by_hand;
  if (view != nullptr) by_hand.emplace(program);
  std::vector<double> truth(true_values + (by_hand ? by_hand->columns().size() : 0));
  runtime::SimulationSteps steps(runner.period());
  TruthWatch watch(plant.truth(), steps.period());
  PlantStatus status = PlantStatus::ok;
  std::optional<Clock::time_point> give_up;
  // The simulated robot waits while nobody steps it: it is enough to see the stop with the next step. Only on
  // request, as the pace of the machine must not decide how a simulated run ends.
  std::optional<runtime::Watchdog> watchdog;
  if (with_watchdog) watchdog.emplace(blocked_for, nullptr);
  while (!runner.finished() && plant.truth().time < time_limit) {
    if (interrupted && !give_up) {
      give_up = Clock::now() + longest_signal_stop;
      runner.guard().stop(runtime::EventCode::requested);
    }
    if (watchdog) {
      watchdog->feed();
      if (watchdog->expired()) runner.guard().stop(runtime::EventCode::watchdog);
    }
    if (give_up && Clock::now() > *give_up) break;
    // A sample that does not arrive is the guard's to count: it is shown the last one again.
    status = plant.sense(sensed);
    if (status == PlantStatus::diverged) break;
    for (const auto& recorder : recorders) recorder->wait_for_room();
    if (steps.tick_is_due()) {
      runtime::put_truth(plant.truth(), *program.scene, truth);
      // Who has asked for the end does not wait for the pace of real time.
      if (reloads != nullptr && !give_up) reloads->look(runner, sensed.time);
      if (view != nullptr && !give_up) view->wait_for_tick(runner, plant.truth().time, interrupted);
      if (view != nullptr && view->is_restart_asked()) break;
      if (view != nullptr) {
        plant.set_hand(view->hand());
        by_hand->put(view->hand(), plant.truth(), std::span(truth).subspan(true_values));
      }
      runner.step(sensed, truth);
      if (runner.state() == runtime::RunState::running && runner.scheduler().transition())
        report.asked = asked_forces(runner.scheduler());
      live.show(runner, sensed.time);
    }
    const bool in_task = runner.state() == runtime::RunState::running;
    status = plant.follow(runner.command());
    if (status != PlantStatus::ok || plant.truth().base.fallen) break;
    watch.look(plant.truth(), runner.scheduler(), in_task);
  }
  if (runner.finished() && status == PlantStatus::ok) plant.end_lean();
  report.outcome = to_string(runner.state());
  if (!runner.finished() && !give_up && status == PlantStatus::ok) report.outcome = "unfinished";
  if (runner.state() == runtime::RunState::stopped) report.because = describe(runner.guard().reason());
  report.ended_early = give_up && !runner.finished();
  report.may_still_move = runner.may_still_move();
  report.why = runner.why();
  if (status != PlantStatus::ok) {
    report.outcome = to_string(status);
    report.because = "the plant " + report.outcome;
    report.why.reset();
  }
  if (status == PlantStatus::ok && plant.truth().base.fallen) {
    report.outcome = "fallen";
    report.because = describe_fall(plant.truth().base);
    if (runner.state() == runtime::RunState::running)
      report.because += ", in `" + task_name(runner.scheduler(), runner.scheduler().task()) + "`";
    report.why.reset();
  }
  report.elapsed = sensed.time;
  report.objects = watch.objects(plant.truth(), runner.scheduler());
  for (std::size_t i = 0; i < plant.partners().size(); ++i)
    report.partners.push_back(partner_report(plant.partners()[i], plant.truth().robots[i].base));
  report.x = plant.truth().x;
  report.y = plant.truth().y;
  report.yaw = plant.truth().yaw;
  report.base = plant.truth().base;
}

/// [s] of all threads.
double processor_time_so_far() {
  timespec taken{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &taken);
  return static_cast<double>(taken.tv_sec) + 1e-9 * static_cast<double>(taken.tv_nsec);
}

std::string headline(const RunArguments& arguments, const lang::Program& program) {
  std::string line = fs::path(arguments.file).filename().string() + ": robot `" + program.robot.name + "`";
  for (const lang::Parameter& p : program.parameters) {
    std::ostringstream value;
    value << p.value / p.unit_scale;
    line += ", " + p.name + " " + value.str() + (p.unit.empty() ? "" : " " + p.unit);
  }
  return line + "\n";
}

int run_once(const RunArguments& asked, LiveView* view, const std::atomic<bool>& interrupted) {
  lang::Diagnostics diagnostics, of_scenario;
  const RunArguments arguments = with_choice(asked, of_scenario);
  if (of_scenario.has_errors()) {
    report_diagnostics(of_scenario, true, arguments.format);
    return exit_bad;
  }
  const std::optional<lang::Program> program = load(arguments, diagnostics);
  std::unique_ptr<runtime::ScenePlant> plant;
  if (program && program->scene && !diagnostics.has_errors()) {
    runtime::ScenePlantOptions options = plant_options(*program);
    options.seed = arguments.seed;
    if (arguments.choice) options.faults = arguments.choice->faults;
    if (arguments.choice) options.deviation = arguments.choice->deviation;
    plant = start_plant(*program, options, diagnostics);
  }
  const bool refused = !program || diagnostics.has_errors();
  report_diagnostics(diagnostics, refused, arguments.format);
  if (refused) return exit_bad;
  if (!program->scene)
    throw Impossible(arguments.file + ": names no scene to run in; give one with --scene FILE");

  if (arguments.report) page_parts();  // missing ones are told before the run, not behind it

  runtime::RunnerSettings settings;
  settings.extra_columns = runtime::truth_columns(*program->scene);
  if (view != nullptr) {
    const runtime::HandColumns by_hand(*program);
    settings.extra_columns.insert(settings.extra_columns.end(), by_hand.columns().begin(),
                                  by_hand.columns().end());
  }
  runtime::Runner runner(*program, settings);

  const fs::path folder = make_log_folder(arguments);
  Recorders recorders;
  recorders.push_back(record(arguments, runner, *program, folder, "log", context_of(arguments, diagnostics),
                             view != nullptr ? view->begin(*program, diagnostics, runner) : nullptr));
  for (std::size_t i = 0; i < plant->partners().size(); ++i) {
    const lang::SceneRobot& robot = program->scene->robots[i];
    recorders.push_back(record(arguments, plant->partners()[i].runner, *plant->partners()[i].program, folder,
                               "log-" + robot.name,
                               context_of(arguments, *program->scene, robot, diagnostics)));
  }

  for (const auto& recorder : recorders) {
    const std::string error = recorder->status().error;
    if (!error.empty()) throw Impossible(error);
  }

  const bool talks = !arguments.quiet && arguments.format == Format::human;
  if (talks) print(headline(arguments, *program));
  Live live(talks);
  RunReport report;
  report.seed = arguments.seed;
  report.logs.push_back((folder / log_name(arguments, "log")).string());
  if (view != nullptr) view->wait_for_page(interrupted);
  const auto begin = Clock::now();
  const double processor_time = processor_time_so_far();
  std::optional<Reloads> reloads;
  if (arguments.watch) reloads.emplace(arguments, folder, diagnostics, settings, recorders);
  const double time_limit =
      arguments.choice ? arguments.choice->time_limit : std::numeric_limits<double>::infinity();
  control(*plant, runner, recorders, *program, arguments.watchdog, time_limit, reloads ? &*reloads : nullptr,
          view, interrupted, live, report);
  if (reloads) {
    reloads->end();
    report.before = reloads->before();
    report.logs.insert(report.logs.end(), reloads->logs().begin(), reloads->logs().end());
  }
  report.wall_time = std::chrono::duration<double>(Clock::now() - begin).count();
  const std::size_t partner_logs = plant->partners().size();
  const lang::Diagnostics& of_files = reloads ? reloads->diagnostics() : diagnostics;
  for (std::size_t i = 0; i < partner_logs; ++i)
    recorders[i + 1]->conclude(conclusion(plant->partners()[i], plant->truth().robots[i].base));
  // The log that goes on to the end: the last one of a task file that was loaded again.
  const bool is_reloaded = recorders.size() > partner_logs + 1;
  const std::map<std::string, std::string> ending = conclusion(report, runner, of_files);
  (is_reloaded ? recorders.back() : recorders.front())->conclude(ending);
  for (const auto& recorder : recorders) recorder->close();
  report.processor_time = processor_time_so_far() - processor_time;
  if (view != nullptr) view->end(ending.at("report"));
  live.end();

  for (std::size_t i = 0; i < recorders.size(); ++i) {
    const runtime::RecorderStatus log = recorders[i]->status();
    // The first robot's stand before and behind the partners'.
    if (i == 0 || i > partner_logs) report.records += log.written;
    report.log_processor_time += log.processor_time;
    if (report.log_error.empty()) report.log_error = log.error;
    if (report.log_error.empty() && !log.complete())
      report.log_error = std::to_string(log.dropped) + " records were dropped";
  }
  if (arguments.report) report.page = write_page(folder.string(), std::nullopt);
  if (arguments.format == Format::json) {
    print_data(json_report(report, runner, of_files));
  } else {
    print(human_report(report, runner, of_files));
  }
  if (!report.log_error.empty()) {
    print_error(marked(Hue::bad, "zwang:") + " the log is incomplete: " + report.log_error + "\n");
    return exit_impossible;
  }
  return report.outcome == "done" ? exit_good : exit_bad;
}

}  // namespace

int run(const RunArguments& arguments) {
  const std::atomic<bool>& interrupted = catch_interruption();
  if (!arguments.live_port) return run_once(arguments, nullptr, interrupted);
  LiveView view(*arguments.live_port);
  int code = run_once(arguments, &view, interrupted);
  // Files that are refused at once have nothing to show.
  while (view.has_begun() && view.wait_for_restart(interrupted))
    code = run_once(arguments, &view, interrupted);
  return code;
}

}  // namespace zwang::cli
