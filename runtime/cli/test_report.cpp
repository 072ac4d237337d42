#include "test_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "colour.hpp"
#include "output.hpp"
#include "zwang/lang/printable.hpp"

namespace zwang::cli {

namespace {

using runtime::CellResult;
using runtime::ExpectationResult;

std::string number(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string seconds_of(double value, int decimals) {
  return number(value, decimals) + " s";
}

std::string percent(double share) {
  return number(100.0 * share, 1) + " %";
}

/// `0.0031 N, `: the figure behind a margin. Small figures are written with their power of ten.
std::string value_text(const ExpectationResult& result) {
  if (!result.value) return {};
  const double size = std::abs(*result.value);
  std::string text = with_unit(*result.value, result.unit, 5);
  if (size > 0.0 && size < 1e-3) {
    char number[32];
    std::snprintf(number, sizeof number, "%.1e", *result.value);
    text = number;
    text.append(" ").append(result.unit);
  }
  while (text.back() == ' ') text.pop_back();
  return text + ", ";
}

std::string margin_text(const ExpectationResult& result) {
  std::string text = value_text(result);
  if (result.margin) text += "margin " + percent(*result.margin) + " ";
  return text.empty() ? text : text + "at " + seconds_of(result.time, 3);
}

std::string outcome_text(const CellResult& cell) {
  std::string text = cell.outcome;
  if (!cell.because.empty()) text += " (" + cell.because + ")";
  for (const runtime::PartnerResult& partner : cell.partners) {
    text += ", " + partner.name + " " + partner.outcome;
    if (!partner.because.empty()) text += " (" + partner.because + ")";
  }
  return text;
}

/// Expectations of a file, each over all runs.
struct Summary {
  std::string text;
  std::size_t held = 0, count = 0;
  std::optional<double> margin;
  std::string value;  ///< of that margin
  std::string where;  ///< the run with the least margin
};

std::vector<Summary> summarise(const ScenarioReport& report) {
  std::vector<Summary> summaries;
  for (const CellResult& cell : report.cells) {
    if (!is_over(cell)) continue;
    summaries.resize(std::max(summaries.size(), cell.expectations.size()));
    for (std::size_t i = 0; i < cell.expectations.size(); ++i) {
      const ExpectationResult& result = cell.expectations[i];
      Summary& summary = summaries[i];
      if (summary.text.empty()) summary.text = result.text;
      ++summary.count;
      summary.held += result.held ? 1U : 0U;
      if (!result.margin || (summary.margin && *summary.margin <= *result.margin)) continue;
      summary.margin = result.margin;
      summary.value = value_text(result);
      summary.where = cell.name;
    }
  }
  return summaries;
}

void describe(const ScenarioReport& report, std::ostream& out) {
  out << report.path << "\n";
  if (!report.readable) {
    out << rendered(report.diagnostics);
    return;
  }
  for (const CellResult& cell : report.cells) {
    if (!is_over(cell)) continue;
    out << "  " << padded(cell.passed ? marked(Hue::good, "ok") : marked(Hue::bad, "FAIL"), 6)
        << padded(cell.name, 48) << "  " << outcome_text(cell);
    if (cell.simulated > 0.0)
      out << " after " << seconds_of(cell.simulated, 2) << " (" << seconds_of(cell.wall, 2)
          << " of computing, " << number(cell.simulated / cell.wall, 1) << " x real time)";
    out << "\n";
    if (!cell.passed && !cell.why.empty()) out << "        why: " << cell.why << "\n";
    for (const ExpectationResult& result : cell.expectations) {
      if (result.held) continue;
      out << "        " << marked(Hue::bad, "missed:") << " " << result.text << "  ["
          << place(report.diagnostics, result.span) << "] " << margin_text(result) << "\n";
    }
  }
  for (const Summary& summary : summarise(report)) {
    out << "  " << padded_left(std::to_string(summary.held) + "/" + std::to_string(summary.count), 7) << "  "
        << summary.text;
    if (summary.margin)
      out << "   " << summary.value << "least margin " << percent(*summary.margin) << " (" << summary.where
          << ")";
    out << "\n";
  }
}

/// The motor that came nearest to its limit in any run.
std::string hardest_motor(const std::vector<ScenarioReport>& reports) {
  const CellResult* most = nullptr;
  const ScenarioReport* where = nullptr;
  for (const ScenarioReport& report : reports) {
    for (const CellResult& cell : report.cells) {
      if (cell.simulated <= 0.0 || (most != nullptr && cell.torque <= most->torque)) continue;
      most = &cell;
      where = &report;
    }
  }
  if (most == nullptr) return {};
  return "motors at " + percent(most->torque) + " of their torque at most (" + where->path + ": " +
         most->name + ")\n";
}

/// The text for a continuous integration: the first expectation that was missed.
std::string failure_of(const CellResult& cell) {
  for (const ExpectationResult& result : cell.expectations) {
    const std::string why = cell.why.empty() ? "" : ": " + cell.why;
    if (!result.held) return "missed: " + result.text + " (the run ended: " + outcome_text(cell) + why + ")";
  }
  return outcome_text(cell);
}

std::size_t failures(const ScenarioReport& report) {
  if (!report.readable) return 1;
  return static_cast<std::size_t>(
      std::count_if(report.cells.begin(), report.cells.end(),
                    [](const CellResult& cell) { return is_over(cell) && !cell.passed; }));
}

std::size_t runs_over(const ScenarioReport& report) {
  return static_cast<std::size_t>(std::count_if(report.cells.begin(), report.cells.end(), is_over));
}

nlohmann::ordered_json json_of(const CellResult& cell) {
  nlohmann::ordered_json expectations = nlohmann::ordered_json::array();
  for (const ExpectationResult& result : cell.expectations) {
    nlohmann::ordered_json one = {{"text", result.text}, {"held", result.held}};
    if (result.margin) one["margin"] = *result.margin;
    if (result.value) one["value"] = *result.value;
    if (result.value) one["unit"] = result.unit;
    one["time"] = result.time;
    expectations.push_back(std::move(one));
  }
  nlohmann::ordered_json robots = nlohmann::ordered_json::object();
  for (const runtime::PartnerResult& partner : cell.partners)
    robots[partner.name] = {{"outcome", partner.outcome}, {"because", partner.because}};
  nlohmann::ordered_json json = {{"name", cell.name},           {"passed", cell.passed},
                                 {"outcome", cell.outcome},     {"because", cell.because},
                                 {"simulated", cell.simulated}, {"wall", cell.wall},
                                 {"torque", cell.torque},       {"expectations", expectations}};
  if (!cell.why.empty()) json["why"] = cell.why;
  if (!cell.partners.empty()) json["robots"] = robots;
  return json;
}

}  // namespace

bool is_over(const CellResult& cell) {
  return !cell.outcome.empty() && cell.outcome != "interrupted";
}

bool passed(const ScenarioReport& report) {
  return failures(report) == 0;
}

std::string human_report(const std::vector<ScenarioReport>& reports, double seconds) {
  std::ostringstream out;
  std::size_t runs = 0, over = 0, good = 0, unreadable = 0;
  for (const ScenarioReport& report : reports) {
    describe(report, out);
    if (!report.readable) {
      ++unreadable;
      continue;
    }
    runs += report.cells.size();
    over += runs_over(report);
    good += runs_over(report) - failures(report);
  }
  const Hue hue = good == over && unreadable == 0 ? Hue::good : Hue::bad;
  out << hardest_motor(reports)
      << marked(hue, std::to_string(good) + " of " + std::to_string(over) + " runs as expected");
  if (over < runs) out << ", interrupted before " << count(runs - over, "more run");
  if (unreadable > 0) out << ", and " << count(unreadable, "file") << " with errors";
  out << ", in " << seconds_of(seconds, 1) << "\n";
  return out.str();
}

std::string json_report(const std::vector<ScenarioReport>& reports, double seconds) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  bool good = true;
  std::size_t missing = 0;
  for (const ScenarioReport& report : reports) {
    nlohmann::ordered_json cells = nlohmann::ordered_json::array();
    for (const CellResult& cell : report.cells) {
      if (is_over(cell)) cells.push_back(json_of(cell));
    }
    good = good && passed(report);
    missing += report.cells.size() - cells.size();
    files.push_back({{"file", report.path},
                     {"passed", passed(report)},
                     {"runs", cells},
                     {"diagnostics", nlohmann::ordered_json::parse(lang::render_json(report.diagnostics))}});
  }
  nlohmann::ordered_json whole = {
      {"passed", good && missing == 0}, {"seconds", seconds}, {"scenarios", files}};
  if (missing > 0) whole["interrupted_before"] = missing;
  return whole.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string junit_report(const std::vector<ScenarioReport>& reports) {
  std::ostringstream out;
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  for (const ScenarioReport& report : reports) {
    const std::size_t tests = report.readable ? report.cells.size() : 1;
    const std::size_t skipped = report.cells.size() - runs_over(report);
    out << "  <testsuite name=\"" << lang::printable_in_xml(report.path) << "\" tests=\"" << tests
        << "\" failures=\"" << failures(report) << "\" skipped=\"" << skipped << "\">\n";
    if (!report.readable) {
      std::ostringstream text;
      lang::render_human(report.diagnostics, text);
      out << "    <testcase name=\"the scenario file\" classname=\"" << lang::printable_in_xml(report.path)
          << "\" time=\"0\"><failure message=\"not readable\">" << lang::printable_in_xml(text.str())
          << "</failure></testcase>\n  </testsuite>\n";
      continue;
    }
    for (const CellResult& cell : report.cells) {
      out << "    <testcase name=\"" << lang::printable_in_xml(cell.name) << "\" classname=\""
          << lang::printable_in_xml(report.path) << "\" time=\"" << number(cell.wall, 3) << "\">";
      if (!is_over(cell)) {
        out << "<skipped message=\"interrupted\"/>";
      } else if (!cell.passed) {
        std::string missed;
        for (const ExpectationResult& result : cell.expectations) {
          if (!result.held) missed += result.text + "  " + margin_text(result) + "\n";
        }
        out << "<failure message=\"" << lang::printable_in_xml(failure_of(cell)) << "\">"
            << lang::printable_in_xml(missed) << "</failure>";
      }
      out << "</testcase>\n";
    }
    out << "  </testsuite>\n";
  }
  out << "</testsuites>\n";
  return out.str();
}

}  // namespace zwang::cli
