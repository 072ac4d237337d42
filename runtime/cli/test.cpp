#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <sstream>
#include <thread>

#include "file_kind.hpp"
#include "interruption.hpp"
#include "output.hpp"
#include "report_page.hpp"
#include "study/cell_record.hpp"
#include "test_page.hpp"
#include "test_report.hpp"
#include "verbs.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/runtime/scenario_run.hpp"

namespace zwang::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// A file of a folder. A file of an unknown kind is named: it may have been meant as a scenario.
bool is_scenario_or_passed_over(const std::string& path) {
  const std::optional<FileKind> kind = kind_of_file(path);
  if (!kind) print_error("zwang: " + path + " is passed over: its first key is none of zwang's\n");
  return kind == FileKind::scenario;
}

/// In the order given; those of a folder by name.
std::vector<std::string> scenario_files(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    if (!fs::is_directory(path)) {
      require_file(path);
      files.push_back(path);
      continue;
    }
    std::vector<std::string> found = yaml_files_below(path);
    std::erase_if(found, [](const std::string& file) { return !is_scenario_or_passed_over(file); });
    if (found.empty()) throw Impossible(path + ": there is no scenario file in it");
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

/// A run that waits for its thread.
struct Job {
  std::size_t report = 0, cell = 0;
  std::size_t place = 0;  ///< of the cell's result in the report
  const lang::Scenario* scenario = nullptr;
};

/// One line that is written over itself; nothing where stdout is no terminal.
class Progress {
 public:
  Progress(std::size_t runs, bool shown) : runs_(runs), shown_(shown && stdout_can_be_written_over()) {}
  void done(bool passed) {
    const std::lock_guard lock(mutex_);
    ++finished_;
    failed_ += passed ? 0U : 1U;
    if (!shown_) return;
    std::ostringstream line;
    line << finished_ << " of " << runs_ << " runs";
    if (failed_ > 0) line << ", " << failed_ << " failed";
    print_over(line.str());
  }
  void end() const {
    if (shown_) print_over("");
  }

 private:
  std::mutex mutex_;
  std::size_t runs_, finished_ = 0, failed_ = 0;
  bool shown_;
};

/// The readers of YAML and URDF report through handlers of the whole process: one at a time.
class Loader {
 public:
  std::optional<lang::ScenarioRun> load(const Job& job, ScenarioReport& report,
                                        std::vector<std::string>& codes) {
    const std::lock_guard lock(mutex_);
    lang::Diagnostics of_scenario, of_task;
    auto run = lang::load_run(job.scenario->path, job.cell, of_scenario, of_task);
    codes = study::codes_of(of_task);
    if (!run) {
      report.readable = false;
      report.diagnostics = of_scenario;
    }
    return run;
  }

 private:
  std::mutex mutex_;
};

std::optional<CellScene> scene_of(const lang::ScenarioRun& run) {
  if (!run.program || !run.program->scene) return std::nullopt;
  return CellScene{run.program->robot.footprint, run.program->scene->objects};
}

void work(const std::vector<Job>& jobs, std::atomic<std::size_t>& next, Loader& loader,
          std::vector<ScenarioReport>& reports, const std::atomic<bool>& interrupted, Progress& progress) {
  for (std::size_t j = next++; j < jobs.size() && !interrupted; j = next++) {
    const Job& job = jobs[j];
    ScenarioReport& report = reports[job.report];
    const lang::ScenarioCell& cell = job.scenario->cells[job.cell];
    std::vector<std::string> codes;
    runtime::CellResult& result = report.cells[job.place];
    if (const auto run = loader.load(job, report, codes)) {
      result = runtime::run_cell(*job.scenario, cell, *run, codes, &interrupted);
      if (!report.scenes.empty()) report.scenes[job.place] = scene_of(*run);
    } else {
      result.name = cell.name;
      result.outcome = "error";
      result.because = "the scenario file";
    }
    if (is_over(result)) progress.done(result.passed);
  }
}

std::string page_of(const TestArguments& arguments) {
  return arguments.out.value_or("test-report.html");
}

/// Throws, before the runs, where a result could not be written, or something would be lost by it.
void require_places(const TestArguments& arguments) {
  if (arguments.junit) require_place_of_result(*arguments.junit);
  if (!arguments.report) return;
  const std::string page = page_of(arguments);
  require_place_of_result(page);
  if (arguments.junit && fs::absolute(page) == fs::absolute(*arguments.junit))
    throw Impossible(page + ": the page and --junit have this name");
}

}  // namespace

int test(const TestArguments& arguments) {
  require_places(arguments);
  if (arguments.report) page_parts();  // missing ones are told before the runs, not behind them
  const std::vector<std::string> files = scenario_files(arguments.paths);
  std::vector<ScenarioReport> reports(files.size());
  std::vector<std::optional<lang::Scenario>> scenarios(files.size());
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < files.size(); ++i) {
    reports[i].path = files[i];
    scenarios[i] = lang::load_scenario(files[i], reports[i].diagnostics);
    reports[i].readable = scenarios[i].has_value();
    if (!scenarios[i]) continue;
    reports[i].about = scenarios[i]->about;
    for (std::size_t c = 0; c < scenarios[i]->cells.size(); ++c) {
      const lang::ScenarioCell& cell = scenarios[i]->cells[c];
      if (arguments.each_value && !cell.shows_each_value) continue;
      jobs.push_back({i, c, reports[i].cells.size(), &*scenarios[i]});
      reports[i].cells.emplace_back().name = cell.name;
    }
    if (arguments.report) reports[i].scenes.resize(reports[i].cells.size());
  }

  const std::atomic<bool>& interrupted = catch_interruption();
  study::keep_freed_memory();
  const auto begin = Clock::now();
  Progress progress(jobs.size(), arguments.format == Format::human);
  Loader loader;
  std::atomic<std::size_t> next{0};
  const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
  const std::size_t wanted = arguments.jobs > 0 ? static_cast<std::size_t>(arguments.jobs) : cores;
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < std::min(wanted, jobs.size()); ++t)
    threads.emplace_back([&] { work(jobs, next, loader, reports, interrupted, progress); });
  for (std::thread& thread : threads) thread.join();
  progress.end();
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();

  if (arguments.format == Format::json) {
    print_data(json_report(reports, seconds));
  } else {
    print(human_report(reports, seconds));
  }
  if (arguments.report) {
    const std::string page = write_test_page(reports, seconds, page_of(arguments));
    if (arguments.format == Format::human) print("page   " + page + "\n");
  }
  if (arguments.junit) write_file(*arguments.junit, junit_report(reports));
  if (!std::all_of(reports.begin(), reports.end(), passed)) return exit_bad;
  return interrupted ? exit_impossible : exit_good;
}

}  // namespace zwang::cli
