#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "colour.hpp"
#include "interruption.hpp"
#include "output.hpp"
#include "plant_start.hpp"
#include "report_page.hpp"
#include "run_log.hpp"
#include "scenario_choice.hpp"
#include "verbs.hpp"
#include "watched_run.hpp"
#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

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

/// The task on its robot in its scene; null where the files do not allow a run.
std::unique_ptr<runtime::ScenePlant> plant_of_run(const RunArguments& arguments, const lang::Program& program,
                                                  lang::Diagnostics& diagnostics) {
  runtime::ScenePlantOptions options = plant_options(program);
  options.seed = arguments.seed.value_or(0);
  if (arguments.choice) options.faults = arguments.choice->faults;
  if (arguments.choice) options.deviation = arguments.choice->deviation;
  return start_plant(program, options, diagnostics);
}

runtime::RunnerSettings runner_settings(const lang::Program& program, bool has_view) {
  runtime::RunnerSettings settings;
  settings.extra_columns = runtime::truth_columns(*program.scene);
  if (has_view) {
    const runtime::HandColumns by_hand(program);
    settings.extra_columns.insert(settings.extra_columns.end(), by_hand.columns().begin(),
                                  by_hand.columns().end());
  }
  return settings;
}

/// One log of the first robot, then one of each partner.
Recorders start_logs(const RunArguments& arguments, const lang::Program& program, const fs::path& folder,
                     const lang::Diagnostics& diagnostics, runtime::ScenePlant& plant,
                     runtime::Runner& runner, LiveView* view) {
  Recorders recorders;
  recorders.push_back(record(arguments, runner, program, folder, "log", context_of(arguments, diagnostics),
                             view != nullptr ? view->begin(program, diagnostics, runner) : nullptr));
  for (std::size_t i = 0; i < plant.partners().size(); ++i) {
    const lang::SceneRobot& robot = program.scene->robots[i];
    recorders.push_back(record(arguments, plant.partners()[i].runner, *plant.partners()[i].program, folder,
                               "log-" + robot.name,
                               context_of(arguments, *program.scene, robot, diagnostics)));
  }
  for (const auto& recorder : recorders) {
    const std::string error = recorder->status().error;
    if (!error.empty()) throw Impossible(error);
  }
  return recorders;
}

/// Writes the conclusion of each log, and closes it. Returns the text that the live view shows at the end.
std::string end_logs(const Recorders& recorders, runtime::ScenePlant& plant, const runtime::Runner& runner,
                     const RunReport& report, const lang::Diagnostics& of_files) {
  const std::size_t partner_logs = plant.partners().size();
  for (std::size_t i = 0; i < partner_logs; ++i)
    recorders[i + 1]->conclude(conclusion(plant.partners()[i], plant.truth().robots[i].base));
  // The log that goes on to the end: the last one of a task file that was loaded again.
  const bool is_reloaded = recorders.size() > partner_logs + 1;
  const std::map<std::string, std::string> ending = conclusion(report, runner, of_files);
  (is_reloaded ? recorders.back() : recorders.front())->conclude(ending);
  for (const auto& recorder : recorders) recorder->close();
  return ending.at("report");
}

void count_records(const Recorders& recorders, std::size_t partner_logs, RunReport& report) {
  for (std::size_t i = 0; i < recorders.size(); ++i) {
    const runtime::RecorderStatus log = recorders[i]->status();
    // The first robot's stand before and behind the partners'.
    if (i == 0 || i > partner_logs) report.records += log.written;
    report.log_processor_time += log.processor_time;
    if (report.log_error.empty()) report.log_error = log.error;
    if (report.log_error.empty() && !log.complete())
      report.log_error = std::to_string(log.dropped) + " records were dropped";
  }
}

/// The report on the terminal, and the exit code.
int tell(const RunArguments& arguments, const RunReport& report, const runtime::Runner& runner,
         const lang::Diagnostics& of_files) {
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

/// The run of files that are good.
int run_program(const RunArguments& arguments, const lang::Program& program, lang::Diagnostics& diagnostics,
                runtime::ScenePlant& plant, LiveView* view, const std::atomic<bool>& interrupted) {
  if (arguments.report) page_parts();  // missing ones are told before the run, not behind it
  const runtime::RunnerSettings settings = runner_settings(program, view != nullptr);
  runtime::Runner runner(program, settings);
  const fs::path folder = make_log_folder(arguments);
  Recorders recorders = start_logs(arguments, program, folder, diagnostics, plant, runner, view);

  const bool talks = !arguments.quiet && arguments.format == Format::human;
  if (talks) print(headline(arguments, program));
  Live live(talks);
  RunReport report;
  report.seed = arguments.seed.value_or(0);
  report.logs.push_back((folder / log_name(arguments, "log")).string());
  if (view != nullptr) view->wait_for_page(interrupted);
  const auto begin = Clock::now();
  const double processor_time = processor_time_so_far();
  std::optional<Reloads> reloads;
  if (arguments.watch) reloads.emplace(arguments, folder, diagnostics, settings, recorders);
  WatchedRun watched(
      {plant, runner, recorders, program, reloads ? &*reloads : nullptr, view, interrupted, live, report},
      arguments.watchdog);
  watched.run(arguments.choice ? arguments.choice->time_limit : std::numeric_limits<double>::infinity());
  if (reloads) {
    reloads->end();
    report.before = reloads->before();
    report.logs.insert(report.logs.end(), reloads->logs().begin(), reloads->logs().end());
  }
  report.wall_time = std::chrono::duration<double>(Clock::now() - begin).count();
  const lang::Diagnostics& of_files = reloads ? reloads->diagnostics() : diagnostics;
  const std::string ending = end_logs(recorders, plant, runner, report, of_files);
  report.processor_time = processor_time_so_far() - processor_time;
  if (view != nullptr) view->end(ending);
  live.end();
  count_records(recorders, plant.partners().size(), report);
  if (arguments.report) report.page = write_page(folder.string(), std::nullopt);
  return tell(arguments, report, runner, of_files);
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
  if (program && program->scene && !diagnostics.has_errors())
    plant = plant_of_run(arguments, *program, diagnostics);
  const bool refused = !program || diagnostics.has_errors();
  report_diagnostics(diagnostics, refused, arguments.format);
  if (refused) return exit_bad;
  if (!program->scene)
    throw Impossible(arguments.file + ": names no scene to run in; give one with --scene FILE");
  return run_program(arguments, *program, diagnostics, *plant, view, interrupted);
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
