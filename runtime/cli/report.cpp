// The page of a run, or of two, from their logs.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "json_parts.hpp"
#include "output.hpp"
#include "report_page.hpp"
#include "run_log.hpp"
#include "told_events.hpp"
#include "verbs.hpp"
#include "zwang/runtime/replay.hpp"
#include "zwang/runtime/series.hpp"

namespace zwang::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using runtime::Series;

/// A page of 5 MB has room for so many numbers.
constexpr std::size_t most_points = 900'000;

std::string packed_text(const std::vector<float>& numbers) {
  return base64(runtime::packed(numbers));
}

/// A file, or the folder of several that are one log.
fs::path log_of(const std::string& run) {
  if (fs::path(run).extension() == ".csv")
    throw Impossible(run + ": a CSV has neither files nor lines; give the .mcap beside it");
  require_log(run);
  const std::vector<fs::path> files = runtime::log_files(run);
  return files.size() == 1 ? files.front() : fs::path(run);
}

fs::path folder_of(const fs::path& log) {
  return fs::is_directory(log) ? log : log.parent_path();
}

ordered_json files_of(const runtime::LogContext& context) {
  ordered_json files = ordered_json::array();
  for (const lang::Source& source : context.sources)
    files.push_back({{"path", source.path}, {"text", source.text}});
  return files;
}

int index_of(const runtime::LogContext& context, const std::string& file) {
  for (std::size_t i = 0; i < context.sources.size(); ++i) {
    if (context.sources[i].path == file) return static_cast<int>(i);
  }
  return -1;
}

/// Of a file that was read from a copy, in a folder that holds it under the log's name. -1: it is none of
/// them.
int index_of_copy(const runtime::LogContext& context, const std::string& path) {
  for (std::size_t i = 0; i < context.sources.size(); ++i) {
    const std::string& name = context.sources[i].path;
    if (path == name || path.ends_with("/" + name)) return static_cast<int>(i);
  }
  return -1;
}

/// The diagnostics of `zwang run` about these files before the run. `zwang drive` logs its connection, too,
/// which is not read here.
ordered_json warnings_of(const runtime::LogContext& context, const lang::Diagnostics& diagnostics) {
  ordered_json warnings = ordered_json::array();
  for (const lang::Diagnostic& d : diagnostics.sorted()) {
    if (d.severity == lang::Severity::note) continue;
    warnings.push_back(
        {{"code", d.code},
         {"message", d.message},
         {"help", d.help},
         {"file", d.span.exists() ? index_of_copy(context, diagnostics.source(d.span.source).path) : -1},
         {"line", d.span.begin.line}});
  }
  return warnings;
}

/// A curve that is blank throughout is left out.
bool is_blank(const runtime::Curve& curve) {
  return std::ranges::all_of(curve.points, [](float value) { return std::isnan(value); });
}

bool is_sampled(const std::string& name) {
  const auto ends = [&](const char* end) { return name.ends_with(end); };
  const bool is_place = ends(".x") || ends(".y") || ends(".yaw");
  return ends(".q") || (is_place && (name.starts_with("base.") || name.starts_with("truth.") ||
                                     name.starts_with("signal.")));
}

/// From the begin of the run: a clock may count from 1970.
std::vector<float> since(double begin, const std::vector<double>& times) {
  std::vector<float> since;
  for (const double time : times) since.push_back(static_cast<float>(time - begin));
  return since;
}

ordered_json curves_of(const Series& series) {
  ordered_json curves = ordered_json::array();
  std::vector<float> points;
  for (const runtime::Curve& curve : series.curves) {
    if (is_blank(curve)) continue;
    curves.push_back({{"name", curve.name},
                      {"unit", curve.unit},
                      {"file", index_of(series.log.context, curve.file)},
                      {"line", curve.line}});
    points.insert(points.end(), curve.points.begin(), curve.points.end());
  }
  return {{"count", series.times.size()},
          {"times", packed_text(since(series.log.begin, series.times))},
          {"columns", curves},
          {"points", packed_text(points)},
          {"records_a_bucket", series.records_a_bucket}};
}

