/// Places in a text as editors count them: lines and UTF-16 units from 0. Everywhere else in zwang lines and
/// code points count from 1.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "zwang/lang/source.hpp"

namespace zwang::lsp {

struct EditorPosition {
  int line = 0;       ///< from 0
  int character = 0;  ///< from 0, in UTF-16 units

  bool operator==(const EditorPosition&) const = default;
};

/// The lines of a text, which must outlive it. Positions beyond the text, or inside a character, are moved to
/// the nearest place before.
class Lines {
 public:
  explicit Lines(std::string_view text);

  EditorPosition to_editor(const lang::Position& position) const;
  lang::Position from_editor(const EditorPosition& position) const;
  std::size_t offset(const EditorPosition& position) const;  ///< [bytes]
  EditorPosition end() const;
  /// Without its end; empty beyond the text.
  std::string_view line(int number) const;

 private:
  std::string_view text_;
  std::vector<std::size_t> starts_;
};

}  // namespace zwang::lsp
