// Checks of a scenario's cells without running them.
#include <algorithm>
#include <map>
#include <tuple>

#include "check/check.hpp"
#include "check/context.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_scenario.hpp"
#include "load_within.hpp"
#include "scenario/scenario_file.hpp"
#include "scene/check_scene.hpp"
#include "scene/check_start.hpp"
#include "tree/file.hpp"
#include "words/nearest.hpp"

namespace zwang::lang {

namespace {

namespace fs = std::filesystem;

/// The parameters that the task file declares, read from its text among the sources. nullopt: the text could
/// not be read whole. The errors of the task file are not reported here.
std::optional<Symbols> parameters_of(const fs::path& task, const Diagnostics& diagnostics) {
  Diagnostics of_task = diagnostics;
  int source = -1;
  for (std::size_t i = 0; i < of_task.sources().size(); ++i) {
    if (of_task.sources()[i].path == task.string()) source = static_cast<int>(i);
  }
  const std::optional<Document> document = source < 0 ? std::nullopt : read(source, of_task);
  const std::optional<TaskFile> file = document ? parse(*document, of_task) : std::nullopt;
  if (!file || file->is_incomplete) return std::nullopt;
  Symbols symbols;
  const std::optional<Robot> robot;
  const LoadOptions options;
  CheckContext context{*file, robot, options, symbols, of_task};
  check_parameters(context);
  return symbols;
}

void check_named_parameter(const MatrixKey& key, Symbols& symbols, const fs::path& task,
                           Diagnostics& diagnostics) {
  const std::string name = key.name.substr(7);
  const ParameterSymbol* symbol = symbols.find_parameter(name);
  if (symbol == nullptr) {
    const std::vector<std::string> known = symbols.parameter_names();
    diagnostics.add(wording::unknown_task_parameter(key.span, name, nearest(name, known), known,
                                                    task.filename().string()));
    return;
  }
  for (const MatrixValue& value : key.values) check_parameter_value(*symbol, value.word, diagnostics);
}

void check_named_parameters(const ScenarioFile& file, const fs::path& task, Diagnostics& diagnostics) {
  std::optional<Symbols> symbols = parameters_of(task, diagnostics);
  if (!symbols) return;
  for (const auto* keys : {&file.fixed, &file.matrix}) {
    for (const MatrixKey& key : *keys) {
      if (!is_parameter(key.name)) continue;
      Diagnostics found;
      check_named_parameter(key, *symbols, task, found);
      for (const Diagnostic& d : found.all()) {
        if (!expects_refusal(file, {d.code})) diagnostics.add(d);
      }
    }
  }
}

/// The inputs with which the task is loaded: robot, scene and parameters. Cells with the same inputs share
/// the loaded task. The robot's start is not among them: it is checked for E913 only.
using World = std::tuple<std::string, std::string, std::map<std::string, std::string>>;

World world_of(const ScenarioCell& cell) {
  return {cell.robot.value_or("").string(), cell.scene.value_or("").string(), cell.parameters};
}

class CellChecker {
 public:
  CellChecker(const ScenarioFile& file, const Scenario& scenario, Diagnostics& diagnostics)
      : file_(file), scenario_(scenario), diagnostics_(diagnostics) {}

  void check_all() {
    std::map<World, Loaded> programs;
    for (const ScenarioCell& cell : scenario_.cells) {
      const World world = world_of(cell);
      auto known = programs.find(world);
      if (known == programs.end()) {
        if (is_exhausted()) return diagnostics_.add(wording::unasked_cells(file_.task.span, cell.name));
        known = programs.emplace(world, load_cell(cell)).first;
      } else {
        check_start_of(cell, known->second);
      }
      if (known->second.program) check_faults(cell, *known->second.program, diagnostics_);
      if (known->second.is_bad_start) programs.erase(known);  // the next cell may start elsewhere
    }
    complain_of_refusals();
  }

