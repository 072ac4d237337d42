#include "sweep_page.hpp"

#include <algorithm>
#include <cmath>

#include "json_parts.hpp"
#include "output.hpp"
#include "report_page.hpp"

namespace zwang::cli {

namespace {

using nlohmann::ordered_json;
using study::CellRecord;

/// A page draws a point for each of so many cells: 1 MB, and 0.1 s for a chart.
constexpr std::size_t most_points = 20'000;

/// Cells that missed anything come first, then the others, evenly. No extreme is lost as long as there is
/// room.
std::vector<const CellRecord*> cells_to_draw(const std::vector<CellRecord>& records) {
  std::vector<const CellRecord*> drawn, others;
  for (const CellRecord& record : records) (record.holds() ? others : drawn).push_back(&record);
  drawn.resize(std::min(drawn.size(), most_points));
  const std::size_t room = std::min(most_points - drawn.size(), others.size());
  for (std::size_t i = 0; i < room; ++i) drawn.push_back(others[i * others.size() / room]);
  return drawn;
}

/// A list for each draw, and two for each expectation: figures of one kind stand together.
ordered_json points_of(const lang::Study& study, const std::vector<const CellRecord*>& cells) {
  ordered_json numbers = ordered_json::array(), drawn = ordered_json::array(),
               expectations = ordered_json::array();
  for (const CellRecord* cell : cells) numbers.push_back(cell->cell);
  for (std::size_t d = 0; d < study.draws.size(); ++d) {
    ordered_json values = ordered_json::array();
    for (const CellRecord* cell : cells) values.push_back(short_number(cell->drawn[d]));
    drawn.push_back(std::move(values));
  }
  for (std::size_t e = 0; e < study.claims.size(); ++e) {
    ordered_json held = ordered_json::array(), margins = ordered_json::array();
    for (const CellRecord* cell : cells) {
      const study::ExpectationRecord& one = cell->expectations[e];
      held.push_back(one.held ? 1 : 0);
      margins.push_back(one.margin && std::isfinite(*one.margin) ? ordered_json(short_number(*one.margin))
                                                                 : ordered_json(nullptr));
    }
    expectations.push_back({{"held", std::move(held)}, {"margins", std::move(margins)}});
  }
  return {{"cells", numbers}, {"drawn", drawn}, {"expectations", expectations}};
}

ordered_json draws_of(const lang::Study& study) {
  ordered_json draws = ordered_json::array();
  for (const lang::Draw& draw : study.draws)
    draws.push_back({{"name", draw.name},
                     {"unit", draw.unit},
                     {"is_log", draw.distribution.spread == lang::Spread::log_uniform}});
  return draws;
}

}  // namespace

std::string write_sweep_page(const lang::Study& study, const study::StudyReport& report,
                             const std::vector<CellRecord>& records, const std::string& command,
                             const std::string& path) {
  const ordered_json data = {{"study", ordered_json::parse(study::json_report(study, report))},
                             {"about", study.about},
                             {"command", command},
                             {"draws", draws_of(study)},
                             {"points", points_of(study, cells_to_draw(records))}};
  write_file(path, page_with(page_parts(), text_of(data)));
  return path;
}

}  // namespace zwang::cli
