#include "zwang/runtime/replay.hpp"

#include <unistd.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "run/command_columns.hpp"
#include "run/run_facts.hpp"
#include "run/sensed_columns.hpp"
#include "run/snapshot_signals.hpp"
#include "zwang/lang/start.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A folder of one's own.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "zwang_replay_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("replay: cannot make a temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  /// Where a file of the run stands here, whatever it was called there: `..` leads out of nothing.
  fs::path of(const std::string& file) const {
    const fs::path path(file);
    if (path.is_absolute()) return (path_ / "absolute" / path.relative_path()).lexically_normal();
    fs::path inside = (path_ / "a/b/c/d/e/f/g/h" / path).lexically_normal();
    const std::string top = path_.string() + "/";
    if (inside.string().compare(0, top.size(), top) != 0)
      throw std::runtime_error("replay: `" + file + "` leads too far up");
    return inside;
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

double number_of(const std::string& text) {
  const std::optional<double> value = number_in(text);
  if (!value) throw std::runtime_error("replay: `" + text + "` in the log is not a number");
  return *value;
}

double value_of(const json& record, const std::string& column) {
  const auto found = record.find(column);
  if (found == record.end()) return std::numeric_limits<double>::quiet_NaN();
  return found->is_number() ? found->get<double>() : std::numeric_limits<double>::infinity();
}

/// A stop that the runner did not come to by itself.
EventCode outside_stop(const json& record) {
  const auto event = record.find("event");
  if (event == record.end() || !event->is_string()) return EventCode::none;
  for (const EventCode code : {EventCode::requested, EventCode::watchdog, EventCode::plant}) {
    if (*event == to_string(code)) return code;
  }
  return EventCode::none;
}

/// The stop was latched when this record was written.
bool is_stopped(const json& record) {
  const auto guard = record.find("guard");
  return guard != record.end() && *guard == to_string(GuardStatus::stopped);
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Where the run started, in the place of what its scene says.
lang::Start start_of(const LogContext& context) {
  lang::Start start;
  if (const auto yaw = context.facts.find("start_yaw [rad]"); yaw != context.facts.end())
    start.yaw = number_of(yaw->second);
  if (const auto at = context.facts.find("start_at [m]"); at != context.facts.end()) {
    const std::size_t comma = at->second.find(", ");
    if (comma == std::string::npos) throw std::runtime_error("replay: the log has no point in `start_at`");
    start.at = {number_of(at->second.substr(0, comma)), number_of(at->second.substr(comma + 2))};
  }
  return start;
}

}  // namespace

std::optional<lang::Program> logged_program(const LogContext& context, lang::Diagnostics& diagnostics) {
  const auto task = context.facts.find("task");
  if (task == context.facts.end() || context.sources.empty())
    throw std::runtime_error("replay: the log does not hold the files of the run");
  const TemporaryFolder folder;
  const std::ofstream root(folder.path() / ".zwang-root");
  for (const lang::Source& source : context.sources) {
    const fs::path path = folder.of(source.path);
    fs::create_directories(path.parent_path());
    std::ofstream out(path, std::ios::binary);
    out << source.text;
    if (!out) throw std::runtime_error("replay: cannot write " + path.string());
  }
  lang::LoadOptions options;
  options.root = folder.path();
  if (const auto robot = context.facts.find("robot"); robot != context.facts.end())
    options.robot = folder.of(robot->second);
  if (const auto scene = context.facts.find("scene"); scene != context.facts.end())
    options.scene = folder.of(scene->second);
  std::optional<lang::Program> program =
      lang::load_from(start_of(context), folder.of(task->second), options, diagnostics);
  if (!program) return program;
  for (lang::Parameter& parameter : program->parameters) {
    const auto set = context.facts.find("params." + parameter.name);
    if (set != context.facts.end()) parameter.value = number_of(set->second);
  }
  if (const auto blend = context.facts.find("blend [s]"); blend != context.facts.end()) {
    for (lang::Task& each : program->tasks) each.blend = {.constant = number_of(blend->second)};
  }
  return program;
}

namespace {

/// The snapshots of all parts are laid out for the first program, which `swap_program` has matched.
std::vector<std::size_t> places_in(const lang::Program& first, const lang::Program& program) {
  SnapshotSignals measured(first), own(program);
  own.go_on_from(measured);
  return own.places();
}

void replay_part(const lang::Program& first, const ReplayPart& part, Runner& runner, ReplayResult& result) {
  const lang::Program& program = part.program;
  const solver::Model& model = program.robot.model;
  const bool takes_velocity = program.robot.drive.takes_velocity;
  SensedColumns inputs(model, program.signals, program.parameters, program.robot.drive);
  inputs.signals_at(places_in(first, program));
  Sensed sensed(first);
  std::vector<double> parameters(program.parameters.size());
  std::vector<double> values(inputs.columns().size());
  std::vector<std::string> torques;
  std::vector<std::array<CommandColumn, 3>> commands;
  for (int j = 0; j < model.joint_count(); ++j) {
    torques.push_back(model.joint(j).name + ".tau");
    commands.push_back(command_columns(model.joint(j)));
  }
  const auto compare = [&](double time, std::string_view text) {
    const json record = json::parse(text, nullptr, false);
    if (!record.is_object()) throw std::runtime_error("replay: a record is no JSON object");
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = value_of(record, inputs.columns()[i].name);
    inputs.read(values, sensed, parameters);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (!std::isnan(parameters[i]) && parameters[i] != runner.scheduler().parameters()[i])
        runner.set_parameter(program.parameters[i].name, parameters[i]);
    }
    if (runner.guard().stopped() && !is_stopped(record)) runner.guard().reset();
    if (const EventCode reason = outside_stop(record); reason != EventCode::none) runner.guard().stop(reason);
    const Eigen::VectorXd& tau = runner.step(sensed);
    bool equal = true;
    const auto compare_one = [&](const std::string& column, double computed) {
      const double logged = value_of(record, column);
      if (same_bits(logged, computed)) return;
      equal = false;
      if (!result.first) result.first = ReplayDifference{time, column, logged, computed};
    };
    for (int j = 0; j < model.joint_count(); ++j) {
      compare_one(torques[static_cast<std::size_t>(j)], tau(j));
      if (!takes_velocity) continue;
      const auto told = command_values(runner.command(), j);
      for (std::size_t k = 0; k < told.size(); ++k)
        compare_one(commands[static_cast<std::size_t>(j)][k].name, told[k]);
    }
    for (int k = 0; program.robot.drive.takes_twist && k < 3; ++k)
      compare_one(twist_columns[static_cast<std::size_t>(k)][0], runner.command().twist(k));
    ++result.records;
    if (equal) ++result.equal;
  };
  const LogContents contents = read_log(part.log, compare);
  if (contents.schema.find("\"sensed.time\"") == std::string::npos)
    throw std::runtime_error("replay: the log does not hold what was sensed");
}

}  // namespace

RunnerSettings logged_settings(const LogContext& context) {
  return settings_of(context.facts);
}

ReplayResult replay(const std::vector<ReplayPart>& parts, const RunnerSettings& settings) {
  ReplayResult result;
  std::optional<Runner> runner;
  for (const ReplayPart& part : parts) {
    Runner next(part.program, settings);
    if (!runner) {
      runner = std::move(next);
    } else if (const SwapResult swap = runner->swap_program(next); !swap) {
      throw std::runtime_error("replay: the program of " + part.log.string() +
                               " cannot go on there: " + describe(swap));
    }
    replay_part(parts.front().program, part, *runner, result);
  }
  return result;
}

ReplayResult replay(const fs::path& log, const lang::Program& program, const RunnerSettings& settings) {
  return replay({{log, program}}, settings);
}

}  // namespace zwang::runtime