 private:
  struct Refusal {
    const ScenarioCell* cell;
    Diagnostic reason;
    std::string place;  ///< of the reason
  };
  struct Loaded {
    std::optional<Program> program;
    Diagnostics diagnostics;
    bool is_bad_start = false;
  };

  bool is_exhausted() const { return budget_ <= 0.0 || bytes_ > most_bytes; }

  Loaded load_cell(const ScenarioCell& cell) {
    Loaded loaded;
    Diagnostics& of_task = loaded.diagnostics;
    loaded.program = load_within(budget_, scenario_.task, options_of(cell), start_of(cell), of_task);
    for (const Source& source : of_task.sources()) bytes_ += source.text.size();
    if (loaded.program) {
      check_expectations(file_, *loaded.program, diagnostics_);
      accepted_.push_back(&cell);
    } else {
      refuse(cell, of_task);
      loaded.is_bad_start = std::any_of(of_task.all().begin(), of_task.all().end(),
                                        [](const Diagnostic& d) { return d.code == "E913"; });
    }
    return loaded;
  }

  /// Of a cell whose task was loaded for another one.
  void check_start_of(const ScenarioCell& cell, const Loaded& loaded) {
    if (!loaded.program || !loaded.program->scene) return;
    Diagnostics found;
    Scene scene = *loaded.program->scene;
    put_start(start_of(cell), scene);
    check_start(scene, loaded.program->robot, found);
    if (!found.has_errors()) return accepted_.push_back(&cell);
    Diagnostics of_task = loaded.diagnostics;  // with the sources that what was found points into
    for (const Diagnostic& d : found.all()) of_task.add(d);
    refuse(cell, of_task);
  }

  void refuse(const ScenarioCell& cell, const Diagnostics& of_task) {
    std::vector<std::string> codes;
    for (const Diagnostic& d : of_task.all()) {
      if (d.severity == Severity::error) codes.push_back(d.code);
    }
    if (!expects_refusal(file_, codes)) note_refusal(cell, of_task);
  }

  void note_refusal(const ScenarioCell& cell, const Diagnostics& of_task) {
    const auto d = of_task.first_error();
    if (!d) return;
    const std::string place = d->span.exists() ? of_task.source(d->span.source).path : std::string();
    refusals_.push_back({&cell, *d, place + ":" + std::to_string(d->span.begin.line)});
  }

  /// Whether the task file is refused without any cell. Then its errors are no matter of the scenario.
  bool is_refused_alone() {
    Diagnostics of_task;
    return !load_within(budget_, scenario_.task, {}, {}, of_task);
  }

  void complain_of_refusals() {
    if (refusals_.empty() || (accepted_.empty() && is_refused_alone())) return;
    // One cause, one message: a mistake in a scene is the same on all robots.
    std::map<std::pair<std::string, std::string>, std::vector<const Refusal*>> by_cause;
    for (const Refusal& refusal : refusals_)
      by_cause[{refusal.reason.code, refusal.place}].push_back(&refusal);
    for (const auto& [cause, alike] : by_cause) {
      const Refusal& first = *alike.front();
      std::vector<Span> guilty_ones;
      for (const Refusal* refusal : alike) guilty_ones.push_back(guilty(*refusal->cell));
      diagnostics_.add(wording::refused_cell(guilty_ones, first.cell->name, first.reason.code,
                                             first.reason.message, first.place));
    }
  }

  /// The key in which the cell differs from one whose task is accepted. Without such a key: its robot, its
  /// scene, the task.
  Span guilty(const ScenarioCell& cell) const {
    for (const auto& [key, span] : cell.spans) {
      for (const ScenarioCell* other : accepted_) {
        if (differ_in_one(cell, *other, key)) return span;
      }
    }
    for (const char* key : {"robot", "scene", "start_at", "start_yaw"}) {
      const auto found = cell.spans.find(key);
      if (found != cell.spans.end()) return found->second;
    }
    for (const auto& [key, span] : cell.spans) {
      if (is_parameter(key)) return span;
    }
    return file_.task.span;
  }

