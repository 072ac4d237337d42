#include "tree/scalar_span.hpp"

#include <algorithm>

#include "words/text.hpp"

namespace zwang::lang {

namespace {

std::size_t end_of_quoted(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  for (std::size_t i = begin + 1; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text[i] == quote) {
      if (quote == '"' || i + 1 >= text.size() || text[i + 1] != quote) return i + 1;
      ++i;  // '' inside single quotes is one quote
    }
  }
  return text.size();
}

}  // namespace

std::vector<std::size_t> offsets_of_scalar(std::string_view text, std::size_t begin, std::string_view value,
                                           bool is_quoted) {
  std::vector<std::size_t> offsets;
  offsets.reserve(value.size() + 1);
  std::size_t at = begin + (is_quoted ? 1 : 0);
  for (const char c : value) {
    if (at >= text.size()) {
      offsets.push_back(text.size());
    } else if (is_space(c) && is_space(text[at]) && !is_quoted) {
      offsets.push_back(at);
      while (at < text.size() && is_space(text[at])) ++at;
      // Several spaces of one line stay several in the value; only a line end folds to one.
      const std::string_view gap = text.substr(offsets.back(), at - offsets.back());
      if (gap.find('\n') == std::string_view::npos) at = offsets.back() + 1;
    } else if (c == '\n' && !is_quoted) {
      offsets.push_back(at);  // of several blank lines: the first line end took all of the gap
    } else {
      const bool is_escape = is_quoted && text[at] != c;
      offsets.push_back(at);
      at += is_escape ? 2 : 1;
    }
  }
  offsets.push_back(std::min(at, text.size()));
  return offsets;
}

ScalarText find_scalar(std::string_view text, std::size_t begin, std::string_view value) {
  if (begin >= text.size()) return {ScalarStyle::plain, text.size()};
  if (text[begin] == '"' || text[begin] == '\'') {
    return {ScalarStyle::quoted, end_of_quoted(text, begin)};
  }
  if (text[begin] == '|' || text[begin] == '>') return {ScalarStyle::block, begin + 1};
  return {ScalarStyle::plain, offsets_of_scalar(text, begin, value, false).back()};
}

std::size_t end_of_flow(std::string_view text, std::size_t from, char bracket) {
  for (std::size_t i = from; i < text.size(); ++i) {
    if (text[i] == bracket) return i + 1;
    const bool is_comment = text[i] == '#' && i > 0 && is_space(text[i - 1]);
    if (is_comment) i = std::min(text.find('\n', i), text.size());
  }
  return text.size();
}

}  // namespace zwang::lang
