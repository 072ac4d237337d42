/// yaml-cpp tells where a scalar starts; where it ends is found again in the text.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace zwang::lang {

enum class ScalarStyle { plain, quoted, block };

struct ScalarText {
  ScalarStyle style = ScalarStyle::plain;
  std::size_t end = 0;  ///< offset behind the last byte, closing quote included
};

ScalarText find_scalar(std::string_view text, std::size_t begin, std::string_view value);

/// The offset of each byte of the value, and of its end. A folded line end stands for one space.
std::vector<std::size_t> offsets_of_scalar(std::string_view text, std::size_t begin, std::string_view value,
                                           bool is_quoted);

/// The offset behind the closing bracket of a flow list or map, searched from behind its last element.
std::size_t end_of_flow(std::string_view text, std::size_t from, char bracket);

}  // namespace zwang::lang
