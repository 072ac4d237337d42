#include <algorithm>
#include <map>
#include <optional>
#include <ostream>

#include "diagnostic/severity.hpp"
#include "words/code_point.hpp"
#include "words/text.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

namespace {

std::string place(const Diagnostics& diagnostics, const Span& span) {
  return escaped(diagnostics.source(span.source).path) + ":" + std::to_string(span.begin.line) + ":" +
         std::to_string(span.begin.column);
}

/// Code points of `line` in [begin, end), one column each, as `Position` counts them. A tab becomes one
/// space, and a character that must not reach a terminal becomes `?`. A byte that continues no character has
/// no column of its own.
std::string columns(std::string_view line, std::size_t begin, std::size_t end) {
  std::string result;
  std::size_t column = 0;
  for (std::size_t at = 0; at < line.size();) {
    const std::optional<CodePoint> c = decode(line, at);
    const std::size_t bytes = c ? c->bytes : 1;
    const bool has_column = !is_continuation_byte(line[at]);
    if (has_column) ++column;
    if (has_column && column > begin && column <= end) {
      const bool is_safe = c && c->value >= 0x20 && !is_control(c->value) && !is_deceptive(c->value);
      result += is_safe ? std::string(line.substr(at, bytes)) : line[at] == '\t' ? " " : "?";
    }
    at += bytes;
  }
  return result;
}

/// The source line and a caret under the span; of a long line the part around it.
void render_line(const TextIndex& index, const Span& span, std::ostream& out) {
  constexpr std::size_t widest = 140;
  const std::string_view line = index.line(span.begin.line);
  if (line.empty() && span.begin.line >= index.line_count()) return;
  const std::size_t length = count_code_points(line);
  const std::size_t caret = std::min(static_cast<std::size_t>(std::max(span.begin.column, 1)) - 1, length);
  const std::size_t begin = caret < widest - 20 ? 0 : caret - (widest - 20);
  const std::size_t end = std::min(length, begin + widest);
  const bool one_line = span.end.line == span.begin.line && span.end.column >= span.begin.column;
  const std::size_t last = one_line ? static_cast<std::size_t>(span.end.column) - 1 : length;
  const std::size_t marks = std::max<std::size_t>(1, std::min(last, end) - std::min({caret, last, end}));
  const std::string number = std::to_string(span.begin.line);
  const std::string gutter(std::max<std::size_t>(number.size(), 4), ' ');
  out << gutter.substr(number.size()) << number << " | " << (begin > 0 ? "..." : "")
      << columns(line, begin, end) << (end < length ? "..." : "") << '\n'
      << gutter << " | " << std::string(caret - begin + (begin > 0 ? 3 : 0), ' ') << '^'
      << std::string(marks - 1, '~') << '\n';
}

}  // namespace

void render_human(const Diagnostics& diagnostics, std::ostream& out, const RenderOptions& options) {
  std::map<int, TextIndex> indices;  // a text is looked through once, not for every message
  for (const Diagnostic& d : diagnostics.sorted()) {
    if (d.severity == Severity::note && !options.notes) continue;
    if (d.span.exists()) out << place(diagnostics, d.span) << ": ";
    out << word_of(d.severity) << ' ' << d.code << ": " << escaped(d.message) << '\n';
    if (d.span.exists()) {
      const auto [index, is_new] = indices.try_emplace(d.span.source, diagnostics.source(d.span.source).text);
      render_line(index->second, d.span, out);
    }
    if (!d.help.empty()) out << "     = help: " << escaped(d.help) << '\n';
    for (const RelatedSpan& related : d.related) {
      out << "     = ";
      if (related.span.exists()) out << place(diagnostics, related.span) << ": ";
      out << escaped(related.text) << '\n';
    }
  }
}

void render_short(const Diagnostics& diagnostics, std::ostream& out, const RenderOptions& options) {
  for (const Diagnostic& d : diagnostics.sorted()) {
    if (d.severity == Severity::note && !options.notes) continue;
    if (d.span.exists()) out << place(diagnostics, d.span) << ": ";
    out << word_of(d.severity) << ' ' << d.code << ": " << escaped(d.message) << '\n';
  }
}

}  // namespace zwang::lang
