#include "diagnostic/make.hpp"
#include "diagnostic/wordings.hpp"
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
                                  : "");
}

Diagnostic missing_argument(const Span& span, const std::string& function) {
  return error("E105", span, "`" + function + "()` does not say of what",
               "for example `" + function + "(base_link)`");
}

}  // namespace zwang::lang::wording