  static bool differ_in_one(const ScenarioCell& a, const ScenarioCell& b, const std::string& key) {
    auto of_a = a.parameters, of_b = b.parameters;
    if (is_parameter(key)) {
      of_a.erase(key.substr(7));
      of_b.erase(key.substr(7));
    }
    const bool differ = world_of(a) != world_of(b) || start_of(a) != start_of(b);
    return differ && of_a == of_b && (key == "robot" || a.robot == b.robot) &&
           (key == "scene" || a.scene == b.scene) && (key == "start_at" || a.start_at == b.start_at) &&
           (key == "start_yaw" || a.start_yaw == b.start_yaw);
  }

  static constexpr std::size_t most_bytes = 2 << 20;

  const ScenarioFile& file_;
  const Scenario& scenario_;
  Diagnostics& diagnostics_;
  double budget_ = whole_budget;  ///< of all cells together
  std::size_t bytes_ = 0;         ///< read so far
  std::vector<const ScenarioCell*> accepted_;
  std::vector<Refusal> refusals_;
};

}  // namespace

bool expects_refusal(const ScenarioFile& file, const std::vector<std::string>& codes) {
  bool is_refused = false, names_code = false;
  for (const ExpectationText& expected : file.expectations) {
    const bool is_diagnostic = expected.kind == ExpectationKind::diagnostic;
    if (is_diagnostic && std::find(codes.begin(), codes.end(), expected.word.text) != codes.end())
      return true;
    names_code = names_code || is_diagnostic;
    is_refused = is_refused || (expected.kind == ExpectationKind::outcome &&
                                expected.word.text == "refused" && !expected.of.exists());
  }
  return is_refused && !names_code;
}

LoadOptions options_of(const ScenarioCell& cell) {
  LoadOptions options;
  options.robot = cell.robot;
  options.scene = cell.scene;
  options.parameters = cell.parameters;
  return options;
}

Start start_of(const ScenarioCell& cell) {
  return {cell.start_at, cell.start_yaw};
}

namespace {

/// The times of a run from which a fault can count.
std::vector<std::string> onset_names(const Program& program) {
  std::vector<std::string> names;
  for (const Task& task : program.tasks) names.push_back("run.entered." + task.name);
  const auto add = [&](const auto& things) {
    for (const auto& thing : things) {
      names.push_back("truth." + thing.name + ".touched");
      if (thing.dock) names.push_back("truth." + thing.name + ".latched");
    }
  };
  if (program.scene) add(program.scene->objects);
  if (program.scene) add(program.scene->robots);
  return names;
}

}  // namespace

void check_faults(const ScenarioCell& cell, const Program& program, Diagnostics& diagnostics) {
  const std::vector<std::string> onsets = onset_names(program);
  for (const Fault& fault : cell.faults) {
    if (fault.of.empty() || std::ranges::find(onsets, fault.of) != onsets.end()) continue;
    diagnostics.add(wording::unknown_name(fault.of_span, "time of a fault", fault.of, onsets));
  }
  check_faults_for(cell.faults, program.robot, diagnostics);
  if (!program.scene) return;
  check_faults_of_partners(cell.faults, *program.scene, diagnostics);
  check_leaving_objects(cell.faults, *program.scene, diagnostics);
}

std::optional<Scenario> scenario_with_parameters(const ScenarioFile& file, const fs::path& path,
                                                 Diagnostics& diagnostics) {
  std::optional<Scenario> scenario = scenario_of(file, path, diagnostics);
  if (!scenario) return std::nullopt;
  check_named_parameters(file, scenario->task, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  return scenario;
}

std::optional<Scenario> check_scenario(const fs::path& path, Diagnostics& diagnostics) {
  const std::optional<ScenarioFile> file = read_scenario(path, diagnostics);
  std::optional<Scenario> scenario;
  if (file) scenario = scenario_with_parameters(*file, path, diagnostics);
  if (scenario) CellChecker(*file, *scenario, diagnostics).check_all();
  diagnostics.settle();
  if (diagnostics.has_errors()) return std::nullopt;
  return scenario;
}

}  // namespace zwang::lang
