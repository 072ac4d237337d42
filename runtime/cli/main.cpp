// The program `zwang`. The only file that knows CLI11.
#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <functional>
#include <memory>

#include "argument_text.hpp"
#include "commit.hpp"
#include "outline.hpp"
#include "output.hpp"
#include "robot_identify.hpp"
#include "shipped.hpp"
#include "verbs.hpp"
#include "zwang/lang/nearest.hpp"
#include "zwang/lang/study.hpp"
#include "zwang/version.hpp"

namespace {

using namespace zwang::cli;

const std::map<std::string, Format> formats = {{"human", Format::human}, {"json", Format::json}};

/// The words that an option takes: told as they are written, not with the numbers that they stand for.
template <typename Value>
void takes(CLI::Option* option, const std::map<std::string, Value>& words) {
  std::vector<std::string> names;
  for (const auto& [word, value] : words) names.push_back(word);
  CLI::Transformer to_value(words, CLI::ignore_case);
  to_value.description("");
  option->transform(to_value)->transform(CLI::IsMember(names, CLI::ignore_case))->type_name("TEXT");
}

void add_format(CLI::App& verb, Format& format) {
  takes(verb.add_option("--format", format, "human (default) or json: one object on stdout"), formats);
}

/// The option `--log-rotate`.
CLI::Option* add_log_limits(CLI::App& verb, std::optional<double>& rate, std::vector<std::string>& rotation) {
  verb.add_option("--log-rate", rate, "most records a second, beside switches and events; replay needs all")
      ->check(CLI::Range(1e-3, 1e6));
  const char* words = "a new file after `500 MB` or `10 min`, or after both: log_0.mcap, log_1.mcap ..";
  return verb.add_option("--log-rotate", rotation, words)->allow_extra_args(false);
}

/// What every verb that reads a task file may put in the place of its words.
void add_overrides(CLI::App& verb, TaskOverrides& overrides) {
  verb.add_option("--robot", overrides.robot, "robot file, in the place of the task's own");
  verb.add_option("--scene", overrides.scene, "scene file, in the place of the task's own");
  const auto texts = std::make_shared<std::vector<std::string>>();
  verb.add_option("-p,--param", *texts, "set a parameter: name=value, as push=30N; may be repeated")
      ->allow_extra_args(false);
  verb.parse_complete_callback([texts, &overrides] { overrides.parameters = parameters(*texts); });
}

/// Each verb adds its options and, when it is the one, says what to do.
void add_validate(CLI::App& app, std::function<int()>& chosen) {
  static const std::map<std::string, ReportFormat> report_formats = {{"human", ReportFormat::human},
                                                                     {"short", ReportFormat::one_line},
                                                                     {"json", ReportFormat::json},
                                                                     {"sarif", ReportFormat::sarif}};
  const auto arguments = std::make_shared<ValidateArguments>();
  const auto deny = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand(
      "validate", "Check task, robot, scene, scenario and study files without running them");
  verb->add_option(
          "files", arguments->files,
          "files, whose first key tells what they are, or folders of such files; `-`: the standard input")
      ->required();
  verb->add_option("--stdin-path", arguments->stdin_path, "the file that the text of `-` belongs to");
  takes(verb->add_option("--format", arguments->format,
                         "human (default), short (a line each), json (one object) or sarif (2.1.0)"),
        report_formats);
  verb->add_option("--deny", *deny, "warnings: refuse files with warnings, too")
      ->check(CLI::IsMember({"warnings"}));
  verb->add_flag("--notes", arguments->notes, "show notes as well");
  add_overrides(*verb, arguments->overrides);
  verb->callback([=, &chosen] {
    arguments->deny_warnings = !deny->empty();
    for (std::string& file : arguments->files) file = file_or_shipped(file);
    chosen = [=] { return validate(*arguments); };
  });
}

void add_explain(CLI::App& app, std::function<int()>& chosen) {
  const auto arguments = std::make_shared<ExplainArguments>();
  CLI::App* verb = app.add_subcommand("explain", "Say what a diagnostic means and what to do about it");
  verb->add_option("codes", arguments->codes, "codes, as E201");
  verb->add_flag("--all", arguments->all, "list all codes; with --markdown all pages");
  verb->add_flag("--markdown", arguments->markdown, "the pages of docs/errors");
  verb->callback([=, &chosen] { chosen = [=] { return explain(*arguments); }; });
}

void add_fmt(CLI::App& app, std::function<int()>& chosen) {
  const auto arguments = std::make_shared<FmtArguments>();
  CLI::App* verb = app.add_subcommand("fmt", "Lay files out anew; comments, order and meaning stay");
  verb->add_option("files", arguments->files, "task, robot and scene files")->required();
  verb->add_flag("--check", arguments->check, "change nothing; tell which files would change");
  verb->callback([=, &chosen] { chosen = [=] { return fmt(*arguments); }; });
}

void add_schema(CLI::App& app, std::function<int()>& chosen) {
  const auto arguments = std::make_shared<SchemaArguments>();
  CLI::App* verb = app.add_subcommand("schema", "Print the JSON Schema of a kind of file, for editors");
  takes(verb->add_option("kind", arguments->kind,
                         "task (default), robot, scene, scenario, connection or study"),
        schema_kinds);
  verb->callback([=, &chosen] { chosen = [=] { return schema(*arguments); }; });
}

void add_graph(CLI::App& app, std::function<int()>& chosen) {
  static const std::map<std::string, GraphFormat> graph_formats = {{"dot", GraphFormat::dot},
                                                                   {"mermaid", GraphFormat::mermaid}};
  const auto arguments = std::make_shared<GraphArguments>();
  CLI::App* verb = app.add_subcommand("graph", "Draw the tasks of a file and the ways between them");
  verb->add_option("file", arguments->file, "the task file")->required();
  add_overrides(*verb, arguments->overrides);
  takes(verb->add_option("--format", arguments->format, "dot (default, for Graphviz) or mermaid"),
        graph_formats);
  verb->callback([=, &chosen] {
    arguments->file = file_or_shipped(arguments->file);
    chosen = [=] { return graph(*arguments); };
  });
}

void add_plan(CLI::App& app, std::function<int()>& chosen) {
  const auto arguments = std::make_shared<PlanArguments>();
  CLI::App* verb = app.add_subcommand("plan", "Show the rows of each task and what the robot makes of them");
  verb->add_option("file", arguments->file, "the task file")->required();
  verb->add_option("--task", arguments->task, "this task only");
  add_overrides(*verb, arguments->overrides);
  add_format(*verb, arguments->format);
  verb->callback([=, &chosen] {
    arguments->file = file_or_shipped(arguments->file);
    chosen = [=] { return plan(*arguments); };
  });
}

void add_identify(CLI::App& verb, std::function<int()>& chosen) {
  const auto arguments = std::make_shared<RobotIdentifyArguments>();
  CLI::App* identify = verb.add_subcommand(
      "identify", "Estimate friction and torque constants from logs of the task `identify`");
  identify->add_option("logs", arguments->logs, "logs (.mcap) of one robot")->required();
  CLI::Option* mass = identify->add_option("--mass", arguments->mass, "what the robot weighs, as '46 kg'");
  identify
      ->add_option("--added", arguments->added,
                   "the load in the last log, as '15 kg': the mass is estimated, too")
      ->excludes(mass);
  identify->add_option("--update", arguments->update, "the robot file to write (default the logged one)");
  identify->add_flag("--dry-run", arguments->dry_run, "only print");
  add_format(*identify, arguments->format);
  identify->callback([=, &chosen] { chosen = [=] { return robot_identify(*arguments); }; });
}

void add_robot(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* verb = app.add_subcommand("robot", "Look at a robot, or begin its robot file");
  verb->require_subcommand(1);
  const auto inspected = std::make_shared<RobotInspectArguments>();
  CLI::App* inspect = verb->add_subcommand("inspect", "What the robot is and can do");
  inspect->add_option("file", inspected->file, "a robot file, or a bare URDF")->required();
  add_format(*inspect, inspected->format);
  inspect->callback([=, &chosen] { chosen = [=] { return robot_inspect(*inspected); }; });
  const auto begun = std::make_shared<RobotInitArguments>();
  CLI::App* init = verb->add_subcommand("init", "Write a robot file from a URDF, to be filled in");
  init->add_option("urdf", begun->urdf, "the URDF")->required();
  CLI::Option* out = init->add_option("-o,--out", begun->out, "the robot file to write (default stdout)");
  init->add_option("--update", begun->update, "a robot file to keep, with what is new in the URDF")
      ->excludes(out);
  init->add_option(
      "--task", begun->task,
      "also write a task and its scene for this robot: wall_align, feel_wall, obstacle, docking or "
      "hospital");
  init->callback([=, &chosen] { chosen = [=] { return robot_init(*begun); }; });
  add_identify(*verb, chosen);
}

void add_init(CLI::App& app, std::function<int()>& chosen) {
  const auto arguments = std::make_shared<InitArguments>();
  CLI::App* verb = app.add_subcommand("init", "Make a folder with a task, its robot, scene and scenario");
  verb->add_option("folder", arguments->folder, "a folder that is new or empty")->required();
  verb->callback([=, &chosen] { chosen = [=] { return init(*arguments); }; });
}

void add_drive(CLI::App& app, std::function<int()>& chosen) {
  const auto arguments = std::make_shared<ConnectArguments>();
  CLI::App* verb =
      app.add_subcommand("drive", "Run a task on a real robot that speaks ROS 2: its motors move");
  verb->add_option("file", arguments->file, "the task file")->required();
  verb->add_option("--over", arguments->connection, "the connection file: topics, command")->required();
  add_overrides(*verb, arguments->overrides);
  verb->add_option("--log", arguments->log, "an .mcap file for the log (default: none)");
  add_log_limits(*verb, arguments->log_rate, arguments->rotation);
  verb->add_option("--observe", arguments->observe,
                   "send nothing; for so many seconds tell what comes, and its signs")
      ->check(CLI::Range(0.1, 86400.0));
  verb->add_option("--wait", arguments->wait, "seconds to wait for the robot (default 10)")
      ->check(CLI::Range(0.0, 86400.0));
  verb->callback([=, &chosen] { chosen = [=] { return connect("drive", *arguments); }; });
}

void add_simulate(CLI::App& app, std::function<int()>& chosen) {
  const auto arguments = std::make_shared<ConnectArguments>();
  CLI::App* verb = app.add_subcommand(
      "simulate", "Be the robot of a scene behind the topics of a connection, for `zwang drive`");
  verb->add_option("file", arguments->file, "the task file, whose robot and scene are simulated")->required();
  verb->add_option("--over", arguments->connection, "the connection file that `drive` reads")->required();
  add_overrides(*verb, arguments->overrides);
  verb->add_option("--seed", arguments->seed, "seed of everything random (default 0)");
  verb->callback([=, &chosen] { chosen = [=] { return connect("simulate", *arguments); }; });
}

void add_sweep(CLI::App& app, std::function<int()>& chosen) {
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
  add_format(*verb, arguments->format);
  verb->callback([=, &chosen] {
    arguments->study = file_or_shipped(arguments->study);
    chosen = [=] { return sweep(*arguments); };
  });
}

/// A verb that takes nothing.
CLI::App* add_plain(CLI::App& app, std::function<int()>& chosen, const char* name, const char* words,
                    int (*verb)()) {
  CLI::App* added = app.add_subcommand(name, words);
  added->callback([&chosen, verb] { chosen = verb; });
  return added;
}

OptionOutline outline_of(const CLI::Option& option) {
  OptionOutline outline{{}, option.get_description(), option.get_items_expected_max() > 0};
  for (const std::string& name : option.get_snames()) outline.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) outline.names.push_back("--" + name);
  if (outline.names.empty()) outline.names.push_back(option.get_name(true));
  return outline;
}

