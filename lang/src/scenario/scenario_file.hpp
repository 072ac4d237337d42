/// A scenario file as its author wrote it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "load_within.hpp"
#include "spec/expression.hpp"
#include "spec/shape.hpp"
#include "spec/value.hpp"
#include "tree/read.hpp"
#include "zwang/lang/scenario.hpp"

namespace zwang::lang {

/// Whether a key of the matrix names a parameter: `params.NAME`.
bool is_parameter(const std::string& key);

/// A value that varies, as one cell has it.
struct MatrixValue {
  std::string label;  ///< for the cell's name
  Word word;          ///< a path, a quantity as text, the name of a set of faults
  std::optional<std::array<double, 2>> at;
  std::optional<double> yaw;
};

struct MatrixKey {
  std::string name;  ///< robot, scene, start_at, start_yaw, params.NAME, faults
  std::vector<MatrixValue> values;
  Span span{};  ///< of the key
};

struct FaultSet {
  std::string name;
  std::vector<Fault> faults;
};

struct ExpectationText {
  ExpectationKind kind = ExpectationKind::outcome;
  Word word;
  double within = 0.0;
  Word of;
  ConditionText that;
  std::optional<double> probability, confidence;  ///< of a study
  Span span;
};

struct ScenarioFile {
  std::string about;
  Word task;
  double time_limit = 600.0;
  std::uint64_t seed = 0;
  std::optional<double> blend;
  std::vector<MatrixKey> fixed;  ///< the keys that stand beside the matrix, with one value each
  std::vector<MatrixKey> matrix;
  std::vector<FaultSet> faults;
  std::vector<ExpectationText> expectations;
};

inline constexpr std::size_t most_cells = 1000;

/// The shape of a scenario file. nullopt when it is not one at all.
std::optional<ScenarioFile> parse_scenario_file(const Document& document, Diagnostics& diagnostics);

/// Its keys behind the version. `of_study`: an expectation may say how sure it must be.
void parse_scenario_keys(MapReader& map, bool of_study, ScenarioFile& file, Diagnostics& diagnostics);
/// Whether there is one.
bool parse_time_limit(MapReader& map, ScenarioFile& file, Diagnostics& diagnostics);
bool parse_seed(MapReader& map, ScenarioFile& file, Diagnostics& diagnostics);
void parse_expectations(const Node& node, bool of_study, ScenarioFile& file, Diagnostics& diagnostics);

/// A share that is neither nothing nor all: `99.9 %`, or `'>= 99.9 %'`. E933 otherwise.
std::optional<double> parse_certainty(const Node& node, const std::string& what, Diagnostics& diagnostics);

/// The matrix multiplied out; paths are seen from `path`. nullopt on an error.
std::optional<Scenario> scenario_of(const ScenarioFile& file, const std::filesystem::path& path,
                                    Diagnostics& diagnostics);

/// The same, and E301, E202, E204 and the like for `params` and `matrix.params.NAME`, unless the scenario
/// expects them.
std::optional<Scenario> scenario_with_parameters(const ScenarioFile& file, const std::filesystem::path& path,
                                                 Diagnostics& diagnostics);

/// The options with which a cell's task is loaded.
LoadOptions options_of(const ScenarioCell& cell);
Start start_of(const ScenarioCell& cell);

/// The robots that a cell's faults name, and their motors: E301, E907.
void check_faults(const ScenarioCell& cell, const Program& program, Diagnostics& diagnostics);

/// Whether the scenario says that a task with errors of these codes is refused.
bool expects_refusal(const ScenarioFile& file, const std::vector<std::string>& codes);

std::optional<ScenarioFile> read_scenario(const std::filesystem::path& path, Diagnostics& diagnostics);

/// An expectation in a report: `at end: truth.wall.force < 20 N`.
std::string text_of(const ExpectationText& text);

/// Of a task that was refused: nobody can say what the conditions mean, and nobody needs to.
std::vector<Expectation> expectations_of_words(const ScenarioFile& file);

/// Names and dimensions of what is expected. nullopt on an error.
std::optional<std::vector<Expectation>> check_expectations(const ScenarioFile& file, const Program& program,
                                                           Diagnostics& diagnostics);

}  // namespace zwang::lang
