#include <algorithm>
#include <cmath>
#include <tuple>

#include "features.hpp"
#include "shared_name.hpp"
#include "zwang/lang/completion.hpp"
#include "zwang/lang/condition_function.hpp"
#include "zwang/lang/explanation.hpp"
#include "zwang/runtime/planner.hpp"
#include "zwang/runtime/with_unit.hpp"

namespace zwang::lsp {

namespace {

using runtime::with_unit;

bool is_before(const lang::Position& a, const lang::Position& b) {
  return std::tie(a.line, a.column) <= std::tie(b.line, b.column);
}

/// From the axis's key to the end of its last statement.
bool holds_axis(const lang::AxisStatements& axis, const lang::Span& of_file, const lang::Position& place) {
  if (!axis.span.exists() || axis.span.source != of_file.source) return false;
  lang::Span whole = axis.span;
  for (const lang::Span& statement : axis.statement_spans) {
    if (statement.exists() && statement.source == whole.source && is_before(whole.end, statement.end))
      whole.end = statement.end;
  }
  return holds(whole, place);
}

std::string mass_of(const runtime::PlannedAxis& axis) {
  const char* unit = axis.turns ? "kg m^2" : "kg";
  if (!std::isfinite(axis.analysis.effective_mass)) return "held by the ground";
  std::string text = with_unit(axis.analysis.effective_mass, unit, 3);
  if (axis.mass.exists() && !axis.mass.is_one_number())
    text += " (" + with_unit(axis.mass.least, unit, 3) + " to " + with_unit(axis.mass.most, unit, 3) +
            " over the joints' configurations)";
  return text;
}

std::string force_of(const runtime::PlannedAxis& axis) {
  const char* unit = axis.turns ? "N m" : "N";
  if (!axis.analysis.reachable) return "none: no motor moves it";
  if (!std::isfinite(axis.analysis.largest_force)) return "no limit known";
  return with_unit(axis.analysis.largest_force, unit, 3);
}

/// The robot's acceleration limit along the axis, if it allows less than the motors do.
std::string limit_of(const lang::Program& program, const lang::Diagnostics& diagnostics,
                     const runtime::PlannedAxis& axis, solver::Axis direction) {
  for (const lang::BaseLimit& limit : program.robot.limits) {
    if (limit.axis != direction || limit.quantity != solver::Quantity::acceleration) continue;
    const double force = limit.range.high * axis.analysis.effective_mass;
    if (!std::isfinite(force) || (axis.analysis.reachable && force >= axis.analysis.largest_force)) continue;
    const std::string place =
        limit.span.exists()
            ? " (" + std::filesystem::path(diagnostics.source(limit.span.source).path).filename().string() +
                  ":" + std::to_string(limit.span.begin.line) + ")"
            : "";
    return "the robot's acceleration limit of " +
           with_unit(limit.range.high, axis.turns ? "rad/s^2" : "m/s^2", 3) + place + " leaves " +
           with_unit(force, axis.turns ? "N m" : "N", 3);
  }
  return "the motors";
}

std::string words_of(const solver::Row& row) {
  static constexpr std::array quantities{"position", "velocity", "acceleration", "force"};
  const std::string quantity = quantities[static_cast<std::size_t>(row.quantity)];
  switch (row.kind) {
    case solver::RowKind::driver:
      return "drives the " + quantity;
    case solver::RowKind::upper:
      return "bounds the " + quantity + " from above";
    case solver::RowKind::lower:
      return "bounds the " + quantity + " from below";
    case solver::RowKind::force:
      return "presses";
    default:
      return "bounds the sum of the forces";
  }
}

/// A line for each kind of row: a norm has the same one in several directions.
std::string rows_of(const runtime::TaskPlan& plan, const std::string& name, bool turns) {
  std::vector<std::pair<std::string, int>> lines;
  for (const runtime::PlannedRow& planned : plan.rows) {
    if (planned.name != name) continue;
    std::string text = words_of(planned.row) + ", level " + std::to_string(planned.row.level);
    if (planned.row.kind == solver::RowKind::driver)
      text += ": asks for " + with_unit(planned.row.b, turns ? "rad/s^2" : "m/s^2", 3) + " at the start";
    if (planned.fraction) text += "; soft: meets " + with_unit(*planned.fraction, "", 2) + " of it";
    const auto same =
        std::find_if(lines.begin(), lines.end(), [&](const auto& line) { return line.first == text; });
    if (same == lines.end()) {
      lines.emplace_back(text, 1);
    } else {
      ++same->second;
    }
  }
  std::string all;
  for (const auto& [text, count] : lines)
    all += "- " + text + (count > 1 ? ", in " + std::to_string(count) + " directions" : "") + "\n";
  return all;
}

/// A row that hangs on a signal without a sample asks for nothing.
std::string unknown_of(const runtime::TaskPlan& plan) {
  std::string names;
  for (const std::string& signal : plan.unknown_signals)
    names += (names.empty() ? "`" : ", `") + signal + "`";
  return names.empty() ? "" : "\nnot known at the start: " + names + "; rows that hang on it stand still\n";
}

/// Of the first task in which the axis stands: what its rows do, and what the robot has for them.
std::string about_axis(const Loaded& loaded, std::size_t task, const lang::AxisStatements& axis) {
  const runtime::TaskPlan plan =
      runtime::Planner(loaded.program, loaded.diagnostics).plan(static_cast<int>(task));
  if (!plan.refused.empty())
    return "`" + axis.name + "` in `" + plan.task + "`: no rows: " + plan.refused + "\n";
  for (const runtime::PlannedAxis& planned : plan.axes) {
    if (planned.name != axis.name) continue;
    return "**`" + axis.name + "`** in `" + plan.task + "` on `" + loaded.program.robot.name + "`\n\n" +
           rows_of(plan, axis.name, planned.turns) + "\neffective mass: " + mass_of(planned) +
           "  \nlargest force: " + force_of(planned) +
           "  \nlimited by: " + limit_of(loaded.program, loaded.diagnostics, planned, axis.axis) + "\n" +
           unknown_of(plan);
  }
  return "`" + axis.name + "` has no row at the start of `" + plan.task + "`\n";
}

std::string about_row(const Asked& asked, const lang::Position& place) {
  const Judgement* judgement = asked.workspace.judgement(asked.file);
  if (judgement == nullptr || !judgement->now) return {};
  const lang::Program& program = judgement->now->program;
  for (std::size_t t = 0; t < program.tasks.size(); ++t) {
    for (const auto* groups : {&program.tasks[t].groups, &program.always.groups}) {
      for (const lang::Group& group : *groups) {
        for (const lang::AxisStatements& axis : group.axes) {
          if (holds_axis(axis, program.tasks[t].span, place)) return about_axis(*judgement->now, t, axis);
        }
      }
    }
  }
  return {};
}

/// The codes of the diagnostics at the place, and why they matter.
std::string about_diagnostics(const Asked& asked, const lang::Position& place) {
  std::string text;
  for (const auto& [reader, judgement] : asked.workspace.judgements()) {
    for (const lang::Diagnostic& d : judgement.diagnostics.sorted()) {
      if (!d.span.exists() || !holds(d.span, place)) continue;
      if (lang::canonical_name(judgement.diagnostics.source(d.span.source).path) != asked.file) continue;
      const lang::Explanation* explanation = lang::find_explanation(d.code);
      if (explanation != nullptr) text += "\n**" + d.code + "** " + std::string(explanation->why) + "\n";
    }
  }
  return text;
}

std::string about_parameter(const Asked& asked, const std::string& name) {
  const Judgement* judgement = asked.workspace.judgement(asked.file);
  if (judgement == nullptr || !judgement->last) return {};
  for (const lang::Parameter& p : judgement->last->program.parameters) {
    if (p.name != name) continue;
    const auto written = [&](double value) {
      char text[40];
      std::snprintf(text, sizeof text, "%g", value / p.unit_scale);
      return std::string(text) + (p.unit.empty() ? "" : " " + p.unit);
    };
    std::string text = "parameter `" + name + "` = " + written(p.value);
    if (p.range) text += ", from " + written(p.range->low) + " to " + written(p.range->high);
    return text + (p.help.empty() ? "\n" : "  \n" + p.help + "\n");
  }
  return {};
}

/// By the file that gives it. A name that a robot file gives is a frame. A word of a condition that no file
/// gives may be anything.
std::optional<lang::NameKind> kind_of_name(const Asked& asked, const lang::NamePlace& name) {
  if (name.is_given || name.kinds.size() == 1) return name.kinds.front();
  for (const std::filesystem::path& file : homes_of(asked.file)) {
    lang::Diagnostics unheard;
    const auto kind = lsp::kind_of(file);
    if (!kind) continue;
    for (const lang::NamePlace& given : lang::names_of(*kind, file, unheard)) {
      if (is_given_for(given, name)) return given.kinds.front();
    }
  }
  if (name.kinds.front() == lang::NameKind::group) return std::nullopt;
  return name.kinds.front();
}

std::string about_name(const Asked& asked, const lang::Position& place) {
  const std::optional<lang::NamePlace> name = name_at(asked.file, asked.kind, place);
  if (!name) return {};
  if (name->may_be(lang::NameKind::parameter)) {
    const std::string text = about_parameter(asked, name->name);
    if (!text.empty()) return text;
  }
  if (name->name == "estimated" && name->may_be(lang::NameKind::group))
    return "`estimated.force.x`, `estimated.FRAME.x`: what presses on the robot, by its torques and motion "
           "alone\n";
  if (name->name == "elapsed" && name->may_be(lang::NameKind::group))
    return "`elapsed`: time since the task was entered\n";
  const std::optional<lang::NameKind> kind = kind_of_name(asked, *name);
  return kind ? std::string(lang::word_of(*kind)) + " `" + name->name + "`\n" : "";
}

bool is_in_a_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// A function of conditions, in front of its parenthesis.
std::string about_function(const Asked& asked) {
  const std::string& text = asked.document.text;
  std::size_t begin = Lines(text).offset(asked.position), end = begin;
  while (begin > 0 && is_in_a_word(text[begin - 1])) --begin;
  while (end < text.size() && is_in_a_word(text[end])) ++end;
  const lang::ConditionFunction* function =
      end < text.size() && text[end] == '(' ? lang::find_function(text.substr(begin, end - begin)) : nullptr;
  if (function == nullptr) return {};
  return "`" + std::string(function->name) + "(..)`: " + std::string(function->of) + "\n";
}

bool is_in_a_quantity(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         std::string_view(" .+-/^%").find(c) != std::string_view::npos;
}

/// The longest quantity around the place: a number with its unit, in a condition, too.
std::string quantity_around(const std::string& text, std::size_t at) {
  std::size_t first = at, last = at;
  while (first > 0 && is_in_a_quantity(text[first - 1])) --first;
  while (last < text.size() && is_in_a_quantity(text[last])) ++last;
  for (std::size_t begin = first; begin <= at && begin < last; ++begin) {
    const bool is_within_a_word = begin > first && text[begin - 1] != ' ' && text[begin - 1] != '-';
    if (text[begin] == ' ' || is_within_a_word) continue;
    for (std::size_t end = last; end > at; --end) {
      const std::string written = text.substr(begin, end - begin);
      if (text[end - 1] != ' ' && !lang::kind_of_quantity(written).empty()) return written;
    }
  }
  return {};
}

/// The number with its unit: in SI, and what is measured.
std::string about_quantity(const Asked& asked) {
  const std::string written =
      quantity_around(asked.document.text, Lines(asked.document.text).offset(asked.position));
  if (written.empty()) return {};
  const std::string si = lang::in_si(written);
  return "`" + written + "`" + (si.empty() ? "" : " = " + si) + ": " + lang::kind_of_quantity(written) + "\n";
}

std::string about_place(const Asked& asked) {
  const std::string& text = asked.document.text;
  std::size_t at = Lines(text).offset(asked.position);
  // To the end of the word: a key is known by its colon.
  while (at < text.size() && is_in_a_word(text[at])) ++at;
  lang::TextPlace place = lang::place_at(text, at);
  if (place.is_key) place.keys.push_back(text.substr(place.word_begin, at - place.word_begin));
  return lang::about_key(asked.kind, place.keys);
}

}  // namespace

Json hover(const Asked& asked) {
  const lang::Position place = Lines(asked.document.text).from_editor(asked.position);
  std::string text;
  for (const std::string& part :
       {about_row(asked, place), about_name(asked, place), about_function(asked), about_quantity(asked),
        about_place(asked), about_diagnostics(asked, place)}) {
    if (!part.empty()) text += (text.empty() ? "" : "\n") + part;
  }
  if (text.empty()) return nullptr;
  return {{"contents", {{"kind", "markdown"}, {"value", text}}}};
}

}  // namespace zwang::lsp
