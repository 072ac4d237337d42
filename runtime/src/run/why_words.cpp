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

std::string number(double value, const std::string& unit) {
  std::string text = with_unit(value, unit);
  while (text.back() == ' ') text.pop_back();
  return text;
}

/// What the term read, and how that went on.
std::string value_of(const WaitedTerm& term) {
  if (!term.value) return {};
  std::string text = number(*term.value, term.unit);
  if (term.bound) text += " against " + number(*term.bound, term.unit);
  if (term.stood_throughout) {
    text += " all the time";
  } else if (term.stood > 0.0) {
    text += " for at least " + with_unit(term.stood, "s", 2);
  } else if (term.recedes) {
    text += ", ever farther from it";
  }
  if (!term.asked.empty()) text += "; " + term.asked;
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
  return name + " fell silent: it came last " + seconds(signal.age) + " ago and counts for " +
         seconds(signal.stale_after);
}

/// The signals without which the condition is not known.
std::vector<std::string> WhyWords::missing(const WaitedExit& exit) {
  std::vector<std::string> words;
  for (const WaitedTerm& term : exit.terms) {
    if (!term.holds_back) continue;
    for (const WaitedSignal& signal : term.signals) {
      const std::string one = in_words(signal);
      if (std::ranges::find(words, one) == words.end()) words.push_back(one);
    }
  }
  return words;
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
    for (const WaitedSignal& signal : term.signals) signals.push_back(quoted(signal.name));
    std::string because =
        signals.empty() ? " because " + term.because : " without " + joined(signals, ", ", " and ");
    if (term.verdict != Verdict::unknown) {
      parts.push_back(quoted(term.text) + " is " + to_string(term.verdict) + value_of(term));
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
    parts.push_back(joined(u.terms, ", ", " and ") + (u.terms.size() > 1 ? " are" : " is") + " unknown" +
                    u.because);
  }
  return joined(parts, ", ", " and ");
}

std::string WhyWords::of_exit(const WaitedExit& exit) const {
  const std::string of_needed =
      seconds(exit.longest) + " of the " + seconds(exit.needed) + " that it must hold";
  if (exit.verdict == Verdict::yes) return quoted(exit.when) + " has been true for " + of_needed;
  if (exit.longest == 0.0) return of_terms(exit);
  const std::string often = exit.times > 1 ? std::to_string(exit.times) + " times, at most for " : "for ";
  return of_terms(exit) + " after it was true " + often + of_needed;
}

std::string words_of_excursion(const Statement& row, const Event& told, bool at_start,
                               const std::vector<LimitReport>& limits) {
  const double at_first = told.value;
  const std::string when = at_start ? ", from the start" : " at " + seconds(told.time);
  const std::string left = at_start ? " stood outside of " : " left ";
  const std::string column = row.name + (row.inside ? ".left" : ".position");
  const auto limit = std::ranges::find(limits, column, &LimitReport::row);
  const std::string unit = unit_of(row.says.axis, solver::Quantity::position);
  const double beyond = limit == limits.end() ? at_first : std::max(at_first, -limit->margin);
  const std::string frame = quoted(row.frame);
  if (!row.inside || limit == limits.end())
    return frame + left +
           (row.inside ? "the region " + quoted(row.region) : "its range of " + quoted(row.name)) + " by " +
           with_unit(beyond, unit) + when;
  // A region keeps its frame a margin away from its edge: the margin is left first. A polygon's limit counts
  // from an edge, that of a circle from the centre.
  const bool is_circle = row.radius > 0.0;
  const double outside = is_circle ? limit->worst - row.radius : -limit->worst;
  const double kept = is_circle ? row.radius - limit->limit : limit->limit;
  if (outside > 0.0)
    return frame + left + "the region " + quoted(row.region) + " by " + with_unit(outside, unit) + when;
  return frame + " came within " + with_unit(-outside, unit) + " of the edge of the region " +
         quoted(row.region) + ", which keeps a margin of " + with_unit(kept, unit) + "," + when;
}

std::vector<WaitedExit> WhyWords::leading(const WaitedTask& task) {
  std::vector<WaitedExit> exits = task.exits;
  if (std::ranges::any_of(exits, &WaitedExit::can_reach_done))
    std::erase_if(exits, [](const WaitedExit& exit) { return !exit.can_reach_done; });
  return exits;
}

std::string WhyWords::of_waiting(const WaitedTask& task) const {
  if (task.exits.empty()) return "it has no exits";
  std::vector<std::string> parts;
  for (const WaitedExit& exit : leading(task)) parts.push_back(of_exit(exit));
  return joined(parts, "; ", "; ");
}

std::optional<double> WhyWords::time_left(const WaitedExit& exit) {
  double left = 0.0;
  for (const WaitedTerm& term : exit.terms) {
    if (!term.holds_back) continue;
    if (!term.left) return std::nullopt;
    left = std::max(left, *term.left);
  }
  // What came and went will not hold for so long because it is true right now.
  if (exit.times > (exit.verdict == Verdict::yes ? 1 : 0)) return std::nullopt;
  return left + std::max(0.0, exit.needed - exit.true_for);
}

}  // namespace zwang::runtime
