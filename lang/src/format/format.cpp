#include "zwang/lang/format.hpp"

#include <algorithm>
#include <stdexcept>

#include "diagnostic/wordings.hpp"
#include "format/tokens.hpp"
#include "tree/file.hpp"
#include "words/text.hpp"

namespace zwang::lang {

namespace {

constexpr int indent_width = 2;
constexpr int comment_gap = 2;
/// Comments of neighbouring lines share a column as long as none of the lines is longer than this.
constexpr std::size_t widest_before_comment = 90;

bool is(const Token& token, char c) {
  return token.kind == TokenKind::punctuation && token.text.size() == 1 && token.text[0] == c;
}

bool opens(const Token& token) {
  return is(token, '{') || is(token, '[');
}

bool closes(const Token& token) {
  return is(token, '}') || is(token, ']');
}

bool has_space_between(const Token& left, const Token& right) {
  if (opens(left) || closes(right)) return false;
  return !is(right, ',') && !is(right, ':');
}

std::string joined(const std::vector<Token>& tokens) {
  std::string text;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (i > 0 && has_space_between(tokens[i - 1], tokens[i])) text += ' ';
    text += tokens[i].text;
  }
  return text;
}

/// A line `key: value`, the value behind it.
bool is_entry(const LineTokens& line) {
  return !line.continues && line.tokens.size() > 2 && line.tokens[0].kind == TokenKind::scalar &&
         is(line.tokens[1], ':');
}

/// Neighbours whose values the author put in one column, behind keys of several lengths, keep a common
/// column: the widest key's. The number of lines from `begin` on; 1: the line stands alone.
std::size_t aligned_run(const std::vector<LineTokens>& lines, std::size_t begin) {
  std::size_t end = begin;
  while (end < lines.size() && is_entry(lines[end]) && lines[end].depth == lines[begin].depth &&
         lines[end].tokens[2].column == lines[begin].tokens[2].column) {
    ++end;
  }
  return std::max<std::size_t>(end - begin, 1);
}

std::string with_padded_key(const LineTokens& line, std::size_t column) {
  std::string text = line.tokens[0].text + ":";
  text += std::string(column - count_code_points(text), ' ');
  return text + joined({line.tokens.begin() + 2, line.tokens.end()});
}

/// A line of the result: its indent, its text and its comment.
struct LaidLine {
  int indent = 0;
  std::string text;
  std::string comment;
  bool continues = false;  ///< goes on with the line before it: blank lines between them are part of a text

  bool is_blank() const { return text.empty() && comment.empty(); }
  std::size_t width() const { return static_cast<std::size_t>(indent) + count_code_points(text); }
};

/// Lines that start an entry stand at their depth. A continuation line keeps its distance from the line that
/// it belongs to, so that aligned text stays aligned.
std::vector<LaidLine> laid_out(const std::vector<LineTokens>& lines) {
  std::vector<LaidLine> result;
  const LineTokens* owner = nullptr;
  int shift = 0;
  for (const LineTokens& line : lines) {
    LaidLine laid{line.indent, joined(line.tokens), line.comment, line.continues};
    if (!line.tokens.empty() && !line.continues) {
      laid.indent = indent_width * line.depth;
      owner = &line;
      shift = laid.indent - line.indent;
    } else if (!line.tokens.empty()) {
      const int least = owner == nullptr ? 0 : indent_width * (owner->depth + 1);
      laid.indent = std::max(least, line.indent + shift);
    }
    result.push_back(std::move(laid));
  }
  for (std::size_t i = 0; i < lines.size();) {
    const std::size_t run = aligned_run(lines, i);
    std::size_t widest = 0;
    for (std::size_t k = i; run > 1 && k < i + run; ++k) {
      widest = std::max(widest, count_code_points(lines[k].tokens[0].text) + 1);
    }
    for (std::size_t k = i; run > 1 && k < i + run; ++k) {
      result[k].text = with_padded_key(lines[k], widest + 1);
    }
    i += run;
  }
  return result;
}

/// A comment alone on its line stands like the next line; deeper ones close the block before them.
void indent_comments(const std::vector<LineTokens>& lines, std::vector<LaidLine>& laid) {
  const auto is_text = [&](std::size_t i) { return !lines[i].tokens.empty(); };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_text(i) || lines[i].comment.empty()) continue;
    std::size_t next = i + 1;
    while (next < lines.size() && !is_text(next)) ++next;
    const bool has_next = next < lines.size();
    laid[i].indent = has_next ? laid[next].indent : 0;
    if (has_next && lines[i].indent <= lines[next].indent) continue;
    for (std::size_t before = i; before-- > 0;) {
      if (!is_text(before) || lines[before].indent > lines[i].indent) continue;
      laid[i].indent = std::max(laid[i].indent, laid[before].indent);
      break;
    }
  }
}

