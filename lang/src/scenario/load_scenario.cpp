#include <limits>

#include "check/check.hpp"
#include "diagnostic/wordings.hpp"
#include "scenario/scenario_file.hpp"
#include "tree/file.hpp"

namespace zwang::lang {

namespace {

namespace fs = std::filesystem;

/// The file that a scenario names. Read here so that one that is not there is the scenario's mistake, where
/// it is named.
std::optional<fs::path> existing_file(const Word& named, const fs::path& path, const fs::path& root,
                                      Diagnostics& diagnostics) {
  const auto file = resolve_path(named.text, path, root, named.span, diagnostics);
  if (file && !read_file(*file, yaml_size_limit, named.span, diagnostics)) return std::nullopt;
  return file;
}

/// Puts values of the matrix into a cell.
class CellMaker {
 public:
  CellMaker(const ScenarioFile& file, const fs::path& path, Diagnostics& diagnostics)
      : file_(file), path_(path), root_(root_of(path)), diagnostics_(diagnostics) {}

  void put(const std::string& key, const MatrixValue& value, ScenarioCell& cell) {
    cell.spans[key] = value.word.span;
    if (key == "robot") {
      cell.robot = existing(value.word);
    } else if (key == "scene") {
      cell.scene = existing(value.word);
    } else if (key == "start_at") {
      cell.start_at = value.at;
    } else if (key == "start_yaw") {
      cell.start_yaw = value.yaw;
    } else if (key == "faults") {
      put_faults(value, cell);
    } else {
      cell.parameters[key.substr(7)] = value.word.text;  // params.NAME
    }
  }

 private:
  /// Looked at once, however many cells it is in.
  std::optional<fs::path> existing(const Word& named) {
    const auto known = found_.find(named.text);
    if (known != found_.end()) return known->second;
    const std::optional<fs::path> file = existing_file(named, path_, root_, diagnostics_);
    if (file) found_.emplace(named.text, *file);
    return file;
  }

  void put_faults(const MatrixValue& value, ScenarioCell& cell) const {
    if (value.word.text == "none") return;
    std::vector<std::string> names{"none"};
    for (const FaultSet& set : file_.faults) {
      names.push_back(set.name);
      if (set.name != value.word.text) continue;
      cell.faults = set.faults;
      cell.fault_set = set.name;
      return;
    }
    diagnostics_.add(wording::unknown_name(value.word.span, "set of faults", value.word.text, names));
  }

  const ScenarioFile& file_;
  const fs::path& path_;
  fs::path root_;
  std::map<std::string, fs::path> found_;
  Diagnostics& diagnostics_;
};

/// The diagonal of the matrix: cell i has the value i of each key, and begins anew at the end of a shorter
/// one. As many cells as the longest key has values.
void mark_each_value(const ScenarioFile& file, std::vector<ScenarioCell>& cells) {
  std::size_t longest = 1;
  for (const MatrixKey& key : file.matrix) longest = std::max(longest, key.values.size());
  for (std::size_t i = 0; i < longest; ++i) {
    std::size_t cell = 0;
    for (const MatrixKey& key : file.matrix) cell = cell * key.values.size() + i % key.values.size();
    cells[cell].shows_each_value = true;
  }
}

/// The product of all keys, the last one varying fastest.
std::vector<ScenarioCell> multiply(const ScenarioFile& file, const fs::path& path, Diagnostics& diagnostics) {
  CellMaker maker(file, path, diagnostics);
  ScenarioCell first;
  for (const MatrixKey& key : file.fixed) maker.put(key.name, key.values.front(), first);
  std::vector<ScenarioCell> cells{first};
  // Stops at the first key that makes them too many: the product of a hostile file need not fit a number.
  std::size_t count = 1;
  for (const MatrixKey& key : file.matrix) {
    count *= std::max<std::size_t>(1, key.values.size());
    if (count <= most_cells) continue;
    diagnostics.add(wording::too_many_cells(key.span, most_cells));
    return {};
  }
  for (const MatrixKey& key : file.matrix) {
    std::vector<ScenarioCell> wider;
    for (const ScenarioCell& cell : cells) {
      for (const MatrixValue& value : key.values) {
        ScenarioCell next = cell;
        maker.put(key.name, value, next);
        next.name += (next.name.empty() ? "" : ", ") + value.label;
        wider.push_back(std::move(next));
      }
    }
    cells = std::move(wider);
    if (diagnostics.has_errors()) return {};
  }
  for (ScenarioCell& cell : cells) {
    if (cell.name.empty()) cell.name = "as written";
  }
  mark_each_value(file, cells);
  return cells;
}

}  // namespace

/// A robot of a scene that was not read.
constexpr int nobody = std::numeric_limits<int>::max();

std::vector<Expectation> expectations_of_words(const ScenarioFile& file) {
  std::vector<Expectation> expectations;
  for (const ExpectationText& text : file.expectations) {
    Expectation expected;
    expected.kind = text.kind;
    expected.word = text.word.text;
    if (text.of.exists()) expected.of_robot = nobody;
    expected.text = text_of(text);
    expected.span = text.span;
    expectations.push_back(std::move(expected));
  }
  return expectations;
}

std::optional<ScenarioFile> read_scenario(const fs::path& path, Diagnostics& diagnostics) {
  const std::optional<int> source = read_file(path, yaml_size_limit, {}, diagnostics);
  if (!source) return std::nullopt;
  const std::optional<Document> document = read(*source, diagnostics);
  if (!document) return std::nullopt;
  std::optional<ScenarioFile> file = parse_scenario_file(*document, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  return file;
}

std::optional<Scenario> scenario_of(const ScenarioFile& file, const fs::path& path,
                                    Diagnostics& diagnostics) {
  Scenario scenario;
  scenario.path = path.string();
  scenario.about = file.about;
  scenario.time_limit = file.time_limit;
  scenario.seed = file.seed;
  scenario.blend = file.blend;
  if (file.task.exists()) {
    if (const auto task = existing_file(file.task, path, root_of(path), diagnostics)) scenario.task = *task;
  }
  scenario.cells = multiply(file, path, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  return scenario;
}

std::optional<Scenario> load_scenario(const fs::path& path, Diagnostics& diagnostics) {
  const std::optional<ScenarioFile> file = read_scenario(path, diagnostics);
  if (!file) return std::nullopt;
  return scenario_with_parameters(*file, path, diagnostics);
}

std::optional<ScenarioRun> load_run(const fs::path& path, std::size_t cell, Diagnostics& of_scenario,
                                    Diagnostics& of_task) {
  const std::optional<ScenarioFile> file = read_scenario(path, of_scenario);
  if (!file) return std::nullopt;
  const std::optional<Scenario> scenario = scenario_of(*file, path, of_scenario);
  if (!scenario) return std::nullopt;
  const ScenarioCell& chosen = scenario->cells.at(cell);
  ScenarioRun run;
  double budget = whole_budget;
  run.program = load_within(budget, scenario->task, options_of(chosen), start_of(chosen), of_task);
  if (!run.program) {
    run.expectations = expectations_of_words(*file);
    return run;
  }
  if (scenario->blend) {
    for (Task& task : run.program->tasks) task.blend = {.constant = *scenario->blend};
  }
  check_faults(chosen, *run.program, of_scenario);
  auto expectations = check_expectations(*file, *run.program, of_scenario);
  if (!expectations) return std::nullopt;
  run.expectations = std::move(*expectations);
  return run;
}

}  // namespace zwang::lang
