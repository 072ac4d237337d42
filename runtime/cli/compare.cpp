// The differences between two runs, for the page that shows them together.
#include <algorithm>
#include <set>

#include "compare_files.hpp"
#include "json_parts.hpp"
#include "run_log.hpp"
#include "told_events.hpp"
#include "zwang/runtime/log_difference.hpp"

namespace zwang::cli {

namespace {

using nlohmann::ordered_json;
using runtime::ColumnDifference;
using runtime::Happening;
using runtime::LogDifference;
using runtime::Series;

constexpr std::size_t most_lines = 12;        // of a file's difference
constexpr std::size_t most_happenings = 500;  // of a run

ordered_json value_or_null(const std::map<std::string, std::string>& facts, const std::string& name) {
  const auto fact = facts.find(name);
  return fact == facts.end() ? ordered_json(nullptr) : ordered_json(fact->second);
}

/// Parameters, seed, start, versions: those that differ, and those of one run alone.
ordered_json facts_that_differ(const runtime::LogContext& first, const runtime::LogContext& second) {
  std::set<std::string> names;
  for (const auto& [name, value] : first.facts) names.insert(name);
  for (const auto& [name, value] : second.facts) names.insert(name);
  ordered_json facts = ordered_json::array();
  for (const std::string& name : names) {
    const ordered_json a = value_or_null(first.facts, name), b = value_or_null(second.facts, name);
    if (a != b) facts.push_back({{"name", name}, {"first", a}, {"second", b}});
  }
  return facts;
}

ordered_json first_lines(const std::vector<std::string>& lines) {
  return std::vector(lines.begin(),
                     lines.begin() + static_cast<std::ptrdiff_t>(std::min(lines.size(), most_lines)));
}

ordered_json files_that_differ(const runtime::LogContext& first, const runtime::LogContext& second) {
  ordered_json files = ordered_json::array();
  for (const FilePair& pair : pairs_of(first.sources, second.sources)) {
    if (pair.is_same || pair.first == from_command_line || pair.second == from_command_line) continue;
    files.push_back({{"first", pair.first},
                     {"second", pair.second},
                     {"line", pair.line},
                     {"first_lines", first_lines(pair.first_lines)},
                     {"second_lines", first_lines(pair.second_lines)},
                     {"first_count", pair.first_lines.size()},
                     {"second_count", pair.second_lines.size()}});
  }
  return files;
}

ordered_json as_json(const ColumnDifference& d) {
  ordered_json json = {{"name", d.name},   {"unit", d.unit},     {"input", d.is_input}, {"time", d.time},
                       {"first", d.first}, {"second", d.second}, {"records", d.records}};
  json["largest"] = d.largest ? ordered_json(*d.largest) : ordered_json(nullptr);
  json["largest_time"] = d.largest_time;
  return json;
}

/// A report that is whole has the reason of each transition; else the tasks of the records have to do.
std::vector<Happening> transitions_of(const Series& series, bool with_reasons) {
  std::vector<Happening> all;
  if (with_reasons) {
    const ordered_json report = ordered_json::parse(series.log.conclusion.at("report"), nullptr, false);
    for (const ordered_json& t : report.value("transitions", ordered_json::array())) {
      const std::string from = t.contains("from") && t["from"].is_string() ? t.value("from", "") : "start";
      all.push_back({t.value("time", 0.0) - series.log.begin,
                     from + " -> " + t.value("to", "") + ": " + t.value("why", "")});
    }
    return all;
  }
  std::string last = "start";
  for (const runtime::Stretch& stretch : series.tasks) {
    all.push_back({stretch.begin - series.log.begin, last + " -> " + stretch.word});
    last = stretch.word;
  }
  return all;
}

std::vector<Happening> events_of(const Series& series) {
  std::vector<Happening> all;
  for (const runtime::LoggedEvent& e : told_events(series.log, series.events))
    all.push_back({e.time - series.log.begin, e.code + (e.signal.empty() ? "" : " " + e.signal)});
  return all;
}

ordered_json as_json(const std::vector<Happening>& all) {
  ordered_json json = ordered_json::array();
  for (const Happening& one : all) {
    if (json.size() >= most_happenings) break;
    json.push_back({{"time", one.time}, {"what", one.what}});
  }
  return json;
}

ordered_json as_json(const std::vector<Happening>& first, const std::vector<Happening>& second,
                     double tolerance) {
  const auto differs = runtime::first_difference(first, second, tolerance);
  return {{"first", as_json(first)},
          {"second", as_json(second)},
          {"counts", {first.size(), second.size()}},
          {"differs", differs ? ordered_json(*differs) : ordered_json(nullptr)}};
}

bool has_report(const Series& series) {
  return series.log.conclusion.contains("report");
}

}  // namespace

ordered_json comparison_of(const std::filesystem::path& first_log, const Series& first,
                           const std::filesystem::path& second_log, const Series& second) {
  const LogDifference difference = runtime::difference(first_log, second_log);
  ordered_json columns = ordered_json::array();
  for (const ColumnDifference& one : difference.columns) columns.push_back(as_json(one));
  const double first_period = runtime::period_of(first.log.context),
               second_period = runtime::period_of(second.log.context);
  const bool with_reasons = has_report(first) && has_report(second);
  // The same instant of two clocks that tick unlike.
  const double tolerance = 0.5 * std::max(first_period, second_period);
  return {{"facts", facts_that_differ(first.log.context, second.log.context)},
          {"files", files_that_differ(first.log.context, second.log.context)},
          {"compared", difference.compared},
          {"until", difference.until},
          {"periods", {first_period, second_period}},
          {"columns", columns},
          {"only_first", difference.only_first},
          {"only_second", difference.only_second},
          {"transitions",
           as_json(transitions_of(first, with_reasons), transitions_of(second, with_reasons), tolerance)},
          {"events", as_json(events_of(first), events_of(second), tolerance)}};
}

}  // namespace zwang::cli