ordered_json samples_of(const Series& series) {
  ordered_json names = ordered_json::array();
  std::vector<float> values;
  for (const runtime::Curve& curve : series.curves) {
    if (!is_sampled(curve.name) || is_blank(curve)) continue;
    names.push_back(curve.name);
    values.insert(values.end(), curve.samples.begin(), curve.samples.end());
  }
  return {{"count", series.sample_times.size()},
          {"times", packed_text(since(series.log.begin, series.sample_times))},
          {"columns", names},
          {"values", packed_text(values)}};
}

/// At the end of the log; empty: nothing.
std::string said_of(const runtime::LogContents& log, const std::string& what) {
  const auto said = log.conclusion.find(what);
  return said == log.conclusion.end() ? "" : said->second;
}

Series series_of(const fs::path& log, std::size_t points) {
  Series series = runtime::read_series(log, points);
  if (series.log.records == 0) throw Impossible(log.string() + ": holds no record");
  return series;
}

std::string write_page_with(std::string parts, const ordered_json& data, const fs::path& path) {
  write_file(path.string(), page_with(std::move(parts), text_of(data)));
  return path.string();
}

}  // namespace

ordered_json page_data(const fs::path& log, const Series& series) {
  ordered_json tasks = ordered_json::array(), events = ordered_json::array();
  for (const runtime::Stretch& s : series.tasks)
    tasks.push_back({{"task", s.word}, {"begin", s.begin}, {"end", s.end}});
  for (const runtime::LoggedEvent& e : told_events(series.log, series.events))
    events.push_back({{"time", e.time}, {"code", e.code}, {"signal", e.signal}, {"value", e.value}});
  const auto report = series.log.conclusion.find("report");
  ordered_json data = {{"format", 1},
                       {"log", runtime::log_files(log).front().filename().string()},
                       {"facts", series.log.context.facts},
                       {"damage", series.log.damage},
                       {"records", series.log.records},
                       {"begin", series.log.begin},
                       {"end", series.log.end},
                       {"report", nullptr},
                       {"files", files_of(series.log.context)},
                       {"tasks", tasks},
                       {"events", events},
                       {"curves", curves_of(series)},
                       {"samples", samples_of(series)},
                       {"world", nullptr}};
  if (report != series.log.conclusion.end()) {
    data["report"] = ordered_json::parse(report->second, nullptr, false);
  } else if (const std::string outcome = said_of(series.log, "outcome"); !outcome.empty()) {
    // A scene's other robots have no verdict of their own.
    const std::string verdict = said_of(series.log, "verdict"), why = said_of(series.log, "why");
    data["report"] = {{"outcome", outcome},
                      {"verdict", verdict.empty() ? outcome + (why.empty() ? "" : ": " + why) : verdict}};
  }
  lang::Diagnostics diagnostics;
  if (const auto program = runtime::logged_program(series.log.context, diagnostics)) {
    data["world"] = world_of(*program);
    data["graph"] = graph_json(*program);
    data["bounds"] = bounds_of(*program);
  }
  data["warnings"] = warnings_of(series.log.context, diagnostics);
  return data;
}

std::string write_page(const std::string& run, const std::optional<std::string>& out) {
  std::string parts = page_parts();
  const fs::path log = log_of(run);
  const Series series = series_of(log, most_points);
  return write_page_with(std::move(parts), page_data(log, series),
                         out ? fs::path(*out) : folder_of(log) / "report.html");
}

std::string write_comparison(const std::string& run, const std::string& other,
                             const std::optional<std::string>& out) {
  std::string parts = page_parts();
  const fs::path log = log_of(run), other_log = log_of(other);
  const Series first = series_of(log, most_points / 2), second = series_of(other_log, most_points / 2);
  const ordered_json data = {{"format", 1},
                             {"names", {log.string(), other_log.string()}},
                             {"runs", {page_data(log, first), page_data(other_log, second)}},
                             {"comparison", comparison_of(log, first, other_log, second)}};
  return write_page_with(std::move(parts), data, out ? fs::path(*out) : folder_of(log) / "compare.html");
}

int report(const ReportArguments& arguments) {
  if (arguments.out) require_place_of_result(*arguments.out);
  const std::string page = arguments.compare
                               ? write_comparison(arguments.run, *arguments.compare, arguments.out)
                               : write_page(arguments.run, arguments.out);
  print(page + "\n");
  return exit_good;
}

}  // namespace zwang::cli
