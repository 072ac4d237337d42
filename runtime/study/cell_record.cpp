#include "study/cell_record.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "zwang/runtime/scenario_run.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace zwang::study {

using nlohmann::json;

bool CellRecord::holds() const {
  return std::ranges::all_of(expectations, &ExpectationRecord::held);
}

namespace {

CellRecord empty_record(const lang::Study& study, std::size_t cell, const lang::StudyCell& drawn,
                        const std::string& outcome, const std::string& because) {
  CellRecord record;
  record.cell = cell;
  record.of_matrix = study.scenario.cells[drawn.matrix_cell].name;
  record.outcome = outcome;
  record.because = because;
  record.drawn = drawn.drawn;
  record.expectations.resize(study.claims.size());
  return record;
}

}  // namespace

CellRecord unrun(const lang::Study& study, std::size_t cell, const std::string& outcome,
                 const std::string& because) {
  return empty_record(study, cell, lang::draw_cell(study, cell), outcome, because);
}

CellRecord run_cell(const lang::Study& study, std::size_t cell) {
  lang::StudyCell drawn = lang::draw_cell(study, cell);
  lang::Diagnostics of_study, of_task;
  const auto run = lang::load_run(study, drawn, of_study, of_task);
  if (!run) {
    const auto error = of_study.first_error();
    return empty_record(study, cell, drawn, "error",
                        error ? error->message : "the study cannot be read any more");
  }
  const runtime::CellResult result = runtime::run_cell(drawn.scenario, drawn.cell(), *run, codes_of(of_task));
  CellRecord record = empty_record(study, cell, drawn, result.outcome, result.because);
  record.why = result.why;
  record.simulated = result.simulated;
  record.torque = result.torque;
  record.wall = result.wall;
  for (std::size_t i = 0; i < std::min(record.expectations.size(), result.expectations.size()); ++i) {
    const runtime::ExpectationResult& one = result.expectations[i];
    record.expectations[i] = {one.held, one.margin, one.value};
  }
  return record;
}

std::vector<std::string> codes_of(const lang::Diagnostics& diagnostics) {
  std::vector<std::string> codes;
  for (const lang::Diagnostic& d : diagnostics.sorted()) {
    if (d.severity != lang::Severity::note && std::find(codes.begin(), codes.end(), d.code) == codes.end())
      codes.push_back(d.code);
  }
  return codes;
}

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int beyond_any_simulation = 1 << 30;  // [bytes]
  mallopt(M_MMAP_THRESHOLD, beyond_any_simulation);
  mallopt(M_TRIM_THRESHOLD, beyond_any_simulation);
#endif
}

std::string to_text(const CellRecord& record) {
  json expectations = json::array();
  const auto number = [](const std::optional<double>& value) { return value ? json(*value) : json(); };
  for (const ExpectationRecord& one : record.expectations)
    expectations.push_back({one.held, number(one.margin), number(one.value)});
  const json whole = {record.cell,      record.of_matrix, record.outcome, record.because, record.why,
                      record.simulated, record.torque,    record.wall,    record.drawn,   expectations};
  return whole.dump(-1, ' ', false, json::error_handler_t::replace);
}

CellRecord record_of(const std::string& text) {
  const json whole = json::parse(text);
  CellRecord record{whole[0], whole[1], whole[2], whole[3], whole[4],
                    whole[5], whole[6], whole[7], whole[8], {}};
  const auto number = [](const json& value) {
    return value.is_number() ? std::optional<double>(value.get<double>()) : std::nullopt;
  };
  for (const json& one : whole[9])
    record.expectations.push_back({one[0].get<bool>(), number(one[1]), number(one[2])});
  return record;
}

}  // namespace zwang::study
