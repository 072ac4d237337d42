#include "plan_report.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "json_parts.hpp"
#include "output.hpp"

namespace zwang::cli {

namespace {

using nlohmann::ordered_json;

const char* force_unit(bool turns) {
  return turns ? "N m" : "N";
}
const char* acceleration_unit(bool turns) {
  return turns ? "rad/s^2" : "m/s^2";
}

/// The effect of the row on its quantity, in a word.
const char* word(solver::RowKind kind) {
  if (kind == solver::RowKind::driver) return "drives";
  if (kind == solver::RowKind::upper) return "at most";
  if (kind == solver::RowKind::lower) return "at least";
  return kind == solver::RowKind::force ? "presses" : "bounds the sum";
}

/// Rows that only carry or bound a force ask for no acceleration.
bool asks_for_acceleration(solver::RowKind kind) {
  return kind == solver::RowKind::driver || solver::is_limit(kind);
}

const char* word(solver::Quantity quantity) {
  constexpr std::array words{"position", "velocity", "acceleration", "force"};
  return words[static_cast<std::size_t>(quantity)];
}

std::string number(double value) {
  if (std::abs(value) < 5e-13) value = 0.0;
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// (moment | force) in the moved body's axes and about its origin.
std::string column(const solver::ForceVector& a) {
  std::string text = "(";
  for (int i = 0; i < 3; ++i) text += number(a.angular[i]) + (i < 2 ? " " : " | ");
  for (int i = 0; i < 3; ++i) text += number(a.linear[i]) + (i < 2 ? " " : ")");
  return text;
}

std::string bounds(const PlannedRow& planned) {
  const solver::Row& row = planned.row;
  if (row.kind == solver::RowKind::force) return number(row.force) + " " + force_unit(planned.turns);
  if (row.kind == solver::RowKind::upper) return "nu <= 0";
  if (row.kind == solver::RowKind::lower) return "nu >= 0";
  if (!std::isfinite(row.lo) && !std::isfinite(row.hi)) return "what the motors make";
  return "[" + number(row.lo) + ", " + number(row.hi) + "] " + force_unit(planned.turns);
}

std::string demand(const PlannedRow& planned) {
  if (!asks_for_acceleration(planned.row.kind)) return "-";
  return number(planned.row.b) + " " + acceleration_unit(planned.turns);
}

std::string softness(const PlannedRow& planned) {
  if (!planned.weight) return "";
  return "weight " + number(*planned.weight) + (planned.turns ? " kg m^2" : " kg") + ": meets " +
         number(100.0 * *planned.fraction) + " %  ";
}

/// Columns as wide as their widest cell.
std::string table(const std::vector<std::vector<std::string>>& lines) {
  std::vector<std::size_t> widths;
  for (const auto& line : lines) {
    widths.resize(std::max(widths.size(), line.size()));
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (const auto& line : lines) {
    std::string row = " ";
    for (std::size_t i = 0; i < line.size(); ++i) row += " " + padded(line[i], widths[i]) + " ";
    text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string rows_table(const TaskPlan& plan, const lang::Diagnostics& diagnostics) {
  std::vector<std::vector<std::string>> lines{
      {"row", "level", "", "b", "nu", "A_N (moment | force)", "from"}};
  for (const PlannedRow& planned : plan.rows) {
    lines.push_back({planned.name, std::to_string(planned.row.level),
                     std::string(word(planned.row.kind)) + " " + word(planned.row.quantity), demand(planned),
                     softness(planned) + bounds(planned), column(planned.row.a),
                     place(diagnostics, planned.span)});
  }
  return table(lines);
}

/// `116 kg (116 to 1041)`: at the start, and between which figures it goes with the joints.
std::string with_spread(double start, const Spread& spread, const std::string& unit, bool is_sometimes_held) {
  std::string text = std::isfinite(start) ? number(start) + " " + unit : "held by the ground";
  std::string range;
  if (spread.exists() && !(std::isfinite(start) && spread.is_one_number()))
    range =
        spread.is_one_number() ? number(spread.least) : number(spread.least) + " to " + number(spread.most);
  if (is_sometimes_held && std::isfinite(start)) range += range.empty() ? "or held" : ", or held";
  return range.empty() ? text : text + " (" + range + ")";
}

std::string force_text(const PlannedAxis& axis) {
  const solver::AxisAnalysis& a = axis.analysis;
  const std::string unit = force_unit(axis.turns);
  if (a.reachable && !std::isfinite(a.largest_force)) return "no limit known";
  if (a.reachable) return with_spread(a.largest_force, axis.force, unit, false);
  const std::string held = a.kappa > 0.0 && std::isfinite(a.effective_mass) ? "no motor along it" : "held";
  return axis.force.exists() ? with_spread(solver::infinity, axis.force, unit, false).replace(0, 18, held)
                             : held;
}

std::string axes_table(const TaskPlan& plan) {
  std::vector<std::vector<std::string>> lines{{"axis", "effective mass", "largest force"}};
  for (const PlannedAxis& axis : plan.axes) {
    lines.push_back({axis.name,
                     with_spread(axis.analysis.effective_mass, axis.mass, axis.turns ? "kg m^2" : "kg",
                                 axis.is_sometimes_held),
                     force_text(axis)});
  }
  return table(lines);
}

std::string dormant_text(const TaskPlan& plan, const lang::Diagnostics& diagnostics) {
  std::string text;
  for (const runtime::DormantRow& row : plan.dormant) {
    text += "  " + row.name + ": " + row.why + " (" + place(diagnostics, row.span) + ")\n";
  }
  std::string names;
  for (const std::string& name : plan.unknown_signals) names += (names.empty() ? "`" : ", `") + name + "`";
  if (!names.empty()) text += "  not known at the start: " + names + "; rows that hang on it stand still\n";
  return text;
}

ordered_json as_json(const Spread& spread) {
  return spread.exists() ? ordered_json({spread.least, spread.most}) : ordered_json(nullptr);
}

ordered_json as_json(const solver::ForceVector& a) {
  return {a.angular.x(), a.angular.y(), a.angular.z(), a.linear.x(), a.linear.y(), a.linear.z()};
}

ordered_json as_json(const TaskPlan& plan, const lang::Diagnostics& diagnostics) {
  ordered_json rows = ordered_json::array();
  for (const PlannedRow& p : plan.rows) {
    const bool is_force = p.row.kind == solver::RowKind::force;
    rows.push_back({{"row", p.name},
                    {"kind", word(p.row.kind)},
                    {"quantity", word(p.row.quantity)},
                    {"level", p.row.level},
                    {"a", as_json(p.row.a)},
                    {"body", p.row.body},
                    {"reference_body", p.row.reference_body},
                    {"b", asks_for_acceleration(p.row.kind) ? ordered_json(p.row.b) : ordered_json(nullptr)},
                    {"force", is_force ? ordered_json(p.row.force) : ordered_json(nullptr)},
                    {"lo", finite_or_null(p.row.lo)},
                    {"hi", finite_or_null(p.row.hi)},
                    {"weight", p.weight ? ordered_json(*p.weight) : ordered_json(nullptr)},
                    {"fraction", p.fraction ? ordered_json(*p.fraction) : ordered_json(nullptr)},
                    {"from", place(diagnostics, p.span)}});
    if (p.row.reference_body >= 0) rows.back()["a_reference"] = as_json(p.row.a_reference);
  }
  ordered_json axes = ordered_json::array();
  for (const PlannedAxis& axis : plan.axes) {
    axes.push_back({{"axis", axis.name},
                    {"reachable", axis.analysis.reachable},
                    {"effective_mass", finite_or_null(axis.analysis.effective_mass)},
                    {"effective_mass_range", as_json(axis.mass)},
                    {"sometimes_held", axis.is_sometimes_held},
                    {"largest_force", finite_or_null(axis.analysis.largest_force)},
                    {"largest_force_range", as_json(axis.force)}});
  }
  ordered_json dormant = ordered_json::array();
  for (const runtime::DormantRow& row : plan.dormant) {
    dormant.push_back({{"row", row.name}, {"why", row.why}, {"from", place(diagnostics, row.span)}});
  }
  ordered_json notes = ordered_json::array();
  for (const lang::Diagnostic& d : plan.notes) {
    notes.push_back({{"code", d.code}, {"where", place(diagnostics, d.span)}, {"message", d.message}});
  }
  ordered_json whole = {
      {"task", plan.task},  {"equality_rows", plan.equality_rows},     {"rank", plan.rank}, {"rows", rows},
      {"dormant", dormant}, {"unknown_signals", plan.unknown_signals}, {"axes", axes},      {"notes", notes}};
  if (!plan.refused.empty()) whole["refused"] = plan.refused;
  return whole;
}

}  // namespace

std::string human(const TaskPlan& plan, int mobility, const Configurations& configurations,
                  const lang::Diagnostics& diagnostics) {
  std::string text = plan.task + "\n";
  if (!plan.refused.empty()) return text + "  no rows: " + plan.refused + "\n";
  text += rows_table(plan, diagnostics) + dormant_text(plan, diagnostics) + "\n" + axes_table(plan);
  if (configurations.count > 1) {
    text += "  at the start; in brackets from least to most over " + std::to_string(configurations.count) +
            " configurations:\n  " + configurations.words + "\n";
  }
  text += "\n";
  text += "  mobility " + std::to_string(mobility) + "; equality rows " + std::to_string(plan.equality_rows) +
          ", their rank " + std::to_string(plan.rank);
  const int left = mobility - plan.rank;
  if (left > 0)
    text += "; " + std::to_string(left) + (left == 1 ? " freedom" : " freedoms") +
            " that no driver of motion holds";
  text += "\n";
  for (const lang::Diagnostic& note : plan.notes) {
    text += "  " + note.code + " " + place(diagnostics, note.span) + ": " + note.message + "\n";
  }
  return text;
}

std::string json(const std::vector<TaskPlan>& plans, int mobility, const Configurations& configurations,
                 const lang::Diagnostics& diagnostics) {
  ordered_json tasks = ordered_json::array();
  for (const TaskPlan& plan : plans) tasks.push_back(as_json(plan, diagnostics));
  const ordered_json whole = {{"ok", true},
                              {"mobility", mobility},
                              {"configurations", configurations.count},
                              {"looked_at", configurations.words},
                              {"tasks", tasks}};
  return whole.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace zwang::cli
