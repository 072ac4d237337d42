/// Lines, columns and code points of a text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "zwang/lang/source.hpp"

namespace zwang::lang {

inline bool is_continuation_byte(char c) {
  return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u;
}

/// Of YAML and XML.
inline bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// A letter or an underscore: names begin so.
inline bool is_word_start(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// Maps byte offsets to positions and back. Holds a view: the text must outlive it.
class TextIndex {
 public:
  explicit TextIndex(std::string_view text);

  Position position(std::size_t offset) const;
  std::size_t offset(Position position) const;  ///< clamped to the text
  /// The line without its end, line numbers from 1; empty past the end.
  std::string_view line(int number) const;
  int line_count() const { return static_cast<int>(starts_.size()); }

 private:
  std::string_view text_;
  std::vector<std::size_t> starts_;     ///< of each line
  std::vector<std::size_t> continued_;  ///< bytes that go on with a code point
};

std::size_t count_code_points(std::string_view text);
std::string trimmed(std::string_view text);
/// `a.b.c` as `a`, `b`, `c`.
std::vector<std::string> split_at_dots(const std::string& path);
std::string lower_case(std::string_view text);
/// A decimal comma ends an item in brackets: `0,08 m/s` comes as `0` and `08 m/s`. Returns the quantity that
/// the author meant, `0.08 m/s`. Empty: the two items are something else.
std::string joined_at_decimal_comma(std::string_view before, std::string_view behind);
/// As `printable`, on one line: a hostile file cannot write to the terminal.
std::string escaped(std::string_view text);
/// Shortened for a message: `a very long wo...`.
std::string in_ticks(std::string_view text);

}  // namespace zwang::lang
