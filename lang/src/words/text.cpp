#include "words/text.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "words/code_point.hpp"
#include "zwang/lang/printable.hpp"

namespace zwang::lang {

TextIndex::TextIndex(std::string_view text) : text_(text), starts_{0} {
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\n') starts_.push_back(at + 1);
    if (is_continuation_byte(text[at])) continued_.push_back(at);
  }
}

Position TextIndex::position(std::size_t offset) const {
  offset = std::min(offset, text_.size());
  const auto next = std::upper_bound(starts_.begin(), starts_.end(), offset);
  const std::size_t line = static_cast<std::size_t>(next - starts_.begin()) - 1;
  const auto from = std::lower_bound(continued_.begin(), continued_.end(), starts_[line]);
  const auto to = std::lower_bound(from, continued_.end(), offset);
  const std::size_t column = offset - starts_[line] - static_cast<std::size_t>(to - from);
  return {static_cast<int>(line) + 1, static_cast<int>(column) + 1};
}

std::size_t TextIndex::offset(Position position) const {
  if (position.line < 1) return 0;
  const std::size_t line = static_cast<std::size_t>(position.line) - 1;
  if (line >= starts_.size()) return text_.size();
  std::size_t at = starts_[line];
  for (int column = 1; column < position.column && at < text_.size() && text_[at] != '\n'; ++column) {
    ++at;
    while (at < text_.size() && is_continuation_byte(text_[at])) ++at;
  }
  return at;
}

std::string_view TextIndex::line(int number) const {
  if (number < 1 || number > line_count()) return {};
  const std::size_t start = starts_[static_cast<std::size_t>(number) - 1];
  std::string_view line = text_.substr(start, text_.find('\n', start) - start);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::size_t count_code_points(std::string_view text) {
  return text.size() -
         static_cast<std::size_t>(std::count_if(text.begin(), text.end(), is_continuation_byte));
}

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1));
}

std::vector<std::string> split_at_dots(const std::string& path) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', begin)) {
    parts.push_back(path.substr(begin, dot - begin));
    begin = dot + 1;
  }
  parts.push_back(path.substr(begin));
  return parts;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

std::string joined_at_decimal_comma(std::string_view before, std::string_view behind) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const std::string whole = trimmed(before), rest = trimmed(behind);
  const std::size_t sign = whole.starts_with("+-")                            ? 2
                           : whole.starts_with('-') || whole.starts_with('+') ? 1
                                                                              : 0;
  const std::string_view digits = std::string_view(whole).substr(sign);
  const bool is_whole = !digits.empty() && std::all_of(digits.begin(), digits.end(), is_digit);
  return is_whole && !rest.empty() && is_digit(rest[0]) ? whole + "." + rest : "";
}

std::string printable(std::string_view text, std::string_view kept) {
  static constexpr std::array<char, 17> digits{"0123456789abcdef"};
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::optional<CodePoint> c = decode(text, at);
    const bool is_bare_control = c && c->value < 0x20;
    const bool stays = is_bare_control ? kept.find(text[at]) != std::string_view::npos
                                       : c && !is_control(c->value) && !is_deceptive(c->value);
    const std::size_t bytes = c ? c->bytes : 1;
    for (const char byte : text.substr(at, bytes)) {
      if (stays) {
        result += byte;
        continue;
      }
      result += "\\x";
      result += digits[static_cast<unsigned char>(byte) >> 4u];
      result += digits[static_cast<unsigned char>(byte) & 0xFu];
    }
    at += bytes;
  }
  return result;
}

std::string printable_in_xml(std::string_view text) {
  std::string out;
  for (const char c : printable(text)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c == '\n' || c == '\t' ? ' ' : c;
    }
  }
  return out;
}

std::string escaped(std::string_view text) {
  return printable(text, "");
}

std::string in_ticks(std::string_view text) {
  constexpr std::size_t longest = 60;
  if (count_code_points(text) <= longest) return "`" + escaped(text) + "`";
  std::size_t end = longest;
  while (end > 0 && is_continuation_byte(text[end])) --end;
  return "`" + escaped(text.substr(0, end)) + "...`";
}

std::string in_one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (!is_space(c)) line += c;
    if (is_space(c) && !line.empty() && line.back() != ' ') line += ' ';
  }
  if (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

}  // namespace zwang::lang
