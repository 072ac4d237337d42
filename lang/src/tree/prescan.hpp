/// Checks on the raw text, before any library reads it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

/// A comment of a YAML text, from its `#` to the end of its line.
struct Comment {
  std::string text;
  Span span;
};

/// UTF-8, control and bidirectional characters. False, with the first offence reported, when the text must
/// not be read on. Tabs are left to the caller.
bool prescan_characters(int source, std::string_view text, const char* code, Diagnostics& diagnostics);

/// Characters, tabs, the length of lines, quotes that stay open: true when the YAML reader may see the text.
/// Collects the comments.
bool prescan_yaml(int source, std::string_view text, Diagnostics& diagnostics,
                  std::vector<Comment>& comments);

inline constexpr std::size_t longest_line = 4096;  ///< [bytes]

}  // namespace zwang::lang