VerbOutline outline_of(const CLI::App& verb) {
  VerbOutline outline{verb.get_name(), verb.get_description(), {}, {}, {}};
  for (const CLI::Option* option : verb.get_options()) {
    (option->get_positional() ? outline.arguments : outline.options).push_back(outline_of(*option));
  }
  for (const CLI::App* inner : verb.get_subcommands({})) outline.verbs.push_back(outline_of(*inner));
  return outline;
}

void add_completion(CLI::App& app, std::function<int()>& chosen) {
  static const std::map<std::string, OutlineForm> forms = {{"bash", OutlineForm::bash},
                                                           {"zsh", OutlineForm::zsh},
                                                           {"fish", OutlineForm::fish},
                                                           {"man", OutlineForm::man}};
  const auto form = std::make_shared<OutlineForm>();
  CLI::App* verb = app.add_subcommand("completion", "Print the completions of a shell, or the manual page");
  takes(verb->add_option("form", *form, "bash, zsh, fish or man")->required(), forms);
  verb->callback([=, &app, &chosen] {
    chosen = [=, &app] {
      print(render(outline_of(app), *form));
      return exit_good;
    };
  });
}

/// `runn` is answered with `run`. Empty when the first word is a verb or an option.
std::string unknown_verb(const CLI::App& app, int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "";
  std::vector<std::string> verbs;
  for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
  if (word.empty() || word.front() == '-' || std::find(verbs.begin(), verbs.end(), word) != verbs.end())
    return "";
  const std::string meant = zwang::lang::nearest(word, verbs);
  return "no verb `" + word + "`" + (meant.empty() ? "" : "; did you mean `zwang " + meant + "`?");
}

