/// A study: a scenario whose cells are drawn, and how sure each of its expectations must be.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/diagnostic.hpp"
#include "zwang/lang/scenario.hpp"

namespace zwang::lang {

struct ScenarioFile;

/// The kind of a distribution.
enum class Spread { uniform, log_uniform, normal, choice };

/// How a drawn value is spread.
struct ZWANG_EXPORT Distribution {
  Spread spread = Spread::uniform;
  double first = 0.0;          ///< SI: the lowest value; of a normal one the mean
  double second = 0.0;         ///< SI: the highest value; of a normal one the standard deviation
  std::vector<double> values;  ///< SI, of a choice

  /// The value below which the share `u` of all draws is, 0 < u < 1.
  double quantile(double u) const;
};

/// A value that differs from cell to cell.
struct Draw {
  std::string name;  ///< `robot.mass`, `scene.wall.stiffness`, `params.push`
  Distribution distribution;
  bool is_factor = false;  ///< `times: true`: on what the model, the scene or the scenario says
  std::string unit;        ///< SI; empty of a factor and of a plain number
  Span span;
};

inline constexpr std::size_t most_cells_of_a_study = 10'000'000;

/// The way in which the cells fill the range of the draws.
enum class Sequence { random, halton };

/// How often an expectation must hold. Without a probability each cell must.
struct Claim {
  std::string text;  ///< as in reports
  std::optional<double> probability;
  double confidence = 0.95;
  Span span;
};

/// A checked study file.
struct Study {
  std::string path;
  std::string about;
  /// Each cell of the study draws one of the cells of its matrix. A robot, a scene or a set of faults that is
  /// drawn is a key of the matrix.
  Scenario scenario;
  std::vector<Draw> draws;
  std::vector<Claim> claims;  ///< parallel to the expectations
  std::size_t runs = 0;       ///< cells
  Sequence sequence = Sequence::random;
  std::shared_ptr<const ScenarioFile> file;
  std::shared_ptr<const Diagnostics> read;  ///< with the texts that spans point into
  std::array<double, 2> start_at{};         ///< [m] where the first cell starts, as the scene has it
};

/// Reads and checks a study: each draw exists, and the expectations have a meaning. In the middle of all
/// draws and at the ends of each the task is not refused, or the expectations say so. On any error nullopt,
/// and the diagnostics say why.
ZWANG_EXPORT std::optional<Study> load_study(const std::filesystem::path& path, Diagnostics& diagnostics);

/// A number in (0, 1) for the cell and the draw with these numbers. `halton` fills the unit cube evenly. Any
/// cell can be asked for alone.
ZWANG_EXPORT double drawn_share(Sequence sequence, std::uint64_t seed, std::size_t cell, std::size_t draw);
/// The seed of everything random in the run of the cell.
ZWANG_EXPORT std::uint64_t seed_of_cell(std::uint64_t seed, std::size_t cell);

/// A cell of a study, ready to run.
struct StudyCell {
  Scenario scenario;            ///< its one cell is this one, and its seed the cell's own
  std::size_t matrix_cell = 0;  ///< of the study's scenario
  std::vector<double> drawn;    ///< parallel to the draws, SI

  const ScenarioCell& cell() const { return scenario.cells.front(); }
};
/// The cell with this number, from 0 on. It depends on the study, its seed and the number alone.
ZWANG_EXPORT StudyCell draw_cell(const Study& study, std::size_t index);
/// The same with given shares, one for each draw and one more, the last, for the cell of the matrix.
ZWANG_EXPORT StudyCell draw_cell(const Study& study, const std::vector<double>& shares);

/// As that of a scenario. nullopt where a drawn value is none that can be: `of_study` says which.
/// The cell takes how the simulated robot differs from the task's.
ZWANG_EXPORT std::optional<ScenarioRun> load_run(const Study& study, StudyCell& cell, Diagnostics& of_study,
                                                 Diagnostics& of_task);

/// Clean runs after which a share of at least `probability` is sure: 2995 for 99.9 % at 95 %.
ZWANG_EXPORT std::size_t clean_runs_for(double probability, double confidence);

}  // namespace zwang::lang
