#include <algorithm>
#include <cmath>
#include <filesystem>

#include "run/why.hpp"
#include "zwang/runtime/with_unit.hpp"

namespace zwang::runtime {

namespace {

std::string quoted(const std::string& text) {
  return "`" + text + "`";
}

std::string seconds(double time) {
  return with_unit(time, "s");
}

std::string joined(const std::vector<std::string>& parts, const char* comma, const char* last) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 < parts.size() ? comma : last;
    text += parts[i];
  }
  return text;
}

std::string value_of(const WaitedTerm& term) {
  if (!term.value) return {};
  std::string text = with_unit(*term.value, term.unit);
  if (term.bound) text += " against " + with_unit(*term.bound, term.unit);
  while (text.back() == ' ') text.pop_back();
  return " (" + text + ")";
}

}  // namespace

std::string WhyWords::place(const lang::Span& span) const {
  if (!span.exists()) return {};
  return " (" + std::filesystem::path(end.file).filename().string() + ":" + std::to_string(span.begin.line) +
         ")";
}

std::string in_words(const WaitedSignal& signal) {
  const std::string name = quoted(signal.name);
  if (signal.refused) {
    const std::string refused = "samples of " + name + " came and were refused";
    if (signal.ahead == 0.0) return refused;
    return refused + ", stamped " + seconds(std::abs(signal.ahead)) +
           (signal.ahead > 0.0 ? " ahead" : " behind");
  }
  if (!signal.received) return name + " was never received";
  return name + " came last " + seconds(signal.age) + " ago and counts for " + seconds(signal.stale_after);
}

/// The terms that hold the condition back; those that are unknown for one reason together.
std::string WhyWords::of_terms(const WaitedExit& exit) const {
  struct Unknown {
    std::string because;
    std::vector<std::string> terms;
  };
  std::vector<std::string> parts;
  std::vector<Unknown> unknown;
  for (const WaitedTerm& term : exit.terms) {
    if (!term.holds_back) continue;
    std::vector<std::string> signals;
    for (const WaitedSignal& signal : term.signals) signals.push_back(in_words(signal));
    std::string because = signals.empty() ? term.because : joined(signals, ", ", " and ");
    if (term.verdict != Verdict::unknown) {
      const std::string is = std::string(" is ") + to_string(term.verdict) + value_of(term);
      parts.push_back(quoted(term.text) + is + (because.empty() ? "" : " because " + because));
      continue;
    }
    const auto same = std::ranges::find(unknown, because, &Unknown::because);
    if (same != unknown.end()) {
      same->terms.push_back(quoted(term.text));
    } else {
      unknown.push_back({because, {quoted(term.text)}});
    }
  }
  for (const Unknown& u : unknown) {
    parts.push_back(joined(u.terms, ", ", " and ") + (u.terms.size() > 1 ? " are" : " is") +
                    " unknown because " + u.because);
  }
  return joined(parts, ", ", " and ");
}

std::string WhyWords::of_exit(const WaitedExit& exit) const {
  const std::string of_needed =
      seconds(exit.longest) + " of the " + seconds(exit.needed) + " that it must hold";
  if (exit.verdict == Verdict::yes) return quoted(exit.when) + " has been true for " + of_needed;
  const std::string was_true = exit.longest > 0.0 ? " after it was true for " + of_needed : "";
  return of_terms(exit) + was_true;
}

std::string words_of_excursion(const Statement& row, double at_first,
                               const std::vector<LimitReport>& limits) {
  const std::string column = row.name + (row.inside ? ".left" : ".position");
  const auto limit = std::ranges::find(limits, column, &LimitReport::row);
  const std::string unit = unit_of(row.says.axis, solver::Quantity::position);
  const double beyond = limit == limits.end() ? at_first : std::max(at_first, -limit->margin);
  const std::string frame = quoted(row.frame);
  if (!row.inside || limit == limits.end())
    return frame + " left " +
           (row.inside ? "the region " + quoted(row.region) : "its range of " + quoted(row.name)) + " by " +
           with_unit(beyond, unit);
  // A region keeps its frame a margin away from its edge: the margin is left first. A polygon's limit counts
  // from an edge, that of a circle from the centre.
  const bool is_circle = row.radius > 0.0;
  const double outside = is_circle ? limit->worst - row.radius : -limit->worst;
  const double kept = is_circle ? row.radius - limit->limit : limit->limit;
  if (outside > 0.0)
    return frame + " left the region " + quoted(row.region) + " by " + with_unit(outside, unit);
  return frame + " came within " + with_unit(-outside, unit) + " of the edge of the region " +
         quoted(row.region) + ", which keeps a margin of " + with_unit(kept, unit);
}

/// The exits that lead on; where none does, all.
std::string WhyWords::of_waiting(const WaitedTask& task) const {
  if (task.exits.empty()) return "it has no exits";
  const bool leads_on = std::ranges::any_of(task.exits, &WaitedExit::can_reach_done);
  std::vector<std::string> parts;
  for (const WaitedExit& exit : task.exits) {
    if (exit.can_reach_done || !leads_on) parts.push_back(of_exit(exit));
  }
  return joined(parts, "; ", "; ");
}

}  // namespace zwang::runtime
