/// A study as its author wrote it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenario/scenario_file.hpp"
#include "zwang/lang/study.hpp"

namespace zwang::lang {

struct DrawText {
  Word name;
  std::optional<Spread> spread;  ///< none: bad, and complained of
  Node numbers;                  ///< the list behind it
  bool is_factor = false;
  Span factor_span{};
};

struct StudyFile {
  Word scenario, cell;  ///< the file that it draws from, and a cell of its matrix; else `own` has the keys
  ScenarioFile own;     ///< of a study that names a scenario: seed, time limit and expectations at most
  bool has_seed = false, has_time_limit = false;
  std::size_t runs = 0;
  Word runs_text;
  Sequence sequence = Sequence::random;
  std::optional<double> probability, confidence;
  std::vector<DrawText> draws;
};

inline constexpr int most_runs = static_cast<int>(most_cells_of_a_study);
inline constexpr std::size_t most_draws = 32;

/// The shape of a study. nullopt when it is none at all.
std::optional<StudyFile> parse_study_file(const Document& document, Diagnostics& diagnostics);

/// The numbers of a draw, each of this dimension. nullopt and E2xx, E932 where they are bad.
std::optional<Distribution> distribution_of(const DrawText& draw, const Dimension& dimension,
                                            Diagnostics& diagnostics);
/// A robot, a scene or a set of faults to choose from. Paths are seen from `folder`, where the scenario is;
/// the study stands in `own_folder`. nullopt and E932 where nothing can be chosen.
std::optional<MatrixKey> matrix_key_of(const DrawText& draw, const std::filesystem::path& own_folder,
                                       const std::filesystem::path& folder, Diagnostics& diagnostics);

}  // namespace zwang::lang
