// The report of a study for people, programs and continuous integration.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "study/study_report.hpp"
#include "zwang/lang/printable.hpp"

namespace zwang::study {

namespace {

using nlohmann::ordered_json;

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// In percent, with as many digits as tell `rest` from 0.
std::string percent_text(double share, double rest, int digits) {
  rest = std::abs(rest);
  if (rest > 0.0) digits = std::max(digits, static_cast<int>(std::ceil(-std::log10(100.0 * rest))) + 1);
  char text[32];
  std::snprintf(text, sizeof text, "%.*f %%", std::min(digits, 8), 100.0 * share);
  return text;
}

/// A share is told from 0 and from 100 %: 99.97 %.
std::string percent_of(double share) {
  return percent_text(share, std::min(share, 1.0 - share), 2);
}

/// A margin is told from 0 alone.
std::string margin_text(double margin) {
  return percent_text(margin, margin, 1);
}

std::string wanted_text(const lang::Claim& claim) {
  if (!claim.probability) return "each cell";
  return ">= " + short_number(100.0 * *claim.probability) + " % at " +
         short_number(100.0 * claim.confidence) + " %";
}

/// The bound of a correlation by chance for as many cells: chance exceeds it twice in a hundred thousand
/// studies.
double most_by_chance(const ClaimReport& claim) {
  return 4.0 / std::sqrt(std::max<double>(1.0, static_cast<double>(claim.runs) - 1.0));
}

std::string correlations_text(const ClaimReport& claim) {
  std::vector<std::pair<double, std::string>> lines;
  for (const Correlation& one : claim.correlations) {
    const double rho = one.with_margin.value_or(0.0);
    if (std::abs(rho) > most_by_chance(claim))
      lines.emplace_back(-std::abs(rho), one.draw + " " + short_number(rho));
  }
  std::sort(lines.begin(), lines.end());
  std::string text;
  for (const auto& [order, line] : lines) text += (text.empty() ? "" : ", ") + line;
  return text;
}

std::string misses_text(const ClaimReport& claim) {
  std::string text;
  for (const Correlation& one : claim.correlations) {
    const double rho = one.with_misses.value_or(0.0);
    if (std::abs(rho) > most_by_chance(claim))
      text += (text.empty() ? "" : ", ") + one.draw + " " + short_number(rho);
  }
  return text;
}

std::string drawn_text(const lang::Study& study, const CellRecord& record) {
  std::string text = study.scenario.cells.size() > 1 ? record.of_matrix : "";
  for (std::size_t i = 0; i < study.draws.size(); ++i) {
    const std::string& unit = study.draws[i].unit;
    text += (text.empty() ? "" : ", ") + study.draws[i].name + " " + short_number(record.drawn[i]) +
            (unit.empty() ? "" : " " + unit);
  }
  return text;
}

void describe_claim(const ClaimReport& claim, std::ostringstream& out) {
  char line[96];
  std::snprintf(line, sizeof line, "  %-12s  %zu/%zu", to_string(claim.verdict), claim.held, claim.runs);
  out << line << "  " << percent_of(claim.interval.low) << " to " << percent_of(claim.interval.high)
      << "  wanted " << wanted_text(claim.claim) << "  " << lang::printable(claim.claim.text) << "\n";
  if (claim.margins) {
    out << "                margin";
    for (std::size_t i = 0; i < margin_shares.size(); ++i) {
      out << (i == 0 ? " " : ", ") << margin_text((*claim.margins)[i])
          << (margin_shares[i] == 0.0   ? std::string(" at least")
              : margin_shares[i] == 0.5 ? std::string(" in the middle")
                                        : " of the worst " + short_number(100.0 * margin_shares[i]) + " %");
    }
    out << "\n";
  }
  if (const std::string with = correlations_text(claim); !with.empty())
    out << "                the margin goes with " << with << "\n";
  if (const std::string with = misses_text(claim); !with.empty())
    out << "                misses go with " << with << "\n";
}

ordered_json json_of(const ClaimReport& claim) {
  ordered_json one = {{"text", claim.claim.text},
                      {"verdict", to_string(claim.verdict)},
                      {"held", claim.held},
                      {"runs", claim.runs},
                      {"share", {claim.interval.low, claim.interval.high}},
                      {"confidence", claim.claim.confidence}};
  if (claim.claim.probability) one["probability"] = *claim.claim.probability;
  if (claim.margins) {
    ordered_json quantiles = ordered_json::array();
    for (std::size_t i = 0; i < margin_shares.size(); ++i)
      quantiles.push_back({{"share", margin_shares[i]}, {"margin", (*claim.margins)[i]}});
    one["margins"] = quantiles;
  }
  ordered_json correlations = ordered_json::array();
  for (const Correlation& c : claim.correlations) {
    ordered_json line = {{"draw", c.draw}};
    if (c.with_margin) line["margin"] = *c.with_margin;
    if (c.with_misses) line["misses"] = *c.with_misses;
    correlations.push_back(line);
  }
  one["correlations"] = correlations;
  return one;
}

}  // namespace

std::string human_report(const lang::Study& study, const StudyReport& report, const std::string& command) {
  std::ostringstream out;
  out << study.path << ": " << report.runs << " of " << report.wanted << " cells";
  const char* before = "; ended: ";
  for (const auto& [outcome, count] : report.outcomes)
    out << std::exchange(before, ", ") << count << " " << outcome;
  out << "\n";
  for (const ClaimReport& claim : report.claims) describe_claim(claim, out);
  for (const GroupReport& group : report.groups)
    out << "  " << group.holds << "/" << group.runs << " cells hold with " << lang::printable(group.name)
        << (group.margin ? ", margin " + margin_text(*group.margin) + " at least" : std::string()) << "\n";
  if (report.worst.empty()) return out.str();
  out << "worst cells\n";
  std::map<std::string, std::size_t> first_with;  // the reason, told once
  for (const WorstCell& cell : report.worst) {
    out << "  " << cell.record.cell << "  " << cell.record.outcome << "  "
        << (cell.margin ? "margin " + margin_text(*cell.margin) : std::string("missed")) << "  "
        << lang::printable(study.claims[cell.claim].text) << "\n      " << drawn_text(study, cell.record)
        << "\n";
    const std::string& why = cell.record.why.empty() ? cell.record.because : cell.record.why;
    const auto told = first_with.emplace(why, cell.record.cell);
    if (!why.empty())
      out << "      why: "
          << (told.second ? lang::printable(why) : "as cell " + std::to_string(told.first->second)) << "\n";
  }
  out << "again: " << command << report.worst.front().record.cell << " --report\n";
  return out.str();
}

std::string json_report(const lang::Study& study, const StudyReport& report) {
  ordered_json claims = ordered_json::array(), groups = ordered_json::array(), worst = ordered_json::array();
  for (const ClaimReport& claim : report.claims) claims.push_back(json_of(claim));
  for (const GroupReport& group : report.groups)
    groups.push_back({{"name", group.name}, {"hold", group.holds}, {"runs", group.runs}});
  for (std::size_t i = 0; i < report.groups.size(); ++i) {
    if (report.groups[i].margin) groups[i]["margin"] = *report.groups[i].margin;
  }
  for (const WorstCell& cell : report.worst) {
    ordered_json drawn = ordered_json::object();
    for (std::size_t i = 0; i < study.draws.size(); ++i) drawn[study.draws[i].name] = cell.record.drawn[i];
    ordered_json one = {{"cell", cell.record.cell},
                        {"of_matrix", cell.record.of_matrix},
                        {"outcome", cell.record.outcome},
                        {"because", cell.record.because},
                        {"why", cell.record.why},
                        {"expectation", study.claims[cell.claim].text},
                        {"drawn", drawn}};
    if (cell.margin) one["margin"] = *cell.margin;
    worst.push_back(one);
  }
  const ordered_json whole = {{"study", study.path},
                              {"passed", !report.is_broken()},
                              {"cells", report.runs},
                              {"wanted", report.wanted},
                              {"outcomes", report.outcomes},
                              {"expectations", claims},
                              {"groups", groups},
                              {"worst", worst}};
  return whole.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string junit_report(const lang::Study& study, const StudyReport& report) {
  std::size_t broken = 0, skipped = 0;
  std::ostringstream cases;
  for (const ClaimReport& claim : report.claims) {
    cases << "    <testcase name=\"" << lang::printable_in_xml(claim.claim.text) << "\" classname=\""
          << lang::printable_in_xml(study.path) << "\" time=\"0\">";
    const std::string share = std::to_string(claim.held) + " of " + std::to_string(claim.runs) +
                              " cells held, wanted " + wanted_text(claim.claim);
    if (claim.verdict == Verdict::broken) {
      ++broken;
      cases << "<failure message=\"" << lang::printable_in_xml(share) << "\"/>";
    } else if (claim.verdict == Verdict::too_few_runs) {
      ++skipped;
      cases << "<skipped message=\"too few runs: " << lang::printable_in_xml(share) << "\"/>";
    }
    cases << "</testcase>\n";
  }
  std::ostringstream out;
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\""
      << lang::printable_in_xml(study.path) << "\" tests=\"" << report.claims.size() << "\" failures=\""
      << broken << "\" skipped=\"" << skipped << "\">\n"
      << cases.str() << "  </testsuite>\n</testsuites>\n";
  return out.str();
}

}  // namespace zwang::study
