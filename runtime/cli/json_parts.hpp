/// Parts of the JSON that the program writes, for whoever puts them together.
#pragma once

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/series.hpp"
#include "zwang/runtime/why.hpp"

namespace zwang::cli {

nlohmann::ordered_json json_of(const runtime::Why& why);

/// The drawing of the page of a run: robot, scene, regions and frames. Lengths in m, angles in rad; a pose is
/// {p: [x, y, z], r: its rotation by rows}.
nlohmann::ordered_json world_of(const lang::Program& program);

/// Each task, each way between two of them, and the task that the run starts in.
nlohmann::ordered_json graph_json(const lang::Program& program);

/// Each bound that a row of the program has: the column that it bounds, in which task, and where it is
/// written.
nlohmann::ordered_json bounds_of(const lang::Program& program);

/// All that the page shows of a run.
nlohmann::ordered_json page_data(const std::filesystem::path& log, const runtime::Series& series);

/// The differences between two runs.
nlohmann::ordered_json comparison_of(const std::filesystem::path& first_log, const runtime::Series& first,
                                     const std::filesystem::path& second_log, const runtime::Series& second);

/// JSON knows no infinity and no NaN.
inline nlohmann::ordered_json finite_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

/// Five digits: more than a page shows. 0 of what is not finite.
inline double short_number(double value) {
  if (value == 0.0 || !std::isfinite(value)) return 0.0;
  const double step = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 4.0);
  return std::round(value / step) * step;
}

/// One line of ASCII letters.
inline std::string text_of(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace zwang::cli
