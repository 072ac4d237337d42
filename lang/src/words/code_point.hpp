/// The characters of UTF-8 text.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace zwang::lang {

struct CodePoint {
  char32_t value = 0;
  std::size_t bytes = 0;
};

/// Decodes strictly: no overlong forms, no surrogates, nothing above U+10FFFF.
std::optional<CodePoint> decode(std::string_view text, std::size_t at);

bool is_control(char32_t c);  ///< C0 but tab and the ends of lines, DEL and C1
/// Characters that make a text look other than it is: direction marks, invisible spaces, line separators.
bool is_deceptive(char32_t c);

}  // namespace zwang::lang
