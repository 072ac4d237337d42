#include "told_events.hpp"

#include <limits>
#include <nlohmann/json.hpp>

namespace zwang::cli {

using nlohmann::ordered_json;

std::vector<runtime::LoggedEvent> told_events(const runtime::LogContents& log,
                                              const std::vector<runtime::LoggedEvent>& of_records) {
  const auto report = log.conclusion.find("report");
  if (report == log.conclusion.end()) return of_records;
  const ordered_json told = ordered_json::parse(report->second, nullptr, false);
  if (!told.is_object() || !told.contains("events") || !told["events"].is_array()) return of_records;
  std::vector<runtime::LoggedEvent> events;
  for (const ordered_json& e : told["events"]) {
    const double value = e.contains("value") && e["value"].is_number()
                             ? e["value"].get<double>()
                             : std::numeric_limits<double>::quiet_NaN();
    events.push_back({e.value("time", 0.0), e.value("code", ""), e.value("signal", ""), value});
  }
  return events;
}

}  // namespace zwang::cli
