#include "zwang/runtime/replay.hpp"

#include <unistd.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <span>
#include <stdexcept>

#include "run/command_columns.hpp"
#include "run/run_facts.hpp"
#include "run/sensed_columns.hpp"
#include "run/snapshot_signals.hpp"
#include "zwang/lang/start.hpp"
#include "zwang/runtime/log_parts.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {

namespace {

namespace fs = std::filesystem;

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

/// A record by the names of its columns.
class LoggedRecord {
 public:
  explicit LoggedRecord(const std::vector<LoggedColumn>& columns)
      : columns_(columns), event_(place("event")), guard_(place("guard")) {}

  std::size_t place(std::string_view column) const { return place_of(columns_, column); }
  void take(std::span<const double> values) { values_ = values; }
  /// NaN where it is blank or not logged.
  double operator[](std::size_t place) const {
    return place < values_.size() ? values_[place] : std::numeric_limits<double>::quiet_NaN();
  }

  /// A stop that the runner did not come to by itself.
  EventCode outside_stop() const {
    for (const EventCode code : {EventCode::requested, EventCode::watchdog, EventCode::plant}) {
      if (is_word(event_, to_string(code))) return code;
    }
    return EventCode::none;
  }
  /// The stop was latched when this record was written.
  bool is_stopped() const { return is_word(guard_, to_string(GuardStatus::stopped)); }

 private:
  bool is_word(std::size_t place, std::string_view word) const {
    return place < values_.size() && columns_[place].word(values_[place]) == word;
  }

  std::vector<LoggedColumn> columns_;
  std::size_t event_, guard_;
  std::span<const double> values_;
};

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

/// The commands of a runner, beside those of a record.
class CommandCheck {
 public:
  CommandCheck(const lang::Program& program, const LoggedRecord& record) : program_(program) {
    const solver::Model& model = program.robot.model;
    for (int j = 0; j < model.joint_count(); ++j) {
      note(record, model.joint(j).name + ".tau");
      if (!program.robot.drive.takes_velocity) continue;
      for (const CommandColumn& column : command_columns(model.joint(j))) note(record, column.name);
    }
    if (!program.robot.drive.takes_twist) return;
    for (const auto& column : twist_columns) note(record, column[0]);
  }

  /// Whether they are the same to the last bit; the first that is not goes into the result.
  bool is_equal(double time, const LoggedRecord& record, const Runner& runner, const Eigen::VectorXd& tau,
                ReplayResult& result) const {
    bool equal = true;
    std::size_t next = 0;
    const auto compare = [&](double computed) {
      const auto& [name, place] = columns_[next++];
      const double logged = record[place];
      if (same_bits(logged, computed)) return;
      equal = false;
      if (!result.first) result.first = ReplayDifference{time, name, logged, computed};
    };
    for (int j = 0; j < program_.robot.model.joint_count(); ++j) {
      compare(tau(j));
      if (!program_.robot.drive.takes_velocity) continue;
      for (const double told : command_values(runner.command(), j)) compare(told);
    }
    for (int k = 0; program_.robot.drive.takes_twist && k < 3; ++k) compare(runner.command().twist(k));
    return equal;
  }

 private:
  void note(const LoggedRecord& record, const std::string& name) {
    columns_.emplace_back(name, record.place(name));
  }

  const lang::Program& program_;
  std::vector<std::pair<std::string, std::size_t>> columns_;  ///< in the order of the comparison
};

/// Steps a runner through the records of a part.
class PartReplay {
 public:
  PartReplay(const lang::Program& first, const ReplayPart& part, Runner& runner, ReplayResult& result)
      : program_(part.program),
        runner_(runner),
        result_(result),
        inputs_(program_.robot.model, program_.signals, program_.parameters, program_.robot.drive),
        sensed_(first),
        parameters_(program_.parameters.size()),
        values_(inputs_.columns().size()) {
    inputs_.signals_at(places_in(first, program_));
  }

  void begin(const LogContents& head) {
    if (place_of(head.columns, "sensed.time") == head.columns.size())
      throw std::runtime_error("replay: the log does not hold what was sensed");
    if (const auto rate = head.context.facts.find(log_rate_fact); rate != head.context.facts.end())
      throw std::runtime_error("replay: the log was written with --log-rate " + rate->second +
                               ", and a replay needs the record of each tick");
    record_.emplace(head.columns);
    check_.emplace(program_, *record_);
    for (const Column& column : inputs_.columns()) places_.push_back(record_->place(column.name));
  }

  void step(double time, std::span<const double> values) {
    LoggedRecord& record = *record_;
    record.take(values);
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = record[places_[i]];
    inputs_.read(values_, sensed_, parameters_);
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      if (!std::isnan(parameters_[i]) && parameters_[i] != runner_.scheduler().parameters()[i])
        runner_.set_parameter(program_.parameters[i].name, parameters_[i]);
    }
    if (runner_.guard().stopped() && !record.is_stopped()) runner_.guard().reset();
    if (const EventCode reason = record.outside_stop(); reason != EventCode::none)
      runner_.guard().stop(reason);
    const Eigen::VectorXd& tau = runner_.step(sensed_);
    ++result_.records;
    if (check_->is_equal(time, record, runner_, tau, result_)) ++result_.equal;
  }

 private:
  const lang::Program& program_;
  Runner& runner_;
  ReplayResult& result_;
  SensedColumns inputs_;
  Sensed sensed_;
  std::vector<double> parameters_, values_;
  std::optional<LoggedRecord> record_;
  std::optional<CommandCheck> check_;
  std::vector<std::size_t> places_;  ///< of the inputs, in a record
};

void replay_part(const lang::Program& first, const ReplayPart& part, Runner& runner, ReplayResult& result) {
  PartReplay steps(first, part, runner, result);
  read_log(
      part.log, [&](double time, std::span<const double> values) { steps.step(time, values); },
      [&](const LogContents& head) { steps.begin(head); });
}

}  // namespace

RunnerSettings logged_settings(const LogContext& context) {
  return settings_of(context.facts);
}

ReplayResult replay(const std::vector<ReplayPart>& parts, const RunnerSettings& settings) {
  ReplayResult result;
  std::optional<Runner> runner;
  for (const ReplayPart& part : parts) {
    if (runner && part.has_program_of_before) {
      replay_part(parts.front().program, part, *runner, result);
      continue;
    }
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
