/// The report of `zwang test` about the scenarios that it ran.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "zwang/lang/diagnostic.hpp"
#include "zwang/lang/scenario.hpp"
#include "zwang/runtime/scenario_run.hpp"

namespace zwang::cli {

/// The parts of a run's picture beside the way of its base.
struct CellScene {
  std::vector<solver::Vector3> footprint;  ///< [m] in the base
  std::vector<lang::SceneObject> objects;
};

/// One scenario file: its runs, or why there are none.
struct ScenarioReport {
  std::string path;
  std::string about;
  lang::Diagnostics diagnostics;                 ///< of the scenario file
  std::vector<runtime::CellResult> cells;        ///< in the order of the matrix
  std::vector<std::optional<CellScene>> scenes;  ///< of the cells; empty: nobody asks for them
  bool readable = false;
};

/// It ran to its end: it was not interrupted, nor still to come then.
bool is_over(const runtime::CellResult& cell);
/// Of the runs that are over.
bool passed(const ScenarioReport& report);

/// Every run that is over in a line, those that failed with what they missed; then each expectation with its
/// least margin.
std::string human_report(const std::vector<ScenarioReport>& reports, double seconds);
std::string json_report(const std::vector<ScenarioReport>& reports, double seconds);
std::string junit_report(const std::vector<ScenarioReport>& reports);

}  // namespace zwang::cli
