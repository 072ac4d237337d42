#include "tree/prescan.hpp"

#include <optional>

#include "diagnostic/wordings.hpp"
#include "diagnostic/wordings_slips.hpp"
#include "words/code_point.hpp"
#include "words/text.hpp"

namespace zwang::lang {

namespace {

Span span_at(int source, const TextIndex& index, std::size_t begin, std::size_t end) {
  return {source, index.position(begin), index.position(end)};
}

/// The offset of the quote that closes the one at `begin`; \" and '' are quotes inside.
std::optional<std::size_t> closing_quote(std::string_view line, std::size_t begin) {
  const char quote = line[begin];
  for (std::size_t i = begin + 1; i < line.size(); ++i) {
    const bool is_doubled = quote == '\'' && i + 1 < line.size() && line[i] == quote && line[i + 1] == quote;
    const bool is_escaped = quote == '"' && line[i] == '\\';
    if (is_doubled || is_escaped) {
      ++i;
    } else if (line[i] == quote) {
      return i;
    }
  }
  return std::nullopt;
}

/// Walks one line of YAML as far as it takes to know where quotes and comments are.
struct LineScan {
  std::optional<std::size_t> comment;     ///< offset of its `#`
  std::optional<std::size_t> open_quote;  ///< offset of a quote that does not close
};

LineScan scan_line(std::string_view line) {
  LineScan result;
  bool token_may_start = true;  // only there does a quote open a quoted scalar
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) {
      result.comment = i;
      return result;
    }
    if ((c == '"' || c == '\'') && token_may_start) {
      const std::optional<std::size_t> end = closing_quote(line, i);
      if (!end) {
        result.open_quote = i;
        return result;
      }
      i = *end;
    }
    const bool opens = c == ',' || c == '[' || c == '{' || c == ':' || c == '-' || c == '?';
    if (c != ' ' && c != '\t') token_may_start = opens;
    // `don't`, `a-'b'`: an indicator opens a token only when a space follows it or it is a bracket.
    if ((c == ':' || c == '-' || c == '?') && i + 1 < line.size() && line[i + 1] != ' ') {
      token_may_start = false;
    }
  }
  return result;
}

}  // namespace

bool prescan_characters(int source, std::string_view text, const char* code, Diagnostics& diagnostics) {
  for (std::size_t at = 0; at < text.size();) {
    const std::optional<CodePoint> c = decode(text, at);
    const bool lone_return = c && c->value == '\r' && (at + 1 == text.size() || text[at + 1] != '\n');
    if (c && !is_control(c->value) && !is_deceptive(c->value) && !lone_return) {
      at += c->bytes;
      continue;
    }
    const TextIndex index(text);
    const Span span = span_at(source, index, at, at + 1);
    if (!c) {
      diagnostics.add(wording::not_utf8(span, code));
    } else if (lone_return && std::string_view(code) == "E100") {
      diagnostics.add(wording::lone_return(span));
    } else {
      diagnostics.add(wording::forbidden_character(span, code, c->value));
    }
    return false;
  }
  return true;
}

bool prescan_yaml(int source, std::string_view text, Diagnostics& diagnostics,
                  std::vector<Comment>& comments) {
  if (!prescan_characters(source, text, "E100", diagnostics)) return false;
  const TextIndex index(text);
  bool is_good = true;
  for (int number = 1; number <= index.line_count(); ++number) {
    const std::string_view line = index.line(number);
    const std::size_t start = index.offset({number, 1});
    const auto span = [&](std::size_t begin, std::size_t end) {
      return span_at(source, index, start + begin, start + end);
    };
    if (line.size() > longest_line) {
      diagnostics.add(wording::line_too_long(span(0, 1), longest_line));
      return false;
    }
    // yaml-cpp passes over such lines wherever they stand, with all that they say.
    if (line.starts_with('%')) {
      diagnostics.add(wording::directive(span(0, 1)));
      is_good = false;
      continue;
    }
    const LineScan scan = scan_line(line);
    if (scan.comment) {
      comments.push_back({std::string(line.substr(*scan.comment)), span(*scan.comment, line.size())});
    }
    if (scan.open_quote) {
      diagnostics.add(wording::open_quote(span(*scan.open_quote, *scan.open_quote + 1)));
      is_good = false;
    }
    const std::size_t tab = line.substr(0, scan.comment.value_or(line.size())).find('\t');
    if (tab != std::string_view::npos) {
      const bool indents = line.find_first_not_of(" \t") > tab;
      diagnostics.add(wording::tab(span(tab, tab + 1), indents));
      is_good = false;
    }
  }
  return is_good;
}

}  // namespace zwang::lang
