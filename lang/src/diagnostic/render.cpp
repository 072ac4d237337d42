#include <algorithm>
#include <ostream>
#include <sstream>

#include "tree/text.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

namespace {

const char* word(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      break;
  }
  return "error";
}

std::string place(const Diagnostics& diagnostics, const Span& span) {
  return escaped(diagnostics.source(span.source).path) + ":" + std::to_string(span.begin.line) + ":" +
         std::to_string(span.begin.column);
}

/// Code points of `line` in [begin, end), a tab as one space, control bytes as `?`: one column each.
std::string columns(std::string_view line, std::size_t begin, std::size_t end) {
  std::string result;
  std::size_t column = 0;
  for (const char c : line) {
    if (!is_continuation_byte(c)) ++column;
    if (column <= begin || column > end) continue;
    const auto byte = static_cast<unsigned char>(c);
    result += c == '\t' ? ' ' : (byte < 0x20 || byte == 0x7F) ? '?' : c;
  }
  return result;
}

/// The source line and a caret under the span; of a long line the part around it.
void render_line(const Diagnostics& diagnostics, const Span& span, std::ostream& out) {
  constexpr std::size_t widest = 140;
  const TextIndex index(diagnostics.source(span.source).text);
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

void render_json_string(std::ostream& out, std::string_view text) {
  out << '"';
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out << '\\' << c;
    } else if (c == '\n') {
      out << "\\n";
    } else if (byte < 0x20 || byte == 0x7F) {
      static constexpr const char* digits = "0123456789abcdef";
      out << "\\u00" << digits[byte >> 4u] << digits[byte & 0xFu];
    } else {
      out << c;
    }
  }
  out << '"';
}

void render_json_range(std::ostream& out, const Diagnostics& diagnostics, const Span& span) {
  if (!span.exists()) {
    out << "\"file\":null,\"range\":null";
    return;
  }
  const auto position = [&out](const Position& p) {
    out << "{\"line\":" << p.line << ",\"column\":" << p.column << "}";
  };
  out << "\"file\":";
  render_json_string(out, diagnostics.source(span.source).path);
  out << ",\"range\":{\"start\":";
  position(span.begin);
  out << ",\"end\":";
  position(span.end);
  out << "}";
}

}  // namespace

void render_human(const Diagnostics& diagnostics, std::ostream& out) {
  for (const Diagnostic& d : diagnostics.sorted()) {
    if (d.span.exists()) out << place(diagnostics, d.span) << ": ";
    out << word(d.severity) << ' ' << d.code << ": " << escaped(d.message) << '\n';
    if (d.span.exists()) render_line(diagnostics, d.span, out);
    if (!d.help.empty()) out << "     = help: " << escaped(d.help) << '\n';
    for (const RelatedSpan& related : d.related) {
      out << "     = ";
      if (related.span.exists()) out << place(diagnostics, related.span) << ": ";
      out << escaped(related.text) << '\n';
    }
  }
}

std::string render_json(const Diagnostics& diagnostics) {
  std::ostringstream out;
  out << '[';
  bool first = true;
  for (const Diagnostic& d : diagnostics.sorted()) {
    out << (first ? "" : ",") << "\n  {\"code\":";
    first = false;
    render_json_string(out, d.code);
    out << ",\"severity\":\"" << word(d.severity) << "\",";
    render_json_range(out, diagnostics, d.span);
    out << ",\"message\":";
    render_json_string(out, d.message);
    out << ",\"help\":";
    render_json_string(out, d.help);
    out << ",\"replacement\":";
    if (d.replacement) {
      render_json_string(out, *d.replacement);
    } else {
      out << "null";
    }
    out << ",\"related\":[";
    for (std::size_t i = 0; i < d.related.size(); ++i) {
      out << (i > 0 ? ",{" : "{");
      render_json_range(out, diagnostics, d.related[i].span);
      out << ",\"text\":";
      render_json_string(out, d.related[i].text);
      out << '}';
    }
    out << "]}";
  }
  out << (first ? "]" : "\n]");
  return out.str();
}

}  // namespace zwang::lang
