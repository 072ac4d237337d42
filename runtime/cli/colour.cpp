#include "colour.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <utility>

namespace zwang::cli {

namespace {

// U+FDD0 and its neighbours: https://www.unicode.org/faq/private_use.html#noncharacters
constexpr std::string_view mark_lead = "\xEF\xB7";
constexpr char first_hue = '\x90';
constexpr char hue_end = '\x9F';

// Bold red, magenta and green, as compilers have them: they are read on black and on white.
constexpr std::array<std::string_view, 3> escapes = {"\033[1;31m", "\033[1;35m", "\033[1;32m"};
constexpr std::string_view escape_end = "\033[0m";

std::string mark_of(char last) {
  return std::string(mark_lead) + last;
}

/// The last byte of the mark that stands there; none: no mark does.
std::optional<char> mark_at(std::string_view text, std::size_t at) {
  if (text.size() - at < 3 || text.substr(at, 2) != mark_lead) return std::nullopt;
  const char last = text[at + 2];
  const bool is_hue = last >= first_hue && last < first_hue + static_cast<char>(escapes.size());
  return is_hue || last == hue_end ? std::optional(last) : std::nullopt;
}

bool is_code(std::string_view word) {
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  return word.size() == 4 && std::isupper(static_cast<unsigned char>(word[0])) != 0 &&
         std::ranges::all_of(word.substr(1), is_digit);
}

struct FoundSeverity {
  Hue hue = Hue::bad;
  std::size_t begin = 0, end = 0;  ///< of `error E601`
};

/// Of the first line of a diagnostic: `press.yaml:8:60: error E601: ...`
std::optional<FoundSeverity> severity_in(std::string_view line) {
  for (const auto& [word, hue] :
       {std::pair<std::string_view, Hue>{"error ", Hue::bad}, {"warning ", Hue::warning}}) {
    for (std::size_t at = line.find(word); at != std::string_view::npos; at = line.find(word, at + 1)) {
      const std::size_t code = at + word.size(), end = code + 4;
      const bool is_begin = at == 0 || (at >= 2 && line.substr(at - 2, 2) == ": ");
      if (is_begin && end < line.size() && line[end] == ':' && is_code(line.substr(code, 4)))
        return FoundSeverity{hue, at, end};
    }
  }
  return std::nullopt;
}

/// Where the carets begin in `     |     ^~~~`.
std::optional<std::size_t> carets_in(std::string_view line) {
  const std::size_t caret = line.find('^');
  if (caret == std::string_view::npos || caret < 3) return std::nullopt;
  const bool is_gutter = line.substr(0, caret).find_first_not_of(" |") == std::string_view::npos;
  const bool is_caret = line.substr(caret + 1).find_first_not_of('~') == std::string_view::npos;
  return is_gutter && is_caret ? std::optional(caret) : std::nullopt;
}

}  // namespace

std::string marked(Hue hue, std::string_view text) {
  const char last = static_cast<char>(first_hue + static_cast<char>(hue));
  return mark_of(last).append(text).append(mark_of(hue_end));
}

std::string with_marked_severities(std::string_view rendered) {
  std::string text;
  std::optional<Hue> hue;  // of the diagnostic that the line belongs to
  while (!rendered.empty()) {
    const std::size_t length = std::min(rendered.find('\n'), rendered.size() - 1) + 1;
    const std::string_view whole = rendered.substr(0, length);
    const std::string_view line = whole.substr(0, whole.find('\n'));
    rendered.remove_prefix(length);
    const bool is_head = !line.empty() && line.front() != ' ';
    const auto severity = is_head ? severity_in(line) : std::nullopt;
    const auto caret = is_head ? std::nullopt : carets_in(line);
    if (is_head) hue = severity ? std::optional(severity->hue) : std::nullopt;
    if (severity) {
      text.append(line.substr(0, severity->begin));
      text += marked(severity->hue, line.substr(severity->begin, severity->end - severity->begin));
      text.append(whole.substr(severity->end));
    } else if (caret && hue) {
      text.append(line.substr(0, *caret));
      text += marked(*hue, line.substr(*caret));
      text.append(whole.substr(line.size()));
    } else {
      text.append(whole);
    }
  }
  return text;
}

std::string shown(std::string_view text, bool in_colour) {
  std::string result;
  bool is_open = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::optional<char> mark = mark_at(text, at);
    if (!mark) {
      result += text[at++];
      continue;
    }
    at += 3;
    is_open = *mark != hue_end;
    if (in_colour) result += is_open ? escapes[static_cast<std::size_t>(*mark - first_hue)] : escape_end;
  }
  if (is_open && in_colour) result += escape_end;
  return result;
}

bool takes_colour(int descriptor) noexcept {
  const char* refused = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  const bool has_colours = terminal != nullptr && *terminal != '\0' && std::string_view(terminal) != "dumb";
  return has_colours && (refused == nullptr || *refused == '\0') && isatty(descriptor) == 1;
}

std::size_t columns_of(std::string_view text) noexcept {
  std::size_t columns = 0;
  for (std::size_t at = 0; at < text.size();) {
    const bool is_mark = mark_at(text, at).has_value();
    if (!is_mark && (static_cast<unsigned char>(text[at]) & 0xC0U) != 0x80U) ++columns;
    at += is_mark ? 3 : 1;
  }
  return columns;
}

}  // namespace zwang::cli
