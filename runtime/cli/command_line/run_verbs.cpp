// The verbs that run tasks in the simulation.
#include <memory>

#include "argument_text.hpp"
#include "command_line/command_line.hpp"
#include "shipped.hpp"
#include "zwang/lang/study.hpp"

namespace zwang::cli {

namespace {

void add_sweep(CLI::App& app, Chosen& chosen) {
  const auto arguments = std::make_shared<SweepArguments>();
  CLI::App* verb = app.add_subcommand("sweep", "Run the drawn cells of a study, and say how sure it makes");
  verb->add_option("study", arguments->study, "the study file")->required();
  verb->add_option("-j,--jobs", arguments->jobs,
                   "cells at the same time (default: as many as there are cores)")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--runs", arguments->runs, "cells, in the place of the study's `runs`")
      ->check(CLI::Range(std::size_t{1}, zwang::lang::most_cells_of_a_study));
  verb->add_option("-o,--out", arguments->out,
                   "the SQLite file of results (default STUDY.db); cells that it has are not run again");
  verb->add_flag("--fresh", arguments->fresh, "delete that file first");
  CLI::Option* shard = verb->add_option("--shard", arguments->shard, "run a part of the cells only, as 3/64");
  verb->add_option("--merge", arguments->merged, "take the cells of these files, and run none")
      ->excludes(shard);
  verb->add_option("--cell-limit", arguments->cell_limit, "seconds of real time after which a cell is hung")
      ->check(CLI::Range(1e-3, 1e6));
  verb->add_option("--junit", arguments->junit, "file for a JUnit XML report");
  verb->add_flag("--report", arguments->report,
                 "make a page beside the results: histograms, and each margin over each draw");
  add_format(*verb, arguments->format);
  verb->callback([=, &chosen] {
    arguments->study = file_or_shipped(arguments->study, "studies");
    chosen = [=] { return sweep(*arguments); };
  });
}

void add_test(CLI::App& app, Chosen& chosen) {
  const auto arguments = std::make_shared<TestArguments>();
  CLI::App* verb = app.add_subcommand("test", "Run scenario files and judge what they expect");
  verb->add_option("paths", arguments->paths, "scenario files, or folders that hold some")->required();
  verb->add_option("-j,--jobs", arguments->jobs,
                   "runs at the same time (default: as many as there are cores)")
      ->check(CLI::Range(1, 1024));
  verb->add_flag("--each-value", arguments->each_value,
                 "run only so many cells that each value of a matrix occurs");
  verb->add_option("--junit", arguments->junit, "file for a JUnit XML report");
  CLI::Option* page =
      verb->add_flag("--report", arguments->report, "make a page of all runs, the worst first");
  verb->add_option("-o,--out", arguments->out, "the page to write (default test-report.html)")->needs(page);
  add_format(*verb, arguments->format);
  verb->callback([=, &chosen] {
    for (std::string& path : arguments->paths) path = file_or_shipped(path, "scenarios");
    chosen = [=] { return test(*arguments); };
  });
}

/// As they were typed; what is wrong with them is told when `run` is what was asked for.
struct RunTexts {
  std::optional<std::string> start_yaw, start_at, seed;
  std::vector<std::string> rotation;
  bool is_live = false;
  int port = 0;
};

void read(const RunTexts& texts, RunArguments& arguments) {
  arguments.file = file_or_shipped(arguments.file);
  if (texts.is_live) arguments.live_port = texts.port;
  arguments.rotation = rotation(texts.rotation);
  if (texts.seed) arguments.seed = seed(*texts.seed);
  if (texts.start_yaw) arguments.start_yaw = angle(*texts.start_yaw);
  if (texts.start_at) arguments.start_at = point(*texts.start_at);
}

void add_pace(CLI::App& verb, RunArguments& arguments, RunTexts& texts) {
  CLI::Option* watch =
      verb.add_flag("--watch", arguments.watch,
                    "at the pace of real time; a task file that changes under way is loaded again");
  watch->excludes("--log-rotate");
  CLI::Option* live =
      verb.add_flag("--live", texts.is_live,
                    "at the pace of real time, with a page in the browser that shows and steers it");
  live->excludes(watch)->excludes("--watchdog");
  verb.add_option("--port", texts.port, "of that page on 127.0.0.1 (default any free one)")
      ->needs(live)
      ->check(CLI::Range(1, 65535));
}

void add_run(CLI::App& app, Chosen& chosen) {
  const auto arguments = std::make_shared<RunArguments>();
  const auto texts = std::make_shared<RunTexts>();
  CLI::App* verb = app.add_subcommand("run", "Run a task on the simulated robot");
  verb->add_option("file", arguments->file,
                   "the task file; or a scenario or study file, of which one cell runs")
      ->required();
  verb->add_option("--cell", arguments->cell,
                   "of a scenario: the cell to run, by its name in `zwang test`; of a study by its number");
  add_overrides(*verb, arguments->overrides);
  verb->add_option("--log", arguments->log,
                   "folder for the log (default runs/<task>-NNN); a log in it is written over");
  verb->add_flag("--csv", arguments->csv, "log.csv beside log.mcap; `zwang log RUN` makes one later");
  add_log_limits(*verb, arguments->log_rate, texts->rotation)->excludes("--csv");
  verb->add_option("--seed", texts->seed, "seed of everything random in the run (default 0)");
  verb->add_option("--start-yaw", texts->start_yaw,
                   "heading at the start, in the place of the scene's: `20 deg`");
  verb->add_option("--start-at", texts->start_at,
                   "position at the start, in the place of the scene's: `0 m, 0 m`");
  verb->add_flag("--quiet", arguments->quiet, "no live line, only the report");
  verb->add_flag("--watchdog", arguments->watchdog,
                 "stop as a robot would when no tick happens for 200 ms of real time");
  verb->add_flag("--report", arguments->report, "make a page of the run, report.html beside its log");
  add_pace(*verb, *arguments, *texts);
  add_format(*verb, arguments->format);
  verb->callback([=, &chosen] {
    chosen = [=] {
      read(*texts, *arguments);
      return run(*arguments);
    };
  });
}

}  // namespace

void add_run_verbs(CLI::App& app, Chosen& chosen) {
  add_run(app, chosen);
  add_test(app, chosen);
  add_sweep(app, chosen);
}

}  // namespace zwang::cli
