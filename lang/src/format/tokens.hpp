/// A YAML text as the lines and tokens that a layout is made of.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tree/read.hpp"

namespace zwang::lang {

enum class TokenKind { scalar, punctuation };

struct Token {
  TokenKind kind = TokenKind::scalar;
  std::string text;
  int column = 0;  ///< as written, from 0 [code points]
};

/// One line of the text, taken apart.
struct LineTokens {
  std::vector<Token> tokens;
  std::string comment;     ///< from its `#`; empty: none
  int indent = 0;          ///< as written [columns]
  bool continues = false;  ///< goes on with brackets or a text that an earlier line opened
  int depth = 0;           ///< of block indentation, for lines that start an entry or an item
};

/// As `format_file`, of a source that was read already.
std::optional<std::string> format_source(int source, Diagnostics& diagnostics);
std::vector<LineTokens> tokens_of(const Document& document, std::string_view text);

}  // namespace zwang::lang