/// The column of the comments in a run of lines that have both text and comment.
std::size_t comment_column(const std::vector<LaidLine>& lines, std::size_t begin, std::size_t end) {
  std::size_t widest = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (lines[i].width() <= widest_before_comment) widest = std::max(widest, lines[i].width());
  }
  return widest + comment_gap;
}

std::string written(const std::vector<LaidLine>& lines) {
  const auto has_both = [&](std::size_t i) {
    return i < lines.size() && !lines[i].text.empty() && !lines[i].comment.empty();
  };
  std::string text;
  std::size_t run_end = 0, column = 0;
  bool was_blank = true;  // no blank line at the top
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const LaidLine& line = lines[i];
    if (line.is_blank()) {
      const auto next = std::find_if(lines.begin() + static_cast<std::ptrdiff_t>(i), lines.end(),
                                     [](const LaidLine& later) { return !later.is_blank(); });
      const bool is_in_a_text = next != lines.end() && next->continues;
      if (!was_blank || is_in_a_text) text += '\n';
      was_blank = true;
      continue;
    }
    was_blank = false;
    if (has_both(i) && i >= run_end) {
      run_end = i;
      while (has_both(run_end)) ++run_end;
      column = comment_column(lines, i, run_end);
    }
    text += std::string(static_cast<std::size_t>(line.indent), ' ') + line.text;
    if (has_both(i)) {
      const std::size_t gap = line.width() + comment_gap > column ? comment_gap : column - line.width();
      text += std::string(gap, ' ');
    }
    text += line.comment + '\n';
  }
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

bool is_same(const Node& a, const Node& b) {
  const bool is_alike = a.kind == b.kind && a.text == b.text && a.is_quoted == b.is_quoted &&
                        a.items.size() == b.items.size() && a.entries.size() == b.entries.size();
  if (!is_alike) return false;
  for (std::size_t i = 0; i < a.items.size(); ++i) {
    if (!is_same(a.items[i], b.items[i])) return false;
  }
  for (std::size_t i = 0; i < a.entries.size(); ++i) {
    if (!is_same(a.entries[i].key, b.entries[i].key)) return false;
    if (!is_same(a.entries[i].value, b.entries[i].value)) return false;
  }
  return true;
}

/// Whether the layout changed nothing but space.
bool means_the_same(const Document& before, const std::string& text) {
  Diagnostics diagnostics;
  const std::optional<Document> after = read(diagnostics.add_source({"", text}), diagnostics);
  if (!after || diagnostics.has_errors() || after->comments.size() != before.comments.size()) return false;
  for (std::size_t i = 0; i < before.comments.size(); ++i) {
    if (trimmed(before.comments[i].text) != trimmed(after->comments[i].text)) return false;
  }
  return is_same(before.root, after->root);
}

}  // namespace

std::optional<std::string> format_source(int source, Diagnostics& diagnostics) {
  const std::optional<Document> document = read(source, diagnostics);
  if (!document || diagnostics.has_errors()) return std::nullopt;
  if (!document->root.is_mapping()) {
    diagnostics.add(wording::expected_mapping(document->root.span, "a file", document->root.is_sequence()));
    return std::nullopt;
  }
  const std::vector<LineTokens> lines = tokens_of(*document, diagnostics.source(source).text);
  std::vector<LaidLine> laid = laid_out(lines);
  indent_comments(lines, laid);
  std::string text = written(laid);
  if (means_the_same(*document, text)) return text;
  throw std::logic_error(diagnostics.source(source).path +
                         ": the layout would change what the file means; it is left as it is");
}

std::optional<std::string> format_file(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const std::optional<int> source = read_file(path, yaml_size_limit, {}, diagnostics);
  if (!source) return std::nullopt;
  return format_source(*source, diagnostics);
}

}  // namespace zwang::lang
