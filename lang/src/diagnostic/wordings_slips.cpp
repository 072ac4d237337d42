#include "diagnostic/wordings_slips.hpp"

#include <array>
#include <utility>

#include "diagnostic/make.hpp"
#include "tree/text.hpp"

namespace zwang::lang::wording {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 12> spellings{{
    {"\u00a0", " "},     // no-break space
    {"\u202f", " "},     // narrow no-break space
    {"\u2212", "-"},     // minus
    {"\u2013", "-"},     // en dash
    {"\u00b1", "+-"},    // plus-minus
    {"\u00b2", "^2"},    // superscript two
    {"\u00b3", "^3"},    // superscript three
    {"\u00b7", " "},     // middle dot
    {"\u22c5", " "},     // dot operator
    {"\u00b5", "u"},     // micro
    {"\u03bc", "u"},     // mu
    {"\u00b0", " deg"},  // degree
}};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

std::string plainly_written(const std::string& text) {
  std::string plain = text;
  for (const auto& [odd, usual] : spellings) {
    for (std::size_t at = 0; (at = plain.find(odd, at)) != std::string::npos; at += usual.size()) {
      plain.replace(at, odd.size(), usual);
    }
  }
  // Between digits a comma stands for the point, and an underscore for nothing.
  for (std::size_t i = 1; i + 1 < plain.size(); ++i) {
    if (!is_digit(plain[i - 1]) || !is_digit(plain[i + 1])) continue;
    if (plain[i] == ',') plain[i] = '.';
    if (plain[i] == '_') plain.erase(i, 1);
  }
  return plain;
}

Diagnostic odd_letters(const Span& span, const std::string& text, const std::string& plain) {
  return with_replacement(error("E105", span, in_ticks(text) + " is spelt in a way that zwang does not read",
                                "write `" + plain + "`"),
                          plain);
}

Diagnostic word_in_capitals(const Span& span, const std::string& text, const std::string& word) {
  return with_replacement(
      error("E105", span, in_ticks(text) + " is not part of conditions", "write `" + word + "`"), word);
}

Diagnostic divides_by_zero(const Span& span) {
  return error("E105", span, "this divides by zero", "compare what stands above it instead");
}

Diagnostic speed_from_zero(const Span& span, const std::string& what) {
  return error("E104", span, what + " begins at 0: a speed has no direction, and nothing keeps it up",
               "write `[0 m/s, ..]`");
}

Diagnostic urdf_for_robot_file(const Span& span) {
  return error("E103", span, "this is a URDF, not a robot file",
               "`zwang robot init` writes the robot file that goes with it");
}

}  // namespace zwang::lang::wording
