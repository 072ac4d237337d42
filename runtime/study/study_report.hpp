/// The report of a study: all of its cells together.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/cell_record.hpp"
#include "study/statistics.hpp"

namespace zwang::study {

/// A draw that goes with what an expectation comes to: Spearman's rank correlation, among the cells that drew
/// the same robot, scene and faults.
struct Correlation {
  std::string draw;
  std::optional<double> with_margin, with_misses;
};

inline constexpr std::array margin_shares{0.0, 0.01, 0.05, 0.5};

struct ClaimReport {
  lang::Claim claim;
  std::size_t held = 0, runs = 0;
  Interval interval;  ///< of the share that holds, with the claim's confidence
  Verdict verdict = Verdict::too_few_runs;
  /// So large at most is the margin of these shares of all cells: `margin_shares`; none without margins.
  std::optional<std::array<double, margin_shares.size()>> margins;
  std::vector<Correlation> correlations;  ///< in the order of the draws
};

/// The cells that drew the same cell of the scenario.
struct GroupReport {
  std::string name;
  std::size_t holds = 0, runs = 0;
  std::optional<double> margin;  ///< the least of all expectations
};

struct WorstCell {
  CellRecord record;
  std::size_t claim = 0;  ///< whose margin is least, or that was missed without one
  std::optional<double> margin;
};

inline constexpr std::size_t most_worst = 10;

struct StudyReport {
  std::size_t wanted = 0, runs = 0;
  std::map<std::string, std::size_t> outcomes;
  std::vector<ClaimReport> claims;
  std::vector<GroupReport> groups;  ///< where the scenario has more than one cell
  std::vector<WorstCell> worst;     ///< at most `most_worst`, the worst first

  bool is_broken() const;
};

StudyReport report_of(const lang::Study& study, std::size_t wanted, const std::vector<CellRecord>& records);

/// `command`: what runs one of its cells again, before its number.
std::string human_report(const lang::Study& study, const StudyReport& report, const std::string& command);
std::string json_report(const lang::Study& study, const StudyReport& report);
/// An expectation is a test case: one with too few runs is skipped.
std::string junit_report(const lang::Study& study, const StudyReport& report);

}  // namespace zwang::study
