#include "test_page.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "json_parts.hpp"
#include "output.hpp"
#include "report_page.hpp"
#include "scenario_choice.hpp"

namespace zwang::cli {

namespace {

using nlohmann::ordered_json;
using runtime::CellResult;
using runtime::CellStory;
using runtime::ExpectationResult;

constexpr std::size_t most_limits = 12;  // of a run
constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The least margin of all expectations; one that was missed without a margin is the worst.
double worst_margin(const CellResult& cell) {
  double worst = unlimited;
  for (const ExpectationResult& e : cell.expectations) {
    if (!e.held && !e.margin) return -unlimited;
    worst = std::min(worst, e.margin.value_or(unlimited));
  }
  return worst;
}

struct Place {
  std::size_t report = 0, cell = 0;
};

/// Failed cells come first; within both halves the least margin does.
std::vector<Place> worst_first(const std::vector<ScenarioReport>& reports) {
  std::vector<Place> places;
  for (std::size_t r = 0; r < reports.size(); ++r) {
    for (std::size_t c = 0; c < reports[r].cells.size(); ++c) {
      if (is_over(reports[r].cells[c])) places.push_back({r, c});
    }
  }
  std::ranges::stable_sort(places, [&](const Place& a, const Place& b) {
    const CellResult &first = reports[a.report].cells[a.cell], &second = reports[b.report].cells[b.cell];
    if (first.passed != second.passed) return !first.passed;
    return worst_margin(first) < worst_margin(second);
  });
  return places;
}

double millimetres(double metres) {
  return std::round(metres * 1e3) / 1e3;
}

ordered_json expectations_of(const ScenarioReport& report, const CellResult& cell) {
  std::vector<ExpectationResult> all = cell.expectations;
  std::ranges::stable_sort(all, [](const ExpectationResult& a, const ExpectationResult& b) {
    if (a.held != b.held) return !a.held;
    return a.margin.value_or(unlimited) < b.margin.value_or(unlimited);
  });
  ordered_json json = ordered_json::array();
  for (const ExpectationResult& e : all) {
    json.push_back({{"text", e.text},
                    {"held", e.held},
                    {"margin", finite_or_null(e.margin)},
                    {"value", finite_or_null(e.value)},
                    {"unit", e.unit},
                    {"time", e.time},
                    {"where", place(report.diagnostics, e.span)}});
  }
  return json;
}

ordered_json story_of(const CellStory& story) {
  ordered_json transitions = ordered_json::array(), events = ordered_json::array(),
               limits = ordered_json::array(), path = ordered_json::array();
  for (const CellStory::Step& s : story.transitions)
    transitions.push_back({short_number(s.time), s.from, s.to, s.why});
  for (const CellStory::Told& t : story.events) events.push_back({short_number(t.time), t.code, t.signal});
  for (const runtime::LimitReport& l : story.limits) {
    if (limits.size() >= most_limits) break;
    limits.push_back(
        {l.row, short_number(l.worst), short_number(l.limit), short_number(l.margin), l.unit, l.is_broken()});
  }
  for (const auto& [x, y, yaw] : story.path) {
    for (const double value : {x, y, yaw}) path.push_back(millimetres(value));
  }
  return {{"transitions", transitions},
          {"events", events},
          {"counts", {story.transition_count, story.event_count, story.limits.size()}},
          {"limits", limits},
          {"path", path}};
}

ordered_json scene_of(const CellScene& scene) {
  ordered_json objects = ordered_json::array(), footprint = ordered_json::array();
  for (const lang::SceneObject& o : scene.objects) {
    const char* shape = o.shape == lang::ShapeKind::wall  ? "wall"
                        : o.shape == lang::ShapeKind::box ? "box"
                                                          : "cylinder";
    objects.push_back({{"name", o.name},
                       {"shape", shape},
                       {"size", o.size},
                       {"at", o.at},
                       {"yaw", o.yaw},
                       {"moves", o.moves()}});
  }
  for (const solver::Vector3& corner : scene.footprint)
    footprint.push_back({millimetres(corner.x()), millimetres(corner.y())});
  return {{"objects", objects}, {"footprint", footprint}};
}

/// A scene is written once, however many cells have it.
class Scenes {
 public:
  std::size_t index_of(const CellScene& scene) {
    ordered_json json = scene_of(scene);
    const auto known = std::ranges::find(all_, json);
    if (known != all_.end()) return static_cast<std::size_t>(known - all_.begin());
    all_.push_back(std::move(json));
    return all_.size() - 1;
  }
  const std::vector<ordered_json>& all() const { return all_; }

 private:
  std::vector<ordered_json> all_;
};

ordered_json json_of(const ScenarioReport& report, std::size_t number, const Place& at, Scenes& scenes) {
  const CellResult& cell = report.cells[at.cell];
  ordered_json json = {{"scenario", number},
                       {"name", cell.name},
                       {"passed", cell.passed},
                       {"outcome", cell.outcome},
                       {"because", cell.because},
                       {"why", cell.why},
                       {"simulated", short_number(cell.simulated)},
                       {"torque", short_number(cell.torque)},
                       {"worst", finite_or_null(worst_margin(cell))},
                       {"expectations", expectations_of(report, cell)},
                       {"story", story_of(cell.story)},
                       {"command", command_of(report.path, cell.name)}};
  for (const runtime::PartnerResult& p : cell.partners)
    json["robots"].push_back({{"name", p.name}, {"outcome", p.outcome}, {"because", p.because}});
  if (at.cell < report.scenes.size() && report.scenes[at.cell])
    json["scene"] = scenes.index_of(*report.scenes[at.cell]);
  return json;
}

std::string words_of(const lang::Diagnostics& diagnostics) {
  std::ostringstream text;
  lang::render_human(diagnostics, text);
  return text.str();
}

ordered_json data_of(const std::vector<ScenarioReport>& reports, double seconds) {
  ordered_json scenarios = ordered_json::array(), cells = ordered_json::array();
  std::size_t runs = 0;
  for (const ScenarioReport& report : reports) {
    runs += report.cells.size();
    scenarios.push_back({{"file", report.path},
                         {"about", report.about},
                         {"readable", report.readable},
                         {"diagnostics", report.readable ? "" : words_of(report.diagnostics)}});
  }
  Scenes scenes;
  for (const Place& at : worst_first(reports))
    cells.push_back(json_of(reports[at.report], at.report, at, scenes));
  return {{"format", 1},    {"seconds", short_number(seconds)},
          {"runs", runs},   {"scenarios", scenarios},
          {"cells", cells}, {"scenes", scenes.all()}};
}

}  // namespace

std::string write_test_page(const std::vector<ScenarioReport>& reports, double seconds,
                            const std::string& path) {
  write_file(path, page_with(page_parts(), text_of(data_of(reports, seconds))));
  return path;
}

}  // namespace zwang::cli
