#include "tree/allowances.hpp"

#include <optional>

#include "diagnostic/wordings.hpp"
#include "words/nearest.hpp"
#include "words/text.hpp"
#include "zwang/lang/explanation.hpp"

namespace zwang::lang {

namespace {

/// Takes the first word off the text.
std::string_view take_word(std::string_view& text) {
  const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
  const std::size_t end = std::min(text.find_first_of(" \t", begin), text.size());
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

/// What stands behind `# zwang:`. A version key that was commented out (`# zwang: 1`) is no instruction.
std::optional<std::string_view> instruction_in(std::string_view comment) {
  comment.remove_prefix(1);
  if (take_word(comment) != "zwang:") return std::nullopt;
  std::string_view rest = comment;
  const std::string_view word = take_word(rest);
  if (!word.empty() && word[0] >= '0' && word[0] <= '9') return std::nullopt;
  return comment;
}

/// A comment behind something speaks for its own line, one that stands alone for the next line with text.
int line_meant(const Span& comment, const TextIndex& index) {
  const std::string_view own = index.line(comment.begin.line);
  if (own.find_first_not_of(" \t") != own.find('#')) return comment.begin.line;
  for (int line = comment.begin.line + 1; line <= index.line_count(); ++line) {
    const std::string_view text = index.line(line);
    const std::size_t first = text.find_first_not_of(" \t");
    if (first != std::string_view::npos && text[first] != '#') return line;
  }
  return comment.begin.line;
}

void refuse_code(const Comment& comment, std::string_view code, Diagnostics& diagnostics) {
  std::vector<std::string> silenceable;
  for (const Explanation& explanation : explanations()) {
    if (explanation.code[0] != 'E') silenceable.emplace_back(explanation.code);
  }
  // The span is the whole comment, so the nearest code is no replacement for it.
  Diagnostic refusal =
      wording::unknown_code(comment.span, std::string(code), nearest(std::string(code), silenceable));
  refusal.replacement.reset();
  diagnostics.add(std::move(refusal));
}

}  // namespace

void read_allowances(const std::vector<Comment>& comments, std::string_view text, Diagnostics& diagnostics) {
  std::optional<TextIndex> index;
  for (const Comment& comment : comments) {
    const std::optional<std::string_view> instruction = instruction_in(comment.text);
    if (!instruction) continue;
    std::string_view rest = *instruction;
    const std::string verb(take_word(rest));
    if (verb != "allow") {
      diagnostics.add(wording::unreadable_instruction(comment.span, verb));
      continue;
    }
    const std::string code(take_word(rest));
    const std::string reason = trimmed(rest);
    const Explanation* explanation = find_explanation(code);
    if (code.empty()) {
      diagnostics.add(wording::allowance_without_code(comment.span));
    } else if (explanation == nullptr) {
      refuse_code(comment, code, diagnostics);
    } else if (explanation->code[0] == 'E') {
      diagnostics.add(wording::allowed_error(comment.span, std::string(explanation->code)));
    } else if (reason.empty()) {
      diagnostics.add(wording::allowance_without_reason(comment.span, code));
    } else {
      if (!index) index.emplace(text);
      diagnostics.allow(
          {std::string(explanation->code), reason, line_meant(comment.span, *index), comment.span});
    }
  }
}

}  // namespace zwang::lang
