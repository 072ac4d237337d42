/// The verbs of the program, one function and one file each. Each returns the exit code.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "zwang/lang/program.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/lang/schema.hpp"
#include "zwang/runtime/log_parts.hpp"

namespace zwang::lang {
struct Study;
}

namespace zwang::cli {

enum ExitCode {
  exit_good = 0,
  exit_bad = 1,         ///< what was checked is bad, or the task did not reach `done`
  exit_impossible = 2,  ///< the question could not be answered
};

enum class Format { human, json };

/// How what was found is written: for people, one line each, or for programs.
enum class ReportFormat { human, one_line, json, sarif };

/// The replacements of a task file's own statements.
struct TaskOverrides {
  std::optional<std::string> robot, scene;
  std::map<std::string, std::string> parameters;  ///< name -> quantity as text

  bool any() const { return robot || scene || !parameters.empty(); }
  lang::LoadOptions load_options() const;
};

struct ValidateArguments {
  std::vector<std::string> files;  ///< or folders; `-`: the standard input
  std::string stdin_path =
      "stdin.yaml";                 ///< where the text of `-` stands for: paths in it are seen from there
  TaskOverrides overrides;          ///< for the task files among them
  std::optional<std::string> task;  ///< that the connection files among them are checked against
  ReportFormat format = ReportFormat::human;
  bool deny_warnings = false;
  bool notes = false;
};
int validate(const ValidateArguments& arguments);

struct ExplainArguments {
  std::vector<std::string> codes;
  bool all = false;
  bool markdown = false;
};
int explain(const ExplainArguments& arguments);

struct FmtArguments {
  std::vector<std::string> files;
  bool check = false;    ///< only tell
  bool upgrade = false;  ///< task files into the newest version of the language
};
int fmt(const FmtArguments& arguments);

inline const std::map<std::string, lang::FileKind> schema_kinds = {{"task", lang::FileKind::task},
                                                                   {"robot", lang::FileKind::robot},
                                                                   {"scene", lang::FileKind::scene},
                                                                   {"scenario", lang::FileKind::scenario},
                                                                   {"connection", lang::FileKind::connection},
                                                                   {"study", lang::FileKind::study}};

struct SchemaArguments {
  lang::FileKind kind = lang::FileKind::task;
};
int schema(const SchemaArguments& arguments);

enum class GraphFormat { dot, mermaid };

struct GraphArguments {
  std::string file;
  TaskOverrides overrides;
  GraphFormat format = GraphFormat::dot;
};
int graph(const GraphArguments& arguments);

struct TestArguments {
  std::vector<std::string> paths;    ///< scenario files, or folders that are searched for them
  int jobs = 0;                      ///< threads; 0: as many as there are cores
  bool each_value = false;           ///< only so many cells that each value of a matrix occurs
  std::optional<std::string> junit;  ///< file for a JUnit XML report
  bool report = false;               ///< a page of all runs
  std::optional<std::string> out;    ///< of the page; none: test-report.html
  Format format = Format::human;
};
int test(const TestArguments& arguments);

struct SweepArguments {
  std::string study;
  int jobs = 0;                      ///< cells at the same time; 0: as many as there are cores
  std::optional<std::size_t> runs;   ///< in the place of the study's
  std::optional<std::string> out;    ///< the file of results; none: STUDY.db
  std::optional<std::string> shard;  ///< `3/64`
  std::vector<std::string> merged;   ///< files of results to join
  std::optional<std::string> junit;
  double cell_limit = 600.0;  ///< [s] of real time that a cell may take
  bool fresh = false;         ///< without what earlier calls left
  bool report = false;        ///< a page beside the results
  Format format = Format::human;
};
/// Runs the cells of a study that have no result yet, and reports on all.
int sweep(const SweepArguments& arguments);

/// A cell of a scenario or of a study: what a run takes from it beside robot, scene, parameters, start and
/// seed.
struct ScenarioChoice {
  std::string scenario;  ///< its file
  std::size_t cell = 0;
  std::vector<lang::Fault> faults;
  lang::RobotDeviation deviation;
  std::optional<double> blend;               ///< [s]
  double time_limit = 0.0;                   ///< [s]
  std::shared_ptr<const lang::Study> study;  ///< that it is a cell of; none: of a scenario
};

struct RunArguments {
  std::string file;
  TaskOverrides overrides;
  std::optional<std::string> log;
  bool csv = false;                ///< log.csv beside it
  std::optional<double> log_rate;  ///< [1/s] most records
  runtime::LogRotation rotation;
  std::optional<std::uint64_t> seed;  ///< none: 0
  bool quiet = false;
  bool watchdog = false;
  bool watch = false;            ///< files that change are loaded again
  bool report = false;           ///< a page of the run, beside its log
  std::optional<int> live_port;  ///< the page while it runs, at this port; 0: any free one
  Format format = Format::human;
  std::optional<double> start_yaw;                ///< [rad]
  std::optional<std::array<double, 2>> start_at;  ///< [m]
  std::optional<std::string> cell;                ///< of a scenario file, by its name
  std::optional<ScenarioChoice> choice;           ///< what the cell says beside all that
};
int run(const RunArguments& arguments);

/// Of `drive` and `simulate`.
struct ConnectArguments {
  std::string file;        ///< the task file
  std::string connection;  ///< the connection file
  TaskOverrides overrides;
  std::optional<std::string> log;     ///< an .mcap file
  std::optional<double> log_rate;     ///< [1/s] most records
  std::vector<std::string> rotation;  ///< `500 MB`, `1 h`
  std::optional<double> observe;      ///< [s] to look for, and send nothing
  std::optional<double> wait;         ///< [s] for the robot to be there
  std::optional<std::uint64_t> seed;  ///< of a simulated robot
};
/// `verb`: drive or simulate. Does not return where the program for it is there.
int connect(const std::string& verb, const ConnectArguments& arguments);

struct InitArguments {
  std::string folder;
};
int init(const InitArguments& arguments);

int doctor();

/// The language server, over the standard input and output.
int lsp();

struct PlanArguments {
  std::string file;
  TaskOverrides overrides;
  std::optional<std::string> task;
  Format format = Format::human;
};
int plan(const PlanArguments& arguments);

struct RobotInspectArguments {
  std::string file;  ///< a robot file or a bare URDF
  Format format = Format::human;
};
int robot_inspect(const RobotInspectArguments& arguments);

struct RobotInitArguments {
  std::string urdf;
  std::optional<std::string> out;     ///< a new robot file; none: stdout
  std::optional<std::string> update;  ///< a robot file that is there, in the place of `out`
  std::optional<std::string> task;    ///< a use case to write beside it
};
int robot_init(const RobotInitArguments& arguments);

struct ReplayArguments {
  std::string file;
  Format format = Format::human;
};
int replay(const ReplayArguments& arguments);

struct ReportArguments {
  std::string run;                     ///< the folder of a run, or its .mcap
  std::optional<std::string> compare;  ///< another run, to be shown beside it
  std::optional<std::string> out;      ///< none: report.html, or compare.html, beside the log
};
int report(const ReportArguments& arguments);

struct LogArguments {
  std::string run;                 ///< the folder of a run, or its .mcap
  std::optional<std::string> out;  ///< none: the standard output
};
/// Its records as CSV.
int log(const LogArguments& arguments);

struct InfoArguments {
  std::string file;  ///< or the folder of a run
  Format format = Format::human;
};
int info(const InfoArguments& arguments);

}  // namespace zwang::cli
