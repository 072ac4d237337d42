#include "diagnostic/make.hpp"
#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_never.hpp"
#include "words/text.hpp"

namespace zwang::lang::wording {

Diagnostic condition_ends(const Span& span) {
  return error("E105", span, "the condition ends where a value is due");
}

Diagnostic condition_too_deep(const Span& span, int limit) {
  return error("E105", span, "the condition is nested deeper than " + std::to_string(limit) + " levels");
}

Diagnostic missing_parenthesis(const Span& opened) {
  return error("E105", opened, "missing `)`", "this `(` is never closed");
}

Diagnostic unopened_parenthesis(const Span& span) {
  return error("E105", span, "this `)` closes nothing");
}

Diagnostic symbol_for_word(const Span& span, const std::string& symbol, const std::string& word) {
  return with_replacement(
      error("E105", span, "`" + symbol + "` is not part of conditions", "write `" + word + "`"), word);
}

Diagnostic equality(const Span& span) {
  return error("E105", span, "measured numbers are never exactly equal",
               "compare the distance: `abs(a - b) < 1 mm`");
}

Diagnostic equality_of_truth(const Span& span) {
  return error("E105", span, "what is true or false is not compared",
               "write the signal alone, or `not` and the signal");
}

Diagnostic chained_comparison(const Span& span) {
  return error("E105", span, "a comparison has two sides", "write `a < b and b < c`");
}

Diagnostic unexpected_in_condition(const Span& span, const std::string& text) {
  return error("E105", span, in_ticks(text) + " is not expected here",
               text == "for"      ? "say `for` on a line of its own, beside `when`"
               : text == ","      ? "join conditions with `and` or `or`"
               : text == "|"      ? "write the size of `a` as `abs(a)`"
               : text == "in"     ? "write both ends: `low < a and a < high`"
               : text == "\u2265" ? "write `>=`"
               : text == "\u2264" ? "write `<=`"
                                  : "a comparison is written as `elapsed > 2 s`");
}

Diagnostic missing_argument(const Span& span, const std::string& function) {
  return error("E105", span, "`" + function + "()` does not say of what",
               "for example `" + function + "(base_link)`");
}

Diagnostic decided_condition(const Span& span, bool is_always, bool by_half_turn) {
  const std::string what = is_always ? "this condition is always true" : "this condition can never be true";
  if (by_half_turn)
    return error("E505", span, what + ": an angle starts anew at 180 deg",
                 "compare within half a turn; `turned(FRAME)` counts on");
  return error("E505", span, what, "compare with a value that what is measured can pass");
}

Diagnostic beyond_half_a_turn(const Span& span, const std::string& axis) {
  return error(
      "E413", span,
      "`" + axis + "` starts anew at 180 deg, and this range goes beyond: the base would turn on and on",
      "keep both ends within [-180 deg, 180 deg]; for a range about 180 deg turn the frame of `in`");
}

Diagnostic wraps_to(const Span& span, const std::string& axis, double target, double instead) {
  return warning("W421", span,
                 "`" + axis + "` goes the shorter way to " + angle_in_degrees(instead) +
                     ", which is what it measures there: angles start anew at 180 deg, and " +
                     angle_in_degrees(target) + " is beyond",
                 "write `" + angle_in_degrees(instead) +
                     "`; to turn on, drive a velocity until `turned(FRAME)` says how far");
}

Diagnostic part_is_always_true(const Span& span) {
  return warning("W511", span, "this is true at once: one of its parts always is",
                 "join them with `and`, or look at the direction of the comparisons");
}

}  // namespace zwang::lang::wording
