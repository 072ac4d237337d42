#include "study/study_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zwang::study {

namespace {

ClaimReport report_of_claim(const lang::Study& study, std::size_t number,
                            const std::vector<CellRecord>& records,
                            const std::map<std::string, std::size_t>& group_of) {
  ClaimReport report;
  report.claim = study.claims[number];
  report.runs = records.size();
  std::vector<double> margins, misses;
  std::vector<std::size_t> groups, groups_of_margins;  // the drawn cell of the scenario
  std::vector<const CellRecord*> with_margin;
  for (const CellRecord& record : records) {
    const ExpectationRecord& one = record.expectations[number];
    report.held += one.held ? 1U : 0U;
    misses.push_back(one.held ? 0.0 : 1.0);
    groups.push_back(group_of.at(record.of_matrix));
    if (!one.margin) continue;
    margins.push_back(*one.margin);
    groups_of_margins.push_back(groups.back());
    with_margin.push_back(&record);
  }
  const double confidence = report.claim.confidence;
  if (report.runs > 0) report.interval = clopper_pearson(report.held, report.runs, confidence);
  report.verdict = judge(report.held, report.runs, report.claim.probability, confidence);
  for (std::size_t i = 0; i < study.draws.size(); ++i) {
    std::vector<double> of_all, of_margins;
    for (const CellRecord& record : records) of_all.push_back(record.drawn[i]);
    for (const CellRecord* record : with_margin) of_margins.push_back(record->drawn[i]);
    report.correlations.push_back({study.draws[i].name,
                                   rank_correlation_within(of_margins, margins, groups_of_margins),
                                   rank_correlation_within(of_all, misses, groups)});
  }
  if (margins.empty()) return report;
  std::sort(margins.begin(), margins.end());
  report.margins.emplace();
  for (std::size_t i = 0; i < margin_shares.size(); ++i)
    (*report.margins)[i] = quantile_of(margins, margin_shares[i]);
  return report;
}

/// The expectation that came nearest to a miss, or beyond.
WorstCell worst_of(const CellRecord& record) {
  WorstCell worst{record, 0, std::nullopt};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < record.expectations.size(); ++i) {
    const ExpectationRecord& one = record.expectations[i];
    // Of an outcome nothing is a share: a miss is as bad as can be, and a hit says nothing.
    const double miss =
        one.held ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
    const double margin = one.margin.value_or(miss);
    if (margin >= least) continue;
    least = margin;
    worst.claim = i;
    worst.margin = one.margin;
  }
  return worst;
}

double order_of(const WorstCell& cell) {
  if (cell.margin) return *cell.margin;
  const bool is_missed = !cell.record.expectations.empty() && !cell.record.expectations[cell.claim].held;
  return is_missed ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
}

}  // namespace

bool StudyReport::is_broken() const {
  return std::ranges::any_of(claims, [](const ClaimReport& c) { return c.verdict == Verdict::broken; });
}

StudyReport report_of(const lang::Study& study, std::size_t wanted, const std::vector<CellRecord>& records) {
  StudyReport report;
  report.wanted = wanted;
  report.runs = records.size();
  std::map<std::string, GroupReport> groups;
  for (const CellRecord& record : records) {
    ++report.outcomes[record.outcome];
    GroupReport& group = groups[record.of_matrix];
    group.name = record.of_matrix;
    ++group.runs;
    group.holds += record.holds() ? 1U : 0U;
    report.worst.push_back(worst_of(record));
    const std::optional<double>& margin = report.worst.back().margin;
    if (margin) group.margin = std::min(group.margin.value_or(*margin), *margin);
  }
  std::map<std::string, std::size_t> group_of;
  for (const auto& [name, group] : groups) group_of.emplace(name, group_of.size());
  for (std::size_t i = 0; i < study.claims.size(); ++i)
    report.claims.push_back(report_of_claim(study, i, records, group_of));
  if (study.scenario.cells.size() > 1) {
    for (const auto& [name, group] : groups) report.groups.push_back(group);
  }
  std::ranges::stable_sort(report.worst, {}, order_of);
  report.worst.resize(std::min(report.worst.size(), most_worst));
  std::erase_if(report.worst, [](const WorstCell& cell) {
    return order_of(cell) == std::numeric_limits<double>::infinity();
  });
  return report;
}

}  // namespace zwang::study