int parse_and_do(int argc, char** argv) {
  CLI::App app("Checks and runs task files for robots that touch the world.", "zwang");
  const std::string built_from = *commit == '\0' ? "" : std::string(", commit ") + commit;
  app.set_version_flag("--version", "zwang " ZWANG_VERSION + built_from);
  app.require_subcommand(1);

  std::function<int()> chosen;
  add_validate(app, chosen);
  add_explain(app, chosen);
  add_fmt(app, chosen);
  add_schema(app, chosen);
  add_graph(app, chosen);
  add_plan(app, chosen);
  add_robot(app, chosen);
  add_init(app, chosen);
  add_plain(app, chosen, "doctor", "Say what this machine offers, and how to get what is missing", doctor);
  add_plain(app, chosen, "lsp", "Be a language server, which an editor starts and speaks with over stdio",
            lsp)
      ->add_flag("--stdio")
      ->description("as it does anyway; some editors say it");
  add_completion(app, chosen);
  add_drive(app, chosen);
  add_simulate(app, chosen);
  add_sweep(app, chosen);

  RunArguments to_run;
  std::optional<std::string> yaw_text, at_text, seed_text;
  std::vector<std::string> rotation_texts;
  TestArguments to_test;
  CLI::App* test_verb = app.add_subcommand("test", "Run scenario files and judge what they expect");
  test_verb->add_option("paths", to_test.paths, "scenario files, or folders that hold some")->required();
  test_verb
      ->add_option("-j,--jobs", to_test.jobs, "runs at the same time (default: as many as there are cores)")
      ->check(CLI::Range(1, 1024));
  test_verb->add_option("--junit", to_test.junit, "file for a JUnit XML report");
  CLI::Option* with_page =
      test_verb->add_flag("--report", to_test.report, "make a page of all runs, the worst first");
  test_verb->add_option("-o,--out", to_test.out, "the page to write (default test-report.html)")
      ->needs(with_page);
  add_format(*test_verb, to_test.format);

  CLI::App* run_verb = app.add_subcommand("run", "Run a task on the simulated robot");
  run_verb
      ->add_option("file", to_run.file, "the task file; or a scenario or study file, of which one cell runs")
      ->required();
  run_verb->add_option(
      "--cell", to_run.cell,
      "of a scenario: the cell to run, by its name in `zwang test`; of a study by its number");
  add_overrides(*run_verb, to_run.overrides);
  run_verb->add_option("--log", to_run.log,
                       "folder for the log (default runs/<task>-NNN); a log in it is written over");
  run_verb->add_flag("--csv", to_run.csv, "log.csv beside log.mcap; `zwang log RUN` makes one later");
  add_log_limits(*run_verb, to_run.log_rate, rotation_texts)->excludes("--csv");
  run_verb->add_option("--seed", seed_text, "seed of everything random in the run (default 0)");
  run_verb->add_option("--start-yaw", yaw_text,
                       "heading at the start, in the place of the scene's: `20 deg`");
  run_verb->add_option("--start-at", at_text,
                       "position at the start, in the place of the scene's: `0 m, 0 m`");
  run_verb->add_flag("--quiet", to_run.quiet, "no live line, only the report");
  run_verb->add_flag("--watchdog", to_run.watchdog,
                     "stop as a robot would when no tick happens for 200 ms of real time");
  run_verb->add_flag("--report", to_run.report, "make a page of the run, report.html beside its log");
  CLI::Option* watch =
      run_verb->add_flag("--watch", to_run.watch,
                         "at the pace of real time; a task file that changes under way is loaded again");
  watch->excludes("--log-rotate");
  bool is_live = false;
  int port = 0;
  CLI::Option* live = run_verb->add_flag(
      "--live", is_live, "at the pace of real time, with a page in the browser that shows and steers it");
  live->excludes(watch)->excludes("--watchdog");
  run_verb->add_option("--port", port, "of that page on 127.0.0.1 (default any free one)")
      ->needs(live)
      ->check(CLI::Range(1, 65535));
  add_format(*run_verb, to_run.format);

  LogArguments to_write;
  CLI::App* log_verb = app.add_subcommand("log", "Write the records of a log as CSV");
  log_verb->add_option("run", to_write.run, "the folder of the run, or its .mcap file")->required();
  log_verb->add_flag("--csv")->description("as it does anyway");
  log_verb->add_option("-o,--out", to_write.out, "the file to write (default the standard output)");

  InfoArguments to_tell;
  CLI::App* info_verb = app.add_subcommand("info", "Tell what is in the log of a run");
  info_verb->add_option("log", to_tell.file, "the folder of the run, or its .mcap file")->required();
  add_format(*info_verb, to_tell.format);

  ReportArguments to_report;
  CLI::App* report_verb =
      app.add_subcommand("report", "Make a page of a run, or of two: one file, for any browser");
  report_verb->add_option("run", to_report.run, "the folder of the run, or its .mcap file")->required();
  report_verb->add_option("--compare", to_report.compare,
                          "another run: the page shows where the two part, with both in each curve and view");
  report_verb->add_option("-o,--out", to_report.out,
                          "the page to write (default report.html beside the log, or compare.html)");

  ReplayArguments to_replay;
  CLI::App* replay_verb =
      app.add_subcommand("replay", "Compute the torques of a logged run again and compare");
  replay_verb->add_option("log", to_replay.file, "the folder of the run, or its .mcap file")->required();
  add_format(*replay_verb, to_replay.format);

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help, --version
    std::ostringstream text, error;
    app.exit(wanted, text, error);
    print(text.str());
    return exit_good;
  } catch (const CLI::ParseError& mistake) {
    const std::string unknown = unknown_verb(app, argc, argv);
    if (!unknown.empty()) throw Impossible(unknown + "\nTry `zwang --help`.");
    // CLI11's own exit codes say nothing that ours do not.
    std::string verb;  // the innermost that was named
    for (auto below = app.get_subcommands(); !below.empty(); below = below.front()->get_subcommands())
      verb += " " + below.front()->get_name();
    throw Impossible(std::string(mistake.what()) + "\nTry `zwang" + verb + " --help`.");
  }
  if (chosen) return chosen();
  if (test_verb->parsed()) return test(to_test);
  if (log_verb->parsed()) return zwang::cli::log(to_write);
  if (info_verb->parsed()) return info(to_tell);
  if (replay_verb->parsed()) return replay(to_replay);
  if (report_verb->parsed()) return report(to_report);
  to_run.file = file_or_shipped(to_run.file);
  if (is_live) to_run.live_port = port;
  to_run.rotation = rotation(rotation_texts);
  if (seed_text) to_run.seed = seed(*seed_text);
  if (yaw_text) to_run.start_yaw = angle(*yaw_text);
  if (at_text) to_run.start_at = point(*at_text);
  return run(to_run);
}

}  // namespace

int main(int argc, char** argv) {
  // A reader that went away is an error that `print` sees, not a silent death.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    secure_standard_streams();
    return parse_and_do(argc, argv);
  } catch (const std::exception& e) {
    print_error(std::string("zwang: ") + e.what() + "\n");
  } catch (...) {
    print_error("zwang: an unknown error\n");
  }
  return exit_impossible;
}
