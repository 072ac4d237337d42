#include "lines.hpp"

#include <algorithm>

namespace zwang::lsp {

namespace {

/// [bytes] of the character that begins with this byte. Bytes that begin none count as one.
std::size_t length_of(unsigned char lead) {
  if (lead >= 0xF0) return 4;
  if (lead >= 0xE0) return 3;
  return lead >= 0xC0 ? 2 : 1;
}

/// Characters beyond the basic plane are pairs in UTF-16.
int units_of(std::size_t length) {
  return length == 4 ? 2 : 1;
}

}  // namespace

Lines::Lines(std::string_view text) : text_(text), starts_{0} {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') starts_.push_back(i + 1);
  }
}

std::string_view Lines::line(int number) const {
  if (number < 0 || static_cast<std::size_t>(number) >= starts_.size()) return {};
  const auto index = static_cast<std::size_t>(number);
  const std::size_t end = index + 1 < starts_.size() ? starts_[index + 1] - 1 : text_.size();
  std::string_view line = text_.substr(starts_[index], end - starts_[index]);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

EditorPosition Lines::to_editor(const lang::Position& position) const {
  const std::string_view text = line(position.line - 1);
  EditorPosition result{std::max(0, position.line - 1), 0};
  std::size_t at = 0;
  for (int column = 1; column < position.column && at < text.size(); ++column) {
    const std::size_t length = length_of(static_cast<unsigned char>(text[at]));
    result.character += units_of(length);
    at += length;
  }
  return result;
}

lang::Position Lines::from_editor(const EditorPosition& position) const {
  const std::string_view text = line(position.line);
  lang::Position result{position.line + 1, 1};
  std::size_t at = 0;
  for (int units = 0; at < text.size();) {
    const std::size_t length = length_of(static_cast<unsigned char>(text[at]));
    units += units_of(length);
    if (units > position.character) break;
    ++result.column;
    at += length;
  }
  return result;
}

std::size_t Lines::offset(const EditorPosition& position) const {
  if (position.line < 0) return 0;
  if (static_cast<std::size_t>(position.line) >= starts_.size()) return text_.size();
  const std::string_view text = line(position.line);
  std::size_t at = 0;
  for (int units = 0; at < text.size();) {
    const std::size_t length = length_of(static_cast<unsigned char>(text[at]));
    units += units_of(length);
    if (units > position.character) break;
    at += length;
  }
  return starts_[static_cast<std::size_t>(position.line)] + std::min(at, text.size());
}

EditorPosition Lines::end() const {
  const int last = static_cast<int>(starts_.size()) - 1;
  int units = 0;
  const std::string_view text = line(last);
  for (std::size_t at = 0; at < text.size(); at += length_of(static_cast<unsigned char>(text[at])))
    units += units_of(length_of(static_cast<unsigned char>(text[at])));
  return {last, units};
}

}  // namespace zwang::lsp
